#include "photon/caster_guide.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "transport/guided_direction.h"

namespace nephroid {

namespace {

constexpr size_t kMaxPlaces = CasterCones::kMaxCones / 2;
/// [G8] How much less the insides of balls around several places, all together, are aimed at than
/// that of a place.
constexpr float kShareAround = 0.125f;
/// Over the scene's radius.
constexpr float kSmallest = 1e-4f;
/// Of a ball that fills much of the sky as it is seen from a vertex, nothing is gained.
constexpr float kMaxSine2 = 0.9f;
/// The least density that a BSDF is taken to have towards a ball that is partly in its reach.
constexpr float kMinDensity = 0.1f / kPi;
/// A ball around the only place is worth having if it is so much wider.
constexpr float kWider = 1.05f;
/// Rounding is mended by then.
constexpr int kMaxTries = 64;

/// About the density with which light from wo is scattered to the local direction `wi`, a ball
/// around which it sees under an angle of this squared sine; 0 if none is worth aiming there. A
/// guess will do, and asking a BSDF of many layers takes long: only where it decides.
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
  // Rounding may put a direction outside: what seems to have come there by chance alone would weigh
  // thousands of times too much.
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
    // Room for what has not been found, most where little has.
    const float room = 1.05f + 0.5f / std::sqrt(static_cast<float>(crowd.end - crowd.begin));
    const float radius = std::max(extent * room, kSmallest * scene_radius);
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
    add(crowd, crowd.half_diagonal(), kShareAround / static_cast<float>(tree.inner().size()));
  const StartTree::Crowd& only = tree.leaves()[0];
  if (tree.inner().empty() && only.half_diagonal() > kWider * farthest_of(only))
    add(only, only.half_diagonal(), kShareAround);
}

CasterCones CasterGuide::at(const WalkVertex& v, ClassMask among) const {
  CasterCones cones;
  // What goes below a surface is no direction.
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
    // So far away that there is nothing to choose.
    if (weight > 0.0f) cones.add(axis, narrowness, weight);
  }
  return cones;
}

}  // namespace nephroid
