// The material "conductor", and the reading of a metal's index (metal_input.h). It must not know
// coats.
#include "scene/bsdf/conductor.h"
#include "scene/material/metal_input.h"
#include "scene/material/surface_material.h"

namespace nephroid {
namespace {

class ConductorMaterial final : public SurfaceMaterial {
 public:
  ConductorMaterial(const MaterialDescription& d, const MaterialContext& c)
      : SurfaceMaterial(d, c),
        metal_(c.textures, d.parameters, ""),
        roughness_(c.textures, d.parameters, "", d.parameters.get_bool("remaproughness", true)),
        band_(c.settings.specular_band) {}

  const Bsdf* make_bsdf(const SurfaceInteraction& point, SampledWavelengths& lambda,
                        float specular_alpha, BsdfArena& arena) const override {
    ConductorSurface surface;
    metal_.at(point, lambda, 1.0f, &surface.eta, &surface.k);
    surface.facets = roughness_.at(point);
    return arena.make<ConductorBsdf>(surface, specular_alpha);
  }
  ClassMask possible_classes() const override { return roughness_.possible_classes(band_); }
  std::optional<float> facet_alpha() const override { return roughness_.constant_alpha(); }

 private:
  MetalInput metal_;
  RoughnessInput roughness_;
  SpecularBand band_;
};

SpectrumInput metal_spectrum(const TextureLibrary& textures, const ParameterSet& parameters,
                             const std::string& name, const char* fallback) {
  SpectrumTexturePtr texture =
      textures.spectrum_texture(parameters, name, SpectrumKind::kUnbounded);
  if (!texture) texture = constant_spectrum_texture(named_spectrum(fallback));
  return SpectrumInput(std::move(texture));
}

}  // namespace

MetalInput::MetalInput(const TextureLibrary& textures, const ParameterSet& parameters,
                       const std::string& prefix) {
  reflectance_ =
      SpectrumInput(textures.spectrum_texture(parameters, "reflectance", SpectrumKind::kAlbedo));
  if (reflectance_.is_set()) {
    for (const char* name : {"eta", "k"})
      if (const Parameter* other = parameters.find(prefix + name))
        throw SceneError(other->where, "metal has both \"reflectance\" and \"" + prefix + name +
                                           "\", expected either a reflectance or eta and k");
    return;
  }
  eta_ = metal_spectrum(textures, parameters, prefix + "eta", "metal-Cu-eta");
  k_ = metal_spectrum(textures, parameters, prefix + "k", "metal-Cu-k");
}

NewMaterial make_conductor(const MaterialDescription& d, const MaterialContext& c) {
  return std::make_shared<ConductorMaterial>(d, c);
}

}  // namespace nephroid
