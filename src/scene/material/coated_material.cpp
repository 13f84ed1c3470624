// The materials "coateddiffuse" and "coatedconductor". They only choose the closed form where the
// coat is the same everywhere and does not scatter; they must not know how layers are evaluated.
#include <bit>

#include "core/sampler.h"
#include "scene/bsdf/coated.h"
#include "scene/bsdf/coated_diffuse.h"
#include "scene/material/metal_input.h"
#include "scene/material/surface_material.h"

namespace nephroid {
namespace {

/// pbrt-v4 reads "thickness" whatever the boundary's prefix.
std::string thickness_name(const ParameterSet& parameters, const std::string& prefix) {
  return parameters.find("thickness") ? "thickness" : prefix + "thickness";
}

/// A coat without its base. Parameter names of the boundary start with `prefix`.
class CoatInput {
 public:
  CoatInput(const MaterialDescription& d, const MaterialContext& c, const std::string& prefix)
      : eta_(d.parameters, prefix + "eta", c.files),
        roughness_(c.textures, d.parameters, prefix, d.parameters.get_bool("remaproughness", true)),
        thickness_(
            c.textures.float_texture(d.parameters, thickness_name(d.parameters, prefix), 0.01f)),
        albedo_(read_spectrum(c.textures, d.parameters, "albedo", SpectrumKind::kAlbedo, 0.0f)),
        g_(c.textures.float_texture(d.parameters, "g", 0.0f)),
        max_depth_(d.parameters.get_int("maxdepth", 10)),
        walks_(d.parameters.get_int("nsamples", 1)) {
    for (const auto& [name, value] : {std::pair{"maxdepth", max_depth_}, {"nsamples", walks_}})
      if (value < 1)
        throw SceneError(d.where, "\"" + std::string(name) + "\" is " + std::to_string(value) +
                                      ", expected at least 1");
  }

  Coat at(const SurfaceInteraction& point, SampledWavelengths& lambda) const {
    Coat coat;
    coat.boundary = {eta_.at_hero(lambda), roughness_.at(point)};
    coat.thickness = positive(thickness_.at(point));
    coat.albedo = clamp(albedo_.at(point, lambda), 0.0f, 1.0f);
    coat.scatters = !coat.albedo.is_black();
    coat.g = std::clamp(g_.at(point), -0.999f, 0.999f);
    coat.max_depth = max_depth_;
    coat.walks = walks_;
    for (const float x : {point.p.x, point.p.y, point.p.z, lambda.lambda(0)})
      coat.seed = hash_combine(coat.seed, std::bit_cast<uint32_t>(x));
    return coat;
  }

  /// The table of the closed form. Null if the coat varies, is anisotropic or scatters.
  std::shared_ptr<const CoatTable> table(CoatTableCache& cache) const {
    const auto facets = roughness_.constant();
    if (!albedo_.is_black() || !eta_.constant() || !thickness_.constant() || !facets ||
        facets->alpha_x() != facets->alpha_y())
      return nullptr;
    return cache.find_or_make({*eta_.constant(), *facets}, positive(*thickness_.constant()),
                              max_depth_);
  }

  /// False if the gap is known to only absorb.
  bool may_scatter() const { return !albedo_.is_black(); }
  /// Classes of the coat's own reflection.
  ClassMask possible_classes(const SpecularBand& band) const {
    return eta_.constant() == 1.0f ? ClassMask::kNone : roughness_.possible_classes(band);
  }
  std::optional<float> facet_alpha() const {
    return eta_.constant() == 1.0f ? std::nullopt : roughness_.constant_alpha();
  }

 private:
  static float positive(float thickness) {
    return std::max(thickness, std::numeric_limits<float>::min());
  }

  IndexInput eta_;
  RoughnessInput roughness_;
  FloatInput thickness_;
  SpectrumInput albedo_;
  FloatInput g_;
  int max_depth_, walks_;
};

class CoatedDiffuseMaterial final : public SurfaceMaterial {
 public:
  CoatedDiffuseMaterial(const MaterialDescription& d, const MaterialContext& c)
      : SurfaceMaterial(d, c),
        coat_(d, c, ""),
        reflectance_(
            read_spectrum(c.textures, d.parameters, "reflectance", SpectrumKind::kAlbedo, 0.5f)),
        band_(c.settings.specular_band),
        table_(coat_.table(*c.coat_tables)) {}

  const Bsdf* make_bsdf(const SurfaceInteraction& point, SampledWavelengths& lambda,
                        float specular_alpha, BsdfArena& arena) const override {
    const SampledSpectrum rho = clamp(reflectance_.at(point, lambda), 0.0f, 1.0f);
    if (table_) return arena.make<CoatedDiffuseBsdf>(table_.get(), rho, specular_alpha);
    return arena.make<CoatedBsdf<LambertSurface>>(coat_.at(point, lambda), LambertSurface{rho},
                                                  specular_alpha);
  }
  ClassMask possible_classes() const override {
    return ClassMask::kDiffuse | coat_.possible_classes(band_);
  }
  std::optional<float> facet_alpha() const override { return coat_.facet_alpha(); }

 private:
  CoatInput coat_;
  SpectrumInput reflectance_;
  SpecularBand band_;
  std::shared_ptr<const CoatTable> table_;
};

class CoatedConductorMaterial final : public SurfaceMaterial {
 public:
  CoatedConductorMaterial(const MaterialDescription& d, const MaterialContext& c)
      : SurfaceMaterial(d, c),
        coat_(d, c, "interface."),
        metal_(c.textures, d.parameters, "conductor."),
        roughness_(c.textures, d.parameters, "conductor.",
                   d.parameters.get_bool("remaproughness", true)),
        band_(c.settings.specular_band) {}

  const Bsdf* make_bsdf(const SurfaceInteraction& point, SampledWavelengths& lambda,
                        float specular_alpha, BsdfArena& arena) const override {
    const Coat coat = coat_.at(point, lambda);
    ConductorSurface metal;
    metal_.at(point, lambda, coat.boundary.eta, &metal.eta, &metal.k);
    metal.facets = roughness_.at(point);
    return arena.make<CoatedBsdf<ConductorSurface>>(coat, metal, specular_alpha);
  }
  ClassMask possible_classes() const override {
    // A medium between coat and metal scatters in all directions, whatever the roughnesses.
    const ClassMask medium = coat_.may_scatter() ? ClassMask::kDiffuse : ClassMask::kNone;
    return coat_.possible_classes(band_) | roughness_.possible_classes(band_) | medium;
  }
  std::optional<float> facet_alpha() const override {
    const std::optional<float> coat = coat_.facet_alpha(), metal = roughness_.constant_alpha();
    return coat && metal ? std::min(*coat, *metal) : coat ? coat : metal;
  }

 private:
  CoatInput coat_;
  MetalInput metal_;
  RoughnessInput roughness_;
  SpecularBand band_;
};

}  // namespace

NewMaterial make_coated_diffuse(const MaterialDescription& d, const MaterialContext& c) {
  return std::make_shared<CoatedDiffuseMaterial>(d, c);
}

NewMaterial make_coated_conductor(const MaterialDescription& d, const MaterialContext& c) {
  return std::make_shared<CoatedConductorMaterial>(d, c);
}

}  // namespace nephroid
