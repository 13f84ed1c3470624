// Value and albedo of fuzz; see fuzz.h.
#include "scene/bsdf/fuzz.h"

#include <algorithm>
#include <cmath>

namespace nephroid {
namespace {

/// Smaller ones have next to no fibres that a viewer could see.
constexpr float kMinRoughness = 0.1f;

float roughness_of(int i, int count) {
  return lerp(static_cast<float>(i) / static_cast<float>(count - 1), kMinRoughness, 1.0f);
}

struct Node {
  int index;
  float share;
};

Node node(float roughness, int count) {
  const float x = (std::clamp(roughness, kMinRoughness, 1.0f) - kMinRoughness) /
                  (1.0f - kMinRoughness) * static_cast<float>(count - 1);
  const int i = std::min(static_cast<int>(x), count - 2);
  return {i, x - static_cast<float>(i)};
}

}  // namespace

FuzzTable::FuzzTable() {
  constexpr int kSteps = 64;
  for (int r = 0; r < kRoughnesses; ++r) {
    const float roughness = roughness_of(r, kRoughnesses);
    for (int j = 0; j < kCosines; ++j) {
      const float root = std::max(static_cast<float>(j), 0.1f) / (kCosines - 1);
      const float c = root * root;
      const Vec3f wo(safe_sqrt(1.0f - c * c), 0.0f, c);
      float sum = 0.0f;
      for (int i = 0; i < kSteps * kSteps; ++i) {
        // The root of the cosine is uniform: cos dw = 2 x^3 dx dphi.
        const float x = (static_cast<float>(i / kSteps) + 0.5f) / kSteps;
        const float phi = kPi * (static_cast<float>(i % kSteps) + 0.5f) / kSteps;
        const float z = x * x, side = safe_sqrt(1.0f - z * z);
        const Vec3f wi(side * std::cos(phi), side * std::sin(phi), z);
        sum += unscaled(wo, wi, roughness) * 4.0f * kPi * x * z;
      }
      albedo_[r][j] = sum / (kSteps * kSteps);
      most_[r] = std::max(most_[r], albedo_[r][j]);
    }
  }
}

float FuzzTable::unscaled(const Vec3f& wo, const Vec3f& wi, float roughness) {
  const Vec3f h = wo + wi;
  const float l2 = length_squared(h);
  if (!(l2 > 0.0f)) return 0.0f;
  const float sin2 = std::max(0.0f, 1.0f - h.z * h.z / l2);
  const float exponent = 1.0f / sqr(std::clamp(roughness, kMinRoughness, 1.0f));
  const float d = (2.0f + exponent) * std::pow(sin2, 0.5f * exponent) * kInv2Pi;
  return d / std::max(4.0f * (wo.z + wi.z - wo.z * wi.z), 1e-6f);
}

float FuzzTable::scale(float roughness) const {
  const Node n = node(roughness, kRoughnesses);
  return 1.0f / std::max(1.0f, lerp(n.share, most_[n.index], most_[n.index + 1]));
}

float FuzzTable::f(const Vec3f& wo, const Vec3f& wi, float roughness) const {
  return unscaled(wo, wi, roughness) * scale(roughness);
}

float FuzzTable::albedo(float c, float roughness) const {
  const Node n = node(roughness, kRoughnesses);
  const float y = std::sqrt(std::clamp(c, 0.0f, 1.0f)) * (kCosines - 1);
  const int j = std::min(static_cast<int>(y), kCosines - 2);
  const auto at = [&](int r) {
    return lerp(y - static_cast<float>(j), albedo_[r][j], albedo_[r][j + 1]);
  };
  return std::min(lerp(n.share, at(n.index), at(n.index + 1)) * scale(roughness), 1.0f);
}

}  // namespace nephroid
