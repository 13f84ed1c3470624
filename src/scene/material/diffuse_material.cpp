// The materials "diffuse" and "diffusetransmission". They must not know how textures are stored.
#include "scene/bsdf/diffuse.h"
#include "scene/material/inputs.h"
#include "scene/material/surface_material.h"

namespace nephroid {
namespace {

class DiffuseMaterial final : public SurfaceMaterial {
 public:
  DiffuseMaterial(const MaterialDescription& d, const MaterialContext& c)
      : SurfaceMaterial(d, c),
        reflectance_(
            read_spectrum(c.textures, d.parameters, "reflectance", SpectrumKind::kAlbedo, 0.5f)) {}

  const Bsdf* make_bsdf(const SurfaceInteraction& point, SampledWavelengths& lambda, float,
                        BsdfArena& arena) const override {
    return arena.make<DiffuseBsdf>(clamp(reflectance_.at(point, lambda), 0.0f, 1.0f));
  }
  ClassMask possible_classes() const override { return ClassMask::kDiffuse; }

 private:
  SpectrumInput reflectance_;
};

class DiffuseTransmissionMaterial final : public SurfaceMaterial {
 public:
  DiffuseTransmissionMaterial(const MaterialDescription& d, const MaterialContext& c)
      : SurfaceMaterial(d, c),
        reflectance_(
            read_spectrum(c.textures, d.parameters, "reflectance", SpectrumKind::kAlbedo, 0.25f)),
        transmittance_(
            read_spectrum(c.textures, d.parameters, "transmittance", SpectrumKind::kAlbedo, 0.25f)),
        scale_(d.parameters.get_float("scale", 1.0f)) {}

  const Bsdf* make_bsdf(const SurfaceInteraction& point, SampledWavelengths& lambda, float,
                        BsdfArena& arena) const override {
    return arena.make<DiffuseTransmissionBsdf>(
        clamp(reflectance_.at(point, lambda) * scale_, 0.0f, 1.0f),
        clamp(transmittance_.at(point, lambda) * scale_, 0.0f, 1.0f));
  }
  ClassMask possible_classes() const override { return ClassMask::kDiffuse; }

 private:
  SpectrumInput reflectance_, transmittance_;
  float scale_;
};

}  // namespace

NewMaterial make_diffuse(const MaterialDescription& d, const MaterialContext& c) {
  return std::make_shared<DiffuseMaterial>(d, c);
}

NewMaterial make_diffuse_transmission(const MaterialDescription& d, const MaterialContext& c) {
  return std::make_shared<DiffuseTransmissionMaterial>(d, c);
}

}  // namespace nephroid
