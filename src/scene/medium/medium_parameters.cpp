// Parameters that several media share: coefficients, factors, the phase function; see
// medium_table.h.
#include "scene/medium/medium_table.h"

namespace nephroid {

namespace {

DenseSpectrum read_coefficient(const ParameterSet& parameters, const std::string& name, float scale,
                               SceneFiles& files) {
  const Parameter* p = parameters.find(name);
  const SpectrumPtr spectrum =
      p ? spectrum_from_parameter(*p, SpectrumKind::kUnbounded, files) : constant_spectrum(1);
  return dense_spectrum(*spectrum, scale, p ? p->where : parameters.where, name);
}

}  // namespace

DenseSpectrum dense_spectrum(const Spectrum& spectrum, float scale, const SourceLocation& where,
                             const std::string& name) {
  std::array<float, kTableNodes> values;
  for (int i = 0; i < kTableNodes; ++i) {
    const float value = scale * spectrum(kLambdaMin + static_cast<float>(i));
    if (!(value >= 0.0f) || !std::isfinite(value))
      throw SceneError(where, "\"" + name +
                                  "\" is negative or too large at a visible wavelength, expected "
                                  "values from 0 to 1e38");
    values[i] = value;
  }
  return DenseSpectrum(values);
}

Extinction read_extinction(const ParameterSet& parameters, float scale, SceneFiles& files) {
  return {read_coefficient(parameters, "sigma_a", scale, files),
          read_coefficient(parameters, "sigma_s", scale, files)};
}

DenseSpectrum read_emission(const ParameterSet& parameters, float scale, SceneFiles& files) {
  const Parameter* p = parameters.find("Le");
  const SpectrumPtr le =
      p ? spectrum_from_parameter(*p, SpectrumKind::kIlluminant, files) : constant_spectrum(0);
  const float luminance = spectrum_to_photometric(*le);
  return dense_spectrum(*le, luminance > 0.0f ? scale / luminance : 0.0f,
                        p ? p->where : parameters.where, "Le");
}

float read_factor(const ParameterSet& parameters, const std::string& name, float fallback) {
  const float factor = parameters.get_float(name, fallback);
  if (!(factor >= 0.0f))
    throw SceneError(parameters.find(name)->where,
                     "a medium's \"" + name + "\" must be a number that is not negative");
  return factor;
}

HenyeyGreenstein read_phase(const ParameterSet& parameters) {
  const float g = parameters.get_float("g", 0.0f);
  if (!(std::abs(g) <= 1.0f))
    throw SceneError(parameters.find("g")->where,
                     "\"g\" is out of range, expected the mean cosine of scattering, from -1 to 1");
  return HenyeyGreenstein(g);
}

}  // namespace nephroid
