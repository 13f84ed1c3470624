// Directional albedo of rough facets for any Fresnel term, tabulated: the shares of the visible,
// unshadowed facets by their cosine, so that the albedo is a dot product with the Fresnel term at a
// few cosines. It must not know layers. Paper: Kulla & Conty, Revisiting Physically Based Shading
// at Imageworks, SIGGRAPH 2017 (albedo tables, lost energy).
#pragma once

#include <array>
#include <vector>

#include "scene/bsdf/microfacet.h"

namespace nephroid {

/// A Fresnel term at the cosines of FacetAlbedoTable::cosine.
inline constexpr int kFresnelNodes = 16;
template <class Value>
using FresnelNodes = std::array<Value, kFresnelNodes>;

class FacetAlbedoTable {
 public:
  FacetAlbedoTable();

  /// The cosine of Fresnel node k, from 0 to 1.
  static float cosine(int k) { return sqr(static_cast<float>(k) / (kFresnelNodes - 1)); }
  /// The Fresnel term `f` at the nodes.
  template <class Fresnel>
  static auto nodes_of(const Fresnel& f) {
    FresnelNodes<decltype(f(1.0f))> nodes;
    for (int k = 0; k < kFresnelNodes; ++k) nodes[k] = f(cosine(k));
    return nodes;
  }
  /// Mean of a Fresnel term over a hemisphere of diffuse light.
  template <class Value>
  Value diffuse_mean(const FresnelNodes<Value>& nodes) const {
    return dot(diffuse_, nodes);
  }
  /// Share of flux from cosine `c` that facets of roughness `alpha` reflect.
  template <class Value>
  Value albedo(float c, float alpha, const FresnelNodes<Value>& nodes) const {
    return dot(shares(c, alpha), nodes);
  }
  /// The same for facets that reflect everything: what is missing to 1 left them after more than
  /// one reflection.
  float white_albedo(float c, float alpha) const;
  /// Mean of white_albedo over a hemisphere of diffuse light.
  float white_mean(float alpha) const;

  /// The alpha of isotropic facets that reflect about as much light from w as `facets`: between
  /// that along w and the mean.
  static float alpha_towards(const TrowbridgeReitz& facets, const Vec3f& w);
  /// The alpha of isotropic facets that are as rough as `facets`: the root of the mean square.
  static float mean_alpha(const TrowbridgeReitz& facets) {
    return std::min(std::sqrt(0.5f * (sqr(facets.alpha_x()) + sqr(facets.alpha_y()))), 1.0f);
  }

 private:
  static constexpr int kAlphas = 24, kCosines = 48;
  using Shares = FresnelNodes<float>;
  struct Place {
    int alpha, cosine;
    float alpha_share, cosine_share;  ///< distance from the node, 0 to 1
  };

  template <class Value>
  static Value dot(const Shares& shares, const FresnelNodes<Value>& nodes) {
    Value sum = nodes[0] * shares[0];
    for (int k = 1; k < kFresnelNodes; ++k) sum += nodes[k] * shares[k];
    return sum;
  }
  static Place place(float c, float alpha);
  static Shares shares_of_facets(float c, float alpha);
  static size_t index(int alpha, int cosine) {
    return static_cast<size_t>(alpha) * kCosines + static_cast<size_t>(cosine);
  }
  Shares shares(float c, float alpha) const;

  std::vector<Shares> shares_;
  std::vector<float> white_;
  std::array<float, kAlphas> white_mean_{};
  Shares diffuse_{};
};

}  // namespace nephroid
