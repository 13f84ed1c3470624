// The values of a principled surface at one point, in the terms of OpenPBR 1.1: the evaluated
// parameters and the Fresnel terms that follow from them. It must not know lobes or textures.
// Papers: Andersson et al., OpenPBR Surface specification 1.1, 2024; Kutz et al. 2021 (F82 tint).
#pragma once

#include "scene/bsdf/microfacet.h"
#include "scene/bsdf/thin_film.h"

namespace nephroid {

/// Weights and colours lie in [0,1].
struct PrincipledSurface {
  SampledSpectrum metal_color{0.8f}, diffuse_color{0.8f};  ///< base_color times base_weight
  float metalness = 0, diffuse_roughness = 0;
  float specular_weight = 1, ior = 1.5f;
  SampledSpectrum specular_color{1.0f};
  TrowbridgeReitz facets;  ///< roughened by the coat
  float transmission = 0;
  SampledSpectrum transmission_color{1.0f};
  float diffuse_transmission = 0;
  SampledSpectrum diffuse_transmission_color{1.0f};
  float subsurface = 0;
  SampledSpectrum subsurface_color{0.8f};
  float fuzz_weight = 0, fuzz_roughness = 0.5f;
  SampledSpectrum fuzz_color{1.0f};
  float coat_weight = 0, coat_ior = 1.6f, coat_darkening = 1;
  SampledSpectrum coat_color{1.0f};
  bool coat_affects_specular = true;  ///< `ior` and `film` border on the coat, not on air
  TrowbridgeReitz coat_facets;
  float film_weight = 0;
  ThinFilm film;
  SampledSpectrum lambdas;  ///< nm
  bool thin_walled = false;

  /// Shares of transmission, and of the lobes below an opaque dielectric boundary.
  float transmitting() const { return (1.0f - metalness) * transmission; }
  float opaque() const { return (1.0f - metalness) * (1.0f - transmission); }
  /// True if light that crosses the surface is bent.
  bool refracts() const { return transmitting() > 0.0f && !thin_walled && ior != 1.0f; }
  /// True if light crosses the surface as if nothing were there.
  bool straight() const {
    return transmitting() > 0.0f && (ior == 1.0f || (thin_walled && facets.smooth()));
  }
};

/// Fresnel terms of the base below coat and fuzz. Cosines are those above the surface, of either
/// sign.
class PrincipledFresnel {
 public:
  explicit PrincipledFresnel(const PrincipledSurface& surface);

  /// Share of flux that the boundary of the dielectric reflects, without specular_color.
  SampledSpectrum dielectric(float c) const;
  /// The same at the cosine `c` inside; 1 for total reflection.
  SampledSpectrum dielectric_inside(float c) const;
  /// Share of flux that the two boundaries of a thin wall reflect.
  SampledSpectrum wall(float c) const {
    const SampledSpectrum r = dielectric(c);
    return r * 2.0f / (r + SampledSpectrum(1.0f));
  }
  SampledSpectrum metal(float c) const;
  /// True if the dielectric reflects nothing at any angle.
  bool no_dielectric() const { return eta_ == 1.0f && film_weight_ == 0.0f; }

 private:
  template <class BaseIndex>
  SampledSpectrum with_film(const SampledSpectrum& bare, float c, const BaseIndex& base) const;

  float ior_;  ///< index that bends light
  float eta_;  ///< index of the Fresnel term: changed by specular_weight and coat
  SampledSpectrum metal_0_, metal_slope_;
  float metal_weight_, film_weight_;
  ThinFilm film_;
  SampledSpectrum lambdas_;
};

}  // namespace nephroid
