// Integrals over the visible facets, and look-ups; see facet_albedo.h.
#include "scene/bsdf/facet_albedo.h"

#include "scene/bsdf/fresnel.h"

namespace nephroid {
namespace {

/// Adds `weight` at cosine `c`, shared by the two Fresnel nodes around it.
void add(FresnelNodes<float>& shares, float c, float weight) {
  const float x = std::sqrt(std::clamp(c, 0.0f, 1.0f)) * (kFresnelNodes - 1);
  const int k = std::min(static_cast<int>(x), kFresnelNodes - 2);
  const float low = FacetAlbedoTable::cosine(k), high = FacetAlbedoTable::cosine(k + 1);
  const float t = std::clamp((c - low) / (high - low), 0.0f, 1.0f);
  shares[k] += weight * (1.0f - t);
  shares[k + 1] += weight * t;
}

float alpha_of(int i, int count) {
  return sqr(static_cast<float>(i) / static_cast<float>(count - 1));
}

}  // namespace

FacetAlbedoTable::FacetAlbedoTable() {
  for (int a = 0; a < kAlphas; ++a) {
    for (int j = 0; j < kCosines; ++j) {
      // The node at grazing angle stands for the limit.
      const float root = std::max(static_cast<float>(j), 1e-2f) / (kCosines - 1);
      const Shares s = shares_of_facets(root * root, alpha_of(a, kAlphas));
      shares_.push_back(s);
      float white = 0.0f;
      for (const float share : s) white += share;
      white_.push_back(std::min(white, 1.0f));
    }
  }
  constexpr int kSteps = 512;
  for (int i = 0; i < kSteps; ++i) {
    const float c = (static_cast<float>(i) + 0.5f) / kSteps, weight = 2.0f * c / kSteps;
    add(diffuse_, c, weight);
    for (int a = 0; a < kAlphas; ++a)
      white_mean_[a] += weight * white_albedo(c, alpha_of(a, kAlphas));
  }
}

FacetAlbedoTable::Shares FacetAlbedoTable::shares_of_facets(float c, float alpha) {
  Shares shares{};
  const TrowbridgeReitz facets(alpha, alpha);
  if (facets.smooth()) {
    add(shares, c, 1.0f);
    return shares;
  }
  const Vec3f w(safe_sqrt(1.0f - c * c), 0.0f, c);
  const float s = facets.s(w);
  constexpr int kAround = 12, kAway = 40;
  for (int i = 0; i < kAround; ++i) {
    for (int j = 0; j < kAway; ++j) {
      // Half of all azimuths, by symmetry. The second variable runs as 1-(1-y)^2, which flattens
      // the singular tail of the facets.
      const float y = 1.0f - (static_cast<float>(j) + 0.5f) / kAway;
      const Vec2f u(0.5f * (static_cast<float>(i) + 0.5f) / kAround, 1.0f - y * y);
      const Vec3f m = facets.sample_visible(w, u);
      const Vec3f wi = reflect_about(w, m);
      if (!(wi.z > 0.0f)) continue;
      const float si = facets.s(wi);
      const float seen = wi.z * (c + s) / (s * wi.z + si * c);
      add(shares, nephroid::dot(w, m), 2.0f * y * seen / (kAround * kAway));
    }
  }
  return shares;
}

FacetAlbedoTable::Place FacetAlbedoTable::place(float c, float alpha) {
  const float x = std::sqrt(std::clamp(alpha, 0.0f, 1.0f)) * (kAlphas - 1);
  const float y = std::sqrt(std::clamp(c, 0.0f, 1.0f)) * (kCosines - 1);
  const int i = std::min(static_cast<int>(x), kAlphas - 2);
  const int j = std::min(static_cast<int>(y), kCosines - 2);
  return {i, j, x - static_cast<float>(i), y - static_cast<float>(j)};
}

FacetAlbedoTable::Shares FacetAlbedoTable::shares(float c, float alpha) const {
  const Place p = place(c, alpha);
  const float ta = p.alpha_share, tc = p.cosine_share;
  const Shares& a = shares_[index(p.alpha, p.cosine)];
  const Shares& b = shares_[index(p.alpha, p.cosine + 1)];
  const Shares& d = shares_[index(p.alpha + 1, p.cosine)];
  const Shares& e = shares_[index(p.alpha + 1, p.cosine + 1)];
  Shares result;
  for (int k = 0; k < kFresnelNodes; ++k)
    result[k] = lerp(ta, lerp(tc, a[k], b[k]), lerp(tc, d[k], e[k]));
  return result;
}

float FacetAlbedoTable::white_albedo(float c, float alpha) const {
  const Place p = place(c, alpha);
  const auto at = [&](int a) {
    return lerp(p.cosine_share, white_[index(a, p.cosine)], white_[index(a, p.cosine + 1)]);
  };
  return lerp(p.alpha_share, at(p.alpha), at(p.alpha + 1));
}

float FacetAlbedoTable::white_mean(float alpha) const {
  const float x = std::sqrt(std::clamp(alpha, 0.0f, 1.0f)) * (kAlphas - 1);
  const int i = std::min(static_cast<int>(x), kAlphas - 2);
  return lerp(x - static_cast<float>(i), white_mean_[i], white_mean_[i + 1]);
}

float FacetAlbedoTable::alpha_towards(const TrowbridgeReitz& facets, const Vec3f& w) {
  const float r2 = w.x * w.x + w.y * w.y;
  if (!(r2 > 1e-12f) || facets.alpha_x() == facets.alpha_y()) return mean_alpha(facets);
  const float a2 = (sqr(w.x * facets.alpha_x()) + sqr(w.y * facets.alpha_y())) / r2;
  return std::min(std::sqrt(0.5f * (a2 + sqr(mean_alpha(facets)))), 1.0f);
}

}  // namespace nephroid
