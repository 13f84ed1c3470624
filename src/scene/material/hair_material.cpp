// The material "hair": a fibre coloured by absorption, by the reflectance of many fibres together,
// or by pigments. It must not know curves. Papers: Chiang et al. 2016 (fit from reflectance); d'Eon
// et al. 2011 (pigments).
#include "scene/bsdf/hair.h"
#include "scene/material/inputs.h"
#include "scene/material/table.h"

namespace nephroid {
namespace {

/// The smallest rendered roughness, as in pbrt-v4.
constexpr float kSmallestBeta = 0.01f;

/// Absorption by pigment concentrations, as linear sRGB converted to a spectrum.
SpectrumPtr pigment_absorption(float eumelanin, float pheomelanin) {
  return rgb_unbounded_spectrum(RgbColorSpace::srgb(), Rgb{0.419f, 0.697f, 1.37f} * eumelanin +
                                                           Rgb{0.187f, 0.4f, 1.05f} * pheomelanin);
}

/// Absorption of fibres that together reflect `reflectance`, at roughness beta_n.
SampledSpectrum absorption_of(const SampledSpectrum& reflectance, float beta_n) {
  const float b = beta_n;
  const float scale =
      5.969f + b * (-0.215f + b * (2.532f + b * (-10.73f + b * (5.574f + b * 0.245f))));
  // Black absorbs strongly, not infinitely.
  return reflectance.map(
      [scale](float c) { return sqr(std::log(std::clamp(c, 1e-20f, 1.0f)) / scale); });
}

class HairMaterial final : public Material {
 public:
  HairMaterial(const MaterialDescription& d, const MaterialContext& c)
      : eta_(c.textures.float_texture(d.parameters, "eta", 1.55f)),
        beta_m_(c.textures.float_texture(d.parameters, "beta_m", 0.3f)),
        beta_n_(c.textures.float_texture(d.parameters, "beta_n", 0.3f)),
        tilt_(c.textures.float_texture(d.parameters, "alpha", 2.0f)) {
    if (eta_.constant() && !(*eta_.constant() > 0.0f))
      throw SceneError(d.parameters.find("eta")->where,
                       "\"eta\" of hair is not positive, expected a refractive index");
    for (const char* name : {"beta_m", "beta_n"}) {
      const Parameter* number = d.parameters.find(name, {"float"});
      if (number && !(number->numbers[0] >= 0.0 && number->numbers[0] <= 1.0))
        throw SceneError(number->where,
                         "\"" + std::string(name) +
                             "\" of hair is out of range, expected a roughness from 0 "
                             "to 1");
    }
    read_color(d, c);
  }

  const Bsdf* make_bsdf(const SurfaceInteraction& point, SampledWavelengths& lambda, float,
                        BsdfArena& arena) const override {
    const float beta_n = std::clamp(beta_n_.at(point), kSmallestBeta, 1.0f);
    const HairShape shape(std::clamp(beta_m_.at(point), kSmallestBeta, 1.0f), beta_n,
                          tilt_.at(point));
    const float eta = std::max(eta_.at(point), 1e-3f);
    return arena.make<HairBsdf>(2.0f * point.uv.y - 1.0f, eta, absorption(point, lambda, beta_n),
                                shape);
  }
  ClassMask possible_classes() const override { return ClassMask::kDiffuse; }
  bool merges_photons() const override { return false; }

 private:
  // One of sigma_a, reflectance (also called color) and pigments; the first that is given.
  void read_color(const MaterialDescription& d, const MaterialContext& c) {
    const ParameterSet& p = d.parameters;
    const char* const names[] = {"sigma_a", "reflectance", "color", "eumelanin", "pheomelanin"};
    const char* used = nullptr;
    for (const char* name : names) {
      const Parameter* found = p.find(name);
      if (!found) continue;
      if (!used)
        used = name;
      else if (std::string(used) != "eumelanin")
        c.diagnostics.warn(found->where, "\"" + std::string(name) + "\" is ignored, \"" + used +
                                             "\" colours this hair");
    }
    const std::string by = used ? used : "";
    if (by == "sigma_a") {
      sigma_a_ = SpectrumInput(c.textures.spectrum_texture(p, by, SpectrumKind::kUnbounded));
    } else if (by == "reflectance" || by == "color") {
      reflectance_ = SpectrumInput(c.textures.spectrum_texture(p, by, SpectrumKind::kAlbedo));
    } else if (by.empty()) {
      // Brown hair.
      sigma_a_ = SpectrumInput(constant_spectrum_texture(pigment_absorption(1.3f, 0.0f)));
    } else {
      eumelanin_ = FloatInput(c.textures.float_texture(p, "eumelanin", 0.0f));
      pheomelanin_ = FloatInput(c.textures.float_texture(p, "pheomelanin", 0.0f));
      if (eumelanin_.constant() && pheomelanin_.constant())
        sigma_a_ = SpectrumInput(constant_spectrum_texture(pigment_absorption(
            std::max(0.0f, *eumelanin_.constant()), std::max(0.0f, *pheomelanin_.constant()))));
    }
  }

  SampledSpectrum absorption(const SurfaceInteraction& point, const SampledWavelengths& lambda,
                             float beta_n) const {
    if (sigma_a_.is_set()) return clamp(sigma_a_.at(point, lambda), 0.0f, kInfinity);
    if (reflectance_.is_set()) return absorption_of(reflectance_.at(point, lambda), beta_n);
    return pigment_absorption(std::max(0.0f, eumelanin_.at(point)),
                              std::max(0.0f, pheomelanin_.at(point)))
        ->sample(lambda);
  }

  FloatInput eta_, beta_m_, beta_n_, tilt_;
  SpectrumInput sigma_a_, reflectance_;  ///< at most one is set; if none, the pigments apply
  FloatInput eumelanin_, pheomelanin_;
};

}  // namespace

NewMaterial make_hair(const MaterialDescription& d, const MaterialContext& c) {
  return std::make_shared<HairMaterial>(d, c);
}

}  // namespace nephroid
