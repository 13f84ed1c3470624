// A path guide: directions towards light at rough surfaces, learned from earlier walks ([Q1] to
// [Q5] in docs/estimators.md, section 23). Each box of the scene, by side and glossiness of its
// surfaces, has a tree of directions and the share of walks that follow it. Immutable. It must not
// know routes, lights or films. Papers: Mueller, Gross & Novak 2017; Rath et al. 2020.
#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "integrator/learning/direction_tree.h"

namespace nephroid {

/// The light that a walk found behind one direction chosen at a surface with D or G lobes.
struct RadianceRecord {
  Vec3f p;       ///< world position on the surface
  Vec2f square;  ///< the direction, by the equal-area map of the sphere
  /// p_R of [Q2], the density by the D and G lobes of the BSDF; 0: another lobe chose.
  float pdf_w = 0;
  float carried = 0;  ///< mean throughput before the surface
  float found = 0;    ///< light behind it over `carried`: X/p of [Q1]
  uint8_t side = 0;   ///< axis that the surface faces most, and whether it has a G lobe

  /// `n` is the shading normal on the walk's side, `w` the chosen direction; both world.
  static RadianceRecord at(const Vec3f& p, const Vec3f& n, bool glossy, const Vec3f& w,
                           float pdf_w);
};

class RadianceGuide {
 public:
  /// An empty guide: directions are the BSDF's.
  RadianceGuide() = default;
  explicit RadianceGuide(std::vector<RadianceRecord> records);

  /// True if it chooses directions anywhere.
  bool guides() const { return guided_ > 0; }
  /// Share of the records whose box has directions to follow.
  double guided() const { return guided_; }
  size_t bytes() const;
  /// Directions at a point of the world; `n` is its shading normal on the walk's side.
  DirectionTree at(const Vec3f& p, const Vec3f& n, bool glossy) const;
  static void members(auto& self, auto& archive) {
    archive(self.boxes_, self.nodes_, self.guided_);
  }
  bool is_sound() const;

 private:
  /// A node of the tree of boxes.
  struct Box {
    int axis = -1;      ///< axis of the cut; -1: a leaf
    float cut = 0;      ///< position of the cut (inner boxes)
    float share = 0;    ///< s of [Q4] (leaves); 0: does not guide
    uint32_t next = 0;  ///< inner: lower part, the upper one follows it; leaf: root of its tree
    static void members(auto& self, auto& archive) {
      archive(self.axis, self.cut, self.share, self.next);
    }
    bool is_sound() const {
      return axis >= -1 && axis < 3 && std::isfinite(cut) && share >= 0 && share < 1;
    }
  };
  struct Region;
  /// Cuts a box until its parts are small enough to be judged, and adds these to `regions`.
  void cut(uint32_t box, std::span<RadianceRecord> records, std::vector<Region>& regions);
  void take(const Region& region);

  std::vector<Box> boxes_;  ///< the first ones are the roots, one per side
  std::vector<DirectionTree::Node> nodes_;
  double guided_ = 0;
};

/// The empty guide.
inline const RadianceGuide kNoRadiance;

}  // namespace nephroid
