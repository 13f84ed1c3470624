// How the layers of a principled surface share the light: what each sends back and what passes to
// those below, so that a white surface reflects all light it gets and reflection is reciprocal
// (docs/adr/0036-layers-of-principled.md). It must not know sampling. Papers: Kulla & Conty 2017
// (lost energy, diffuse base); OpenPBR 1.1 (darkening by the coat).
#pragma once

#include "scene/bsdf/facet_albedo.h"
#include "scene/bsdf/fuzz.h"
#include "scene/bsdf/principled_surface.h"

namespace nephroid {

/// Tables shared by all principled materials of a scene.
struct PrincipledTables {
  FacetAlbedoTable facets;
  FuzzTable fuzz;
};

class PrincipledLayers {
 public:
  using FilmNodes = FresnelNodes<SampledSpectrum>;

  /// `tables` and `film` outlive the object. `film` is storage for the Fresnel term of a thin
  /// film; null for a surface without one.
  PrincipledLayers(const PrincipledTables* tables, const PrincipledSurface& surface,
                   FilmNodes* film);

  /// Shares of light along one direction outside that pass the layers above the base.
  struct Passed {
    float fuzz = 1;               ///< past the fuzz
    float above = 1;              ///< past fuzz and coat
    SampledSpectrum color{1.0f};  ///< transmittance of the coat's colour
  };
  Passed passed(const Vec3f& w) const;
  /// Share that arrives below the dielectric boundary, the coat's colour included.
  SampledSpectrum reaches_base(const Vec3f& w, const Passed& passed) const;
  /// Mean of reaches_base over the light of a white base, without the coat's colour.
  const SampledSpectrum& mean_reaches_base() const { return mean_; }
  /// Value times pi of a white Lambertian base, from what reaches it along two directions.
  SampledSpectrum couple(const SampledSpectrum& reaches_o, const SampledSpectrum& reaches_i) const {
    return safe_div(reaches_o * reaches_i, mean_);
  }

  /// Directional albedos of fuzz and coat alone.
  float fuzz_albedo(float c) const;
  float coat_albedo(const Vec3f& w) const;
  /// Share of flux that a facet of the coat reflects, weight included.
  float coat_fresnel(float c) const;
  /// Light that metal facets reflect more than once: this times lost(wo) lost(wi) is its f.
  const SampledSpectrum& multiple() const { return multiple_; }
  /// Share that white facets of the base do not reflect at the first bounce.
  float lost(const Vec3f& w) const;

  /// Factors by which the coat darkens a diffuse base of this albedo, and the metal.
  SampledSpectrum diffuse_darkening(const SampledSpectrum& albedo) const {
    return darkening(albedo, coat_diffuse_return_);
  }
  const SampledSpectrum& metal_darkening() const { return metal_darkening_; }

  const PrincipledSurface& surface() const { return surface_; }
  const PrincipledFresnel& fresnel() const { return fresnel_; }
  const FuzzTable& fuzz() const { return tables_->fuzz; }

 private:
  void prepare_coat();
  void prepare_metal();
  void prepare_boundary(FilmNodes* film);
  float alpha_towards(const TrowbridgeReitz& facets, const Vec3f& w) const {
    return FacetAlbedoTable::alpha_towards(facets, w);
  }
  /// Share that the dielectric boundary reflects towards cosine `c` of the outside.
  SampledSpectrum boundary_albedo(float c, float alpha) const;
  float passed_above(float c, float coat_alpha, float* fuzz) const;
  float coat_albedo(float c, float alpha) const;
  SampledSpectrum coat_color(float c) const;
  /// `inner`: share of the base's light that the coat returns to it.
  SampledSpectrum darkening(const SampledSpectrum& albedo, float inner) const;

  const PrincipledTables* tables_;
  PrincipledSurface surface_;
  PrincipledFresnel fresnel_;
  const FilmNodes* film_nodes_ = nullptr;  ///< null: the boundary's term is in boundary_nodes_
  FresnelNodes<float> coat_nodes_{}, boundary_nodes_{};
  SampledSpectrum mean_{1.0f}, multiple_, metal_darkening_{1.0f}, log_coat_color_;
  float coat_diffuse_return_ = 0;
  bool coat_tints_ = false;
};

}  // namespace nephroid
