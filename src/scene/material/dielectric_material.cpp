// The materials "dielectric" and "thindielectric". With dispersion a dielectric keeps only the hero
// wavelength; a thin pane does not bend light and keeps all. They must not know participating
// media.
#include "scene/bsdf/dielectric.h"
#include "scene/material/inputs.h"
#include "scene/material/surface_material.h"

namespace nephroid {
namespace {

class DielectricMaterial final : public SurfaceMaterial {
 public:
  DielectricMaterial(const MaterialDescription& d, const MaterialContext& c)
      : SurfaceMaterial(d, c),
        eta_(d.parameters, "eta", c.files),
        roughness_(c.textures, d.parameters, "", d.parameters.get_bool("remaproughness", true)),
        band_(c.settings.specular_band) {}

  const Bsdf* make_bsdf(const SurfaceInteraction& point, SampledWavelengths& lambda,
                        float specular_alpha, BsdfArena& arena) const override {
    const DielectricInterface boundary{eta_.at_hero(lambda), roughness_.at(point)};
    return arena.make<DielectricBsdf>(boundary, specular_alpha);
  }
  std::optional<float> refractive_index() const override {
    return transmits_straight() ? std::nullopt : std::optional(eta_.at_550_nm());
  }
  bool transmits_straight() const override { return eta_.constant() == 1.0f; }
  SampledSpectrum straight_transmittance(const SurfaceInteraction&,
                                         const SampledWavelengths&) const override {
    return SampledSpectrum(transmits_straight() ? 1.0f : 0.0f);
  }
  ClassMask possible_classes() const override {
    return transmits_straight() ? ClassMask::kNone : roughness_.possible_classes(band_);
  }
  std::optional<float> facet_alpha() const override {
    return transmits_straight() ? std::nullopt : roughness_.constant_alpha();
  }

 private:
  IndexInput eta_;
  RoughnessInput roughness_;
  SpecularBand band_;
};

class ThinDielectricMaterial final : public SurfaceMaterial {
 public:
  ThinDielectricMaterial(const MaterialDescription& d, const MaterialContext& c)
      : SurfaceMaterial(d, c), eta_(d.parameters, "eta", c.files) {}

  const Bsdf* make_bsdf(const SurfaceInteraction&, SampledWavelengths& lambda, float,
                        BsdfArena& arena) const override {
    return arena.make<ThinDielectricBsdf>(eta_.at(lambda));
  }
  bool transmits_straight() const override { return true; }
  SampledSpectrum straight_transmittance(const SurfaceInteraction& point,
                                         const SampledWavelengths& lambda) const override {
    float cos_o = dot(point.wo, point.shading.z);
    if (has_bump()) {
      SurfaceInteraction bumped = point;
      bump(bumped);
      cos_o = dot(point.wo, bumped.shading.z);
    }
    return SampledSpectrum(1.0f) - ThinDielectricBsdf::pane_reflectance(cos_o, eta_.at(lambda));
  }
  ClassMask possible_classes() const override { return ClassMask::kSpecular; }

 private:
  IndexInput eta_;
};

}  // namespace

NewMaterial make_dielectric(const MaterialDescription& d, const MaterialContext& c) {
  return std::make_shared<DielectricMaterial>(d, c);
}

NewMaterial make_thin_dielectric(const MaterialDescription& d, const MaterialContext& c) {
  return std::make_shared<ThinDielectricMaterial>(d, c);
}

}  // namespace nephroid
