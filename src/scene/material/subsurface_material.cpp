// The material "subsurface": a medium below a smooth or rough boundary, described by scattering
// coefficients or by its visible colour. It must not know how light finds its way out.
#include <fmt/format.h>

#include "input/spelling.h"
#include "scene/bsdf/subsurface_interface.h"
#include "scene/bsdf/tabulated_bssrdf.h"
#include "scene/material/inputs.h"
#include "scene/material/surface_material.h"
#include "scene/medium/scattering_presets.h"

namespace nephroid {
namespace {

// Whole milk of Jensen et al. 2001, per mm: pbrt-v4's default.
constexpr Rgb kDefaultSigmaA{0.0011f, 0.0024f, 0.014f};
constexpr Rgb kDefaultSigmaS{2.55f, 3.21f, 3.77f};

// Indices for which the fitted moments of the Fresnel term are valid.
constexpr float kMinEta = 0.4f, kMaxEta = 2.5f;

SpectrumInput rgb_constant(const Rgb& rgb) {
  return SpectrumInput(
      constant_spectrum_texture(rgb_unbounded_spectrum(RgbColorSpace::srgb(), rgb)));
}

/// Reads a float that the table needs: above `least` and below `most`.
float checked(const ParameterSet& parameters, const char* name, float fallback, float least,
              float most) {
  const float value = parameters.get_float(name, fallback);
  if (value > least && value < most) return value;
  throw SceneError(
      parameters.find(name)->where,
      fmt::format("\"{}\" is {}, expected a number between {} and {}", name, value, least, most));
}

class SubsurfaceMaterial final : public SurfaceMaterial {
 public:
  SubsurfaceMaterial(const MaterialDescription& d, const MaterialContext& c)
      : SurfaceMaterial(d, c),
        roughness_(c.textures, d.parameters, "", d.parameters.get_bool("remaproughness", true)),
        band_(c.settings.specular_band),
        scale_(d.parameters.get_float("scale", 1.0f)) {
    float g = checked(d.parameters, "g", 0.0f, -1.0f, 1.0f);
    const float eta = checked(d.parameters, "eta", 1.33f, kMinEta, kMaxEta);
    if (read_medium(d, c) && g != 0.0f) {
      c.diagnostics.warn(d.parameters.find("g")->where,
                         "\"g\" is ignored with a named medium: its reduced scattering "
                         "coefficients stand for g = 0");
      g = 0.0f;
    }
    table_ = c.bssrdf_tables->find_or_make(g, eta);
  }

  const Bsdf* make_bsdf(const SurfaceInteraction& point, SampledWavelengths&, float specular_alpha,
                        BsdfArena& arena) const override {
    const DielectricInterface boundary{table_->eta(), roughness_.at(point)};
    return arena.make<SubsurfaceInterfaceBsdf>(boundary, specular_alpha);
  }
  const Bssrdf* make_bssrdf(const SurfaceInteraction& point, const SampledWavelengths& lambda,
                            BsdfArena& arena) const override {
    SampledSpectrum sigma_a, sigma_s;
    if (reflectance_.is_set()) {
      const SampledSpectrum path = positive(mfp_.at(point, lambda) * scale_);
      const SampledSpectrum seen = clamp(reflectance_.at(point, lambda), 0.0f, 1.0f);
      for (int i = 0; i < kSpectrumSamples; ++i) {
        const float sigma_t = path[i] > 0.0f ? 1.0f / path[i] : 0.0f;
        const float albedo = table_->invert_effective_albedo(seen[i]);
        sigma_s.set(i, albedo * sigma_t);
        sigma_a.set(i, (1.0f - albedo) * sigma_t);
      }
    } else {
      sigma_a = positive(sigma_a_.at(point, lambda) * scale_);
      sigma_s = positive(sigma_s_.at(point, lambda) * scale_);
    }
    return arena.make<TabulatedBssrdf>(point.p, point.shading.z, sigma_a, sigma_s, table_.get(),
                                       lambda.left());
  }
  bool has_bssrdf() const override { return true; }
  ClassMask possible_classes() const override {
    if (table_->eta() == 1.0f) return ClassMask::kDiffuse;
    return ClassMask::kDiffuse | roughness_.possible_classes(band_);
  }
  std::optional<float> facet_alpha() const override {
    return table_->eta() == 1.0f ? std::nullopt : roughness_.constant_alpha();
  }

 private:
  static SampledSpectrum positive(const SampledSpectrum& s) { return clamp(s, 0.0f, kInfinity); }

  /// Reads the medium in one of its four ways. True if it is a named medium.
  bool read_medium(const MaterialDescription& d, const MaterialContext& c) {
    const std::string name = d.parameters.get_string("name", "");
    if (!name.empty()) {
      const std::optional<ScatteringPreset> preset = scattering_preset(name);
      if (!preset)
        throw SceneError(d.parameters.find("name")->where,
                         fmt::format("there is no measured medium \"{}\"{} (expected a substance "
                                     "such as \"Skin1\" or \"Regular Milk\")",
                                     name, did_you_mean(name, scattering_preset_names())));
      sigma_a_ = rgb_constant(preset->sigma_a);
      sigma_s_ = rgb_constant(preset->sigma_s);
      return true;
    }
    const auto read = [&](const char* parameter, SpectrumKind kind) {
      return SpectrumInput(c.textures.spectrum_texture(d.parameters, parameter, kind));
    };
    sigma_a_ = read("sigma_a", SpectrumKind::kUnbounded);
    sigma_s_ = read("sigma_s", SpectrumKind::kUnbounded);
    if (sigma_a_.is_set() != sigma_s_.is_set()) {
      const char* given = sigma_a_.is_set() ? "sigma_a" : "sigma_s";
      const char* missing = sigma_a_.is_set() ? "sigma_s" : "sigma_a";
      throw SceneError(
          d.parameters.find(given)->where,
          fmt::format("\"{}\" is given without \"{}\", expected both", given, missing));
    }
    if (sigma_a_.is_set()) return false;
    reflectance_ = read("reflectance", SpectrumKind::kAlbedo);
    if (reflectance_.is_set()) {
      mfp_ = read_spectrum(c.textures, d.parameters, "mfp", SpectrumKind::kUnbounded, 1.0f);
    } else {
      sigma_a_ = rgb_constant(kDefaultSigmaA);
      sigma_s_ = rgb_constant(kDefaultSigmaS);
    }
    return false;
  }

  RoughnessInput roughness_;
  SpecularBand band_;
  float scale_;
  SpectrumInput sigma_a_, sigma_s_, reflectance_, mfp_;
  std::shared_ptr<const BssrdfTable> table_;
};

}  // namespace

NewMaterial make_subsurface(const MaterialDescription& d, const MaterialContext& c) {
  return std::make_shared<SubsurfaceMaterial>(d, c);
}

}  // namespace nephroid
