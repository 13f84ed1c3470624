// A medium that is the same everywhere (pbrt-v4 section 11.4.1). It must not know its boundaries.
#include "input/spelling.h"
#include "scene/medium/medium_table.h"
#include "scene/medium/scattering_presets.h"

namespace nephroid {

namespace {

class HomogeneousMedium final : public Medium {
 public:
  HomogeneousMedium(const Extinction& extinction, const DenseSpectrum& le, HenyeyGreenstein phase)
      : extinction_(extinction), le_(le), phase_(phase) {
    emissive_ = le.max_value() > 0.0f && extinction.sigma_a.max_value() > 0.0f;
    absorbing_ = !(extinction.sigma_s.max_value() > 0.0f);
  }

  bool is_emissive() const override { return emissive_; }
  bool is_purely_absorbing() const override { return absorbing_; }
  std::optional<SampledSpectrum> uniform_extinction(
      const SampledWavelengths& lambda) const override {
    return extinction_.sigma_a.sample(lambda) + extinction_.sigma_s.sample(lambda);
  }
  MediumProperties at(const Vec3f&, const SampledWavelengths& lambda) const override {
    return {extinction_.sigma_a.sample(lambda), extinction_.sigma_s.sample(lambda),
            emissive_ ? le_.sample(lambda) : SampledSpectrum(), phase_};
  }
  MajorantIterator majorants(const Ray&, float t_max,
                             const SampledWavelengths& lambda) const override {
    return MajorantIterator({0.0f, t_max, *uniform_extinction(lambda)});
  }

 private:
  Extinction extinction_;
  DenseSpectrum le_;  ///< "Le" times "Lescale", over the luminance of "Le"
  HenyeyGreenstein phase_;
  bool emissive_, absorbing_;
};

/// The coefficients of a "preset", which overrides "sigma_a" and "sigma_s". They are sRGB, whatever
/// the current colour space.
Extinction preset_extinction(const std::string& name, const SourceLocation& where, float scale) {
  const auto preset = scattering_preset(name);
  if (!preset)
    throw SceneError(where, "unknown preset \"" + name + "\"" +
                                did_you_mean(name, scattering_preset_names()) +
                                " (expected a substance such as \"Skin1\" or \"Regular Milk\")");
  const RgbColorSpace& srgb = RgbColorSpace::srgb();
  return {dense_spectrum(*rgb_unbounded_spectrum(srgb, preset->sigma_a), scale, where, "preset"),
          dense_spectrum(*rgb_unbounded_spectrum(srgb, preset->sigma_s), scale, where, "preset")};
}

}  // namespace

NewMedium make_homogeneous_medium(const MediumDescription& description, const MediumScope& scope) {
  const ParameterSet& p = description.parameters;
  const float scale = read_scale(p);
  const std::string preset = p.get_string("preset", "");
  const Extinction extinction = preset.empty()
                                    ? read_extinction(p, scale, scope.files)
                                    : preset_extinction(preset, p.find("preset")->where, scale);
  return std::make_shared<HomogeneousMedium>(
      extinction, read_emission(p, read_factor(p, "Lescale", 1.0f), scope.files), read_phase(p));
}

}  // namespace nephroid
