// The inputs of the material "principled": its parameters, constants or textures, evaluated at a
// point to a PrincipledSurface. It must not know lobes.
#pragma once

#include "scene/bsdf/principled_surface.h"
#include "scene/material/inputs.h"
#include "scene/material/table.h"

namespace nephroid {

/// A float between two bounds. All values are clamped, constants outside with a warning.
class BoundedInput {
 public:
  BoundedInput(const MaterialDescription& d, const MaterialContext& c, const char* name,
               float fallback, float low = 0.0f, float high = 1.0f);

  float at(const SurfaceInteraction& point) const {
    return constant_ ? *constant_ : clamped(input_.at(point));
  }
  std::optional<float> constant() const { return constant_; }
  /// False if the value is known to be `value` everywhere.
  bool may_differ_from(float value) const { return constant_ != value; }

 private:
  float clamped(float x) const { return x > low_ ? std::min(x, high_) : low_; }

  FloatInput input_;
  float low_, high_;
  std::optional<float> constant_;
};

class PrincipledInputs {
 public:
  PrincipledInputs(const MaterialDescription& d, const MaterialContext& c);

  /// Where glass separates colours, all wavelengths but the hero are terminated.
  PrincipledSurface at(const SurfaceInteraction& point, SampledWavelengths& lambda) const;
  /// Mean free path of the subsurface medium, scene units; 0 at all wavelengths or at none.
  SampledSpectrum free_path(const SurfaceInteraction& point,
                            const SampledWavelengths& lambda) const;

  /// Whether some point of the surface may have these.
  bool may_transmit() const;
  bool may_be_opaque_dielectric() const;
  bool may_scatter_below() const;
  bool may_have_fuzz() const { return fuzz_weight_.may_differ_from(0.0f); }
  bool may_have_coat() const { return coat_weight_.may_differ_from(0.0f); }
  bool may_have_facets() const;
  bool may_go_straight() const;
  bool thin_walled() const { return thin_walled_; }
  /// The facets, if they are the same everywhere.
  std::optional<TrowbridgeReitz> constant_facets() const;
  std::optional<TrowbridgeReitz> constant_coat_facets() const;
  /// Index of the base at 550 nm; 1.5 if it varies.
  float index_at_550_nm() const;
  /// Mean cosine of scattering below the surface.
  float scatter_anisotropy() const { return g_; }

 private:
  SampledSpectrum color(const SpectrumInput& input, const SurfaceInteraction& point,
                        const SampledWavelengths& lambda) const {
    return clamp(input.at(point, lambda), 0.0f, 1.0f);
  }
  /// OpenPBR's facets of a roughness, or of an alpha if roughness is not remapped.
  TrowbridgeReitz facets_of(float roughness, float anisotropy) const;
  /// The index at wavelength `lambda` in nm, for an index `ior` at helium's d line, 587.56 nm.
  float dispersed(float ior, float lambda) const;
  bool coat_may_affect_specular() const { return coat_affects_specular_ && may_have_coat(); }
  void set_base(const SurfaceInteraction& point, SampledWavelengths& lambda,
                PrincipledSurface& s) const;
  void set_layers(const SurfaceInteraction& point, const SampledWavelengths& lambda,
                  PrincipledSurface& s) const;

  SpectrumInput base_color_;
  BoundedInput base_weight_, metalness_, diffuse_roughness_;
  BoundedInput specular_weight_, roughness_, anisotropy_, ior_;
  SpectrumInput specular_color_;
  BoundedInput transmission_;
  SpectrumInput transmission_color_;
  BoundedInput diffuse_transmission_;
  SpectrumInput diffuse_transmission_color_;
  BoundedInput subsurface_;
  SpectrumInput subsurface_color_;
  BoundedInput radius_;
  SpectrumInput radius_scale_;
  BoundedInput fuzz_weight_, fuzz_roughness_;
  SpectrumInput fuzz_color_;
  BoundedInput coat_weight_, coat_roughness_, coat_anisotropy_, coat_ior_, coat_darkening_;
  SpectrumInput coat_color_;
  bool coat_affects_specular_;
  BoundedInput film_weight_, film_thickness_, film_ior_;
  bool thin_walled_, remap_roughness_;
  float g_ = 0, abbe_ = 0;
};

}  // namespace nephroid
