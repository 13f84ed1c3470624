// Where the light comes from that rough surfaces scatter to the eye, learned from earlier walks:
// the scene is cut into boxes, surfaces that face different ways or are glossy apart, and each box
// has a tree of directions and a share of the walks for which following it pays ([Q1] to [Q5] in
// docs/estimators.md, section 23). Immutable once made. It must not know routes, lights or films.
// Papers: Mueller, Gross & Novak 2017; Rath et al. 2020 for what is learned.
#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "integrator/learning/direction_tree.h"

namespace nephroid {

/// What a walk found by one direction that it chose at a surface that has D or G lobes.
struct RadianceRecord {
  Vec3f p;       ///< of the surface, world
  Vec2f square;  ///< the direction, by the equal-area map of the sphere
  /// p_R of [Q2], by which the D and G lobes of the BSDF choose it; 0: another lobe did.
  float pdf_w = 0;
  float carried = 0;  ///< by the walk before
  float found = 0;    ///< behind it, over what was carried: X / p of [Q1]
  uint8_t side = 0;   ///< that the surface faces, and whether it has a G lobe

  /// `n` is the shading normal on the side of the walk, `w` the direction chosen; both world.
  static RadianceRecord at(const Vec3f& p, const Vec3f& n, bool glossy, const Vec3f& w,
                           float pdf_w);
};

class RadianceGuide {
 public:
  /// Knows nothing: directions are those of the BSDF.
  RadianceGuide() = default;
  explicit RadianceGuide(std::vector<RadianceRecord> records);

  /// False if it would choose no directions anywhere.
  bool guides() const { return guided_ > 0; }
  /// Part of the records whose box has directions to follow.
  double guided() const { return guided_; }
  size_t bytes() const;
  /// Directions at a point whose shading normal, on the side of the walk, is `n`.
  DirectionTree at(const Vec3f& p, const Vec3f& n, bool glossy) const;
  static void members(auto& self, auto& archive) {
    archive(self.boxes_, self.nodes_, self.guided_);
  }
  bool is_sound() const;

 private:
  /// A box of the cut scene.
  struct Box {
    int axis = -1;      ///< along which it is cut; -1: a leaf
    float cut = 0;      ///< of inner ones, where
    float share = 0;    ///< of leaves that guide
    uint32_t next = 0;  ///< of inner ones the lower part, the upper one follows; of leaves the root
    static void members(auto& self, auto& archive) {
      archive(self.axis, self.cut, self.share, self.next);
    }
    bool is_sound() const {
      return axis >= -1 && axis < 3 && std::isfinite(cut) && share >= 0 && share < 1;
    }
  };
  struct Region;
  /// Cuts a box until its parts are worth looking at, which are left to `regions`.
  void cut(uint32_t box, std::span<RadianceRecord> records, std::vector<Region>& regions);
  void take(const Region& region);

  std::vector<Box> boxes_;  ///< first one for each side
  std::vector<DirectionTree::Node> nodes_;
  double guided_ = 0;
};

/// Guides nothing.
inline const RadianceGuide kNoRadiance;

}  // namespace nephroid
