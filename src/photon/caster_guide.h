// Where light that leaves a rough surface is of use: at the smooth things by way of which earlier
// light paths came to what the camera sees. They are kept as balls; as seen from a vertex these are
// cones, and a share of the directions of light paths falls into them (docs/estimators.md, [G8]).
// Immutable once made. It must not know routes, cameras or films.
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
  /// Of the directions, those into cones.
  static constexpr float kShare = 0.5f;

  bool empty() const { return count_ == 0; }
  float share() const { return kShare; }
  /// A unit direction, world, evenly in one of the cones. What chose the cone is taken out of `uc`.
  Vec3f sample(float& uc, const Vec2f& u) const;
  /// Density of the unit direction `w`, world, per steradian. What sample() gave is inside of its
  /// cone, however narrow that is.
  float pdf_w(const Vec3f& w) const;

  /// One more cone, of kMaxCones at most, `weight` times as likely as one of weight 1. `narrowness`
  /// is one minus the cosine of its half angle, above 0 and at most 1.
  void add(const Vec3f& axis, float narrowness, float weight);

 private:
  struct Cone {
    Vec3f axis;
    float narrowness = 0;
    float weight = 0;
    /// One minus the cosine is small for narrow cones.
    bool contains(const Vec3f& w) const { return 0.5f * length_squared(w - axis) <= narrowness; }
  };
  std::array<Cone, kMaxCones> cones_;
  int count_ = 0;
  float total_ = 0;  ///< of the weights
};

class CasterGuide {
 public:
  /// Guides nothing.
  CasterGuide() = default;
  /// Learns from where useful paths met the smooth thing that they needed behind a rough one;
  /// guides nothing if there are none.
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
    float use = 0;  ///< [G8], over that of other balls
    static void members(auto& self, auto& archive) { archive(self.center, self.radius, self.use); }
    bool is_sound() const { return is_sound_ball(center, radius) && use > 0 && use <= kMaxUse; }
    static constexpr float kMaxUse = 1e30f;  ///< times any density it is still finite
  };
  std::span<const Ball> balls() const { return balls_; }

  /// The balls as light that comes to `v` sees them, where events may have these classes. Those
  /// around the vertex, and those that its BSDF does not reach, are left out.
  CasterCones at(const WalkVertex& v, ClassMask among) const;

 private:
  std::vector<Ball> balls_;
  size_t places_ = 0;
};

}  // namespace nephroid
