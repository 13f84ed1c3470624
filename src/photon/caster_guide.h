// Guides light paths from rough surfaces to casters: specular surfaces by way of which earlier
// light paths reached what the camera sees. Casters are kept as balls, which a vertex sees as
// cones; a share of the directions is sampled from these (docs/estimators.md, [G8]). Immutable once
// made. It must not know routes, cameras or films.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "photon/sound_places.h"
#include "photon/start_tree.h"
#include "transport/walk.h"

namespace nephroid {

/// The directions from a vertex to the casters: a `Guide` of GuidedDirection.
class CasterCones {
 public:
  static constexpr int kMaxCones = 16;
  /// Share of the directions that are sampled from the cones.
  static constexpr float kShare = 0.5f;

  bool empty() const { return count_ == 0; }
  float share() const { return kShare; }
  /// A unit direction in world space, uniform in one of the cones. `uc` chooses the cone and is
  /// rescaled to [0,1).
  Vec3f sample(float& uc, const Vec2f& u) const;
  /// Density of the unit direction `w` in world space, per steradian. A direction of sample() is
  /// always inside of its cone.
  float pdf_w(const Vec3f& w) const;

  /// Adds a cone, at most kMaxCones, chosen in proportion to `weight`. `narrowness` is one minus
  /// the cosine of its half angle, above 0 and at most 1.
  void add(const Vec3f& axis, float narrowness, float weight);

 private:
  struct Cone {
    Vec3f axis;
    float narrowness = 0;
    float weight = 0;
    /// Squared distances, since one minus the cosine cancels in narrow cones.
    bool contains(const Vec3f& w) const { return 0.5f * length_squared(w - axis) <= narrowness; }
  };
  std::array<Cone, kMaxCones> cones_;
  int count_ = 0;
  float total_ = 0;  ///< sum of the weights
};

class CasterGuide {
 public:
  /// Guides nothing.
  CasterGuide() = default;
  /// Learns from the points at which useful paths met the caster that they needed behind a rough
  /// surface. Guides nothing if there are none.
  CasterGuide(std::span<const UsefulStart> met, float scene_radius);

  bool empty() const { return balls_.empty(); }
  size_t places() const { return places_; }
  static void members(auto& self, auto& archive) { archive(self.balls_, self.places_); }
  bool is_sound() const {
    return balls_.size() <= CasterCones::kMaxCones && places_ <= balls_.size();
  }

  struct Ball {
    Vec3f center{0, 0, 0};
    float radius = 0;
    float use = 0;  ///< relative weight, [G8]
    static void members(auto& self, auto& archive) { archive(self.center, self.radius, self.use); }
    bool is_sound() const { return is_sound_ball(center, radius) && use > 0 && use <= kMaxUse; }
    static constexpr float kMaxUse = 1e30f;  ///< finite even when multiplied by a density
  };
  std::span<const Ball> balls() const { return balls_; }

  /// Cones of the balls as seen from `v`, whose events may have the classes `among`. Balls that
  /// enclose the vertex or that its BSDF does not reach are left out.
  CasterCones at(const WalkVertex& v, ClassMask among) const;

 private:
  std::vector<Ball> balls_;
  size_t places_ = 0;
};

}  // namespace nephroid
