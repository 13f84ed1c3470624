#include "photon/caster_guide.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "transport/guided_direction.h"

namespace nephroid {

namespace {

constexpr size_t kMaxPlaces = CasterCones::kMaxCones / 2;
/// [G8] Weight of all balls that enclose several places together, over that of one place's ball.
constexpr float kCasterShareAround = 0.125f;
/// Smallest radius of a ball, over the scene's radius.
constexpr float kSmallestCasterBall = 1e-4f;
/// A ball that covers much of a vertex's sky is no use to guide to.
constexpr float kMaxSine2 = 0.9f;
/// Lower bound of a BSDF's density towards a ball that is partly in its reach.
constexpr float kMinDensity = 0.1f / kPi;
/// A single place gets a second ball if that one is wider by this factor.
constexpr float kWiderCasterBall = 1.05f;
/// Attempts until a sampled direction is inside of its cone in spite of rounding.
constexpr int kMaxTries = 64;

/// Approximate BSDF density from `v.wo` to the local direction `wi` of a ball, whose half angle has
/// this squared sine. 0 if the ball is not worth guiding to. Layered BSDFs are slow, so they are
/// evaluated only where that decides.
float density_towards(const WalkVertex& v, ClassMask among, const Vec3f& wi, float sine2) {
  const bool same_side = wi.z * v.wo.z > 0.0f;
  if (!contains(guided_classes(v.bsdf, among), EventClass::kDiffuse)) {
    const float p = guided_pdf_w(v.bsdf, v.wo, wi, TransportMode::kImportance, among);
    return p < kMinDensity ? 0.0f : p;
  }
  if (same_side || sqr(wi.z) < sine2) return std::max(abs_cos_theta(wi) * kInvPi, kMinDensity);
  const float p = guided_pdf_w(v.bsdf, v.wo, wi, TransportMode::kImportance, among);
  return p > 0.0f ? std::max(p, kMinDensity) : 0.0f;
}

}  // namespace

void CasterCones::add(const Vec3f& axis, float narrowness, float weight) {
  assert(count_ < kMaxCones);
  cones_[count_++] = {axis, narrowness, weight};
  total_ += weight;
}

Vec3f CasterCones::sample(float& uc, const Vec2f& u) const {
  const Cone* cone = cones_.data();
  float left = uc * total_;
  for (int i = 1; i < count_ && left >= cone->weight; ++i) left -= (cone++)->weight;
  uc = std::clamp(left / cone->weight, 0.0f, kOneMinusEpsilon);
  const Frame frame = Frame::from_z(cone->axis);
  const float phi = 2 * kPi * u.y;
  // Rounding may put a direction outside of the cone. pdf_w() would then leave the cone out, and
  // the sample would weigh thousands of times too much.
  float below = cone->narrowness * u.x;
  for (int i = 0; i < kMaxTries; ++i, below *= 0.75f) {
    const float sine = std::sqrt(below * (2 - below));
    const Vec3f w =
        normalize(frame.to_world(Vec3f(sine * std::cos(phi), sine * std::sin(phi), 1 - below)));
    if (cone->contains(w)) return w;
  }
  return cone->axis;
}

float CasterCones::pdf_w(const Vec3f& w) const {
  float sum = 0;
  for (int i = 0; i < count_; ++i) {
    const Cone& cone = cones_[i];
    if (cone.contains(w)) sum += cone.weight / (2 * kPi * cone.narrowness);
  }
  return sum / total_;
}

CasterGuide::CasterGuide(std::span<const UsefulStart> met, float scene_radius) {
  if (met.empty()) return;
  const StartTree tree(met, kMaxPlaces);
  const auto add = [&](const StartTree::Crowd& crowd, float extent, float share) {
    // Room for points not found yet, most where few have been.
    const float room = 1.05f + 0.5f / std::sqrt(static_cast<float>(crowd.end - crowd.begin));
    const float radius = std::max(extent * room, kSmallestCasterBall * scene_radius);
    balls_.push_back(
        {crowd.center(), radius, share * static_cast<float>(std::sqrt(crowd.weight)) / radius});
  };
  const auto farthest_of = [&](const StartTree::Crowd& crowd) {
    float farthest = 0;
    for (const uint32_t i : tree.starts_of(crowd))
      farthest = std::max(farthest, length(met[i].first_hit - crowd.center()));
    return farthest;
  };
  for (const StartTree::Crowd& leaf : tree.leaves()) add(leaf, farthest_of(leaf), 1);
  places_ = balls_.size();
  for (const StartTree::Crowd& crowd : tree.inner())
    add(crowd, crowd.half_diagonal(), kCasterShareAround / static_cast<float>(tree.inner().size()));
  const StartTree::Crowd& only = tree.leaves()[0];
  if (tree.inner().empty() && only.half_diagonal() > kWiderCasterBall * farthest_of(only))
    add(only, only.half_diagonal(), kCasterShareAround);
}

CasterCones CasterGuide::at(const WalkVertex& v, ClassMask among) const {
  CasterCones cones;
  // Subsurface scattering has no direction to guide.
  if (!v.merges || (v.material.has_bssrdf() && !v.subsurface_exit) ||
      guided_classes(v.bsdf, among) == ClassMask::kNone)
    return cones;
  for (const Ball& ball : balls_) {
    const Vec3f way = ball.center - v.surface.p;
    const float d2 = length_squared(way), sine2 = sqr(ball.radius) / d2;
    if (!(sine2 < kMaxSine2)) continue;
    const Vec3f axis = way / std::sqrt(d2);
    const float density = density_towards(v, among, v.to_local(axis), sine2);
    if (!(density > 0.0f)) continue;
    const float narrowness = sine2 / (1 + std::sqrt(1 - sine2));
    const float weight = ball.use * density * narrowness;
    // The weight of a ball very far away underflows to 0.
    if (weight > 0.0f) cones.add(axis, narrowness, weight);
  }
  return cones;
}

}  // namespace nephroid
