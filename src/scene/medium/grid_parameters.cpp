// Parameters of media on regular grids; see grid_parameters.h.
#include "scene/medium/grid_parameters.h"

#include <optional>

#include "core/counted.h"

namespace nephroid {

namespace {

/// nx*ny*nz. Empty beyond 2^40, which no array of a scene file reaches.
std::optional<uint64_t> sample_count(const std::array<int, 3>& resolution) {
  uint64_t count = 1;
  for (const int n : resolution) {
    count *= n;
    if (count > uint64_t{1} << 40) return std::nullopt;
  }
  return count;
}

std::string product(const std::array<int, 3>& n) {
  return std::to_string(n[0]) + " x " + std::to_string(n[1]) + " x " + std::to_string(n[2]);
}

void expect_samples(const Parameter& p, const std::array<int, 3>& resolution,
                    size_t numbers_per_item) {
  const auto count = sample_count(resolution);
  if (count && p.numbers.size() == *count * numbers_per_item) return;
  throw SceneError(p.where, "\"" + p.name + "\" has " +
                                counted(p.numbers.size() / numbers_per_item, "value") +
                                ", expected nx x ny x nz = " + product(resolution) +
                                (count ? " = " + std::to_string(*count) : ""));
}

}  // namespace

std::array<int, 3> read_grid_resolution(const MediumDescription& description,
                                        const std::string& data, size_t numbers_per_item) {
  const ParameterSet& p = description.parameters;
  const Parameter* values = p.find(data);
  if (!values)
    throw SceneError(description.where, "medium \"" + description.name + "\" has no \"" + data +
                                            "\", expected the values of its grid");
  std::array<int, 3> resolution{};
  const char* names[3] = {"nx", "ny", "nz"};
  for (int i = 0; i < 3; ++i) {
    resolution[i] = p.get_int(names[i], 1);
    if (resolution[i] < 1)
      throw SceneError(p.find(names[i])->where, std::string("\"") + names[i] + "\" is " +
                                                    std::to_string(resolution[i]) +
                                                    ", expected at least 1");
  }
  expect_samples(*values, resolution, numbers_per_item);
  return resolution;
}

std::vector<float> read_grid_floats(const MediumDescription& description, const std::string& name,
                                    const std::array<int, 3>& resolution, bool may_be_negative) {
  std::vector<float> values = description.parameters.get_floats(name);
  const Parameter& p = *description.parameters.find(name);
  expect_samples(p, resolution, 1);
  for (size_t i = 0; i < values.size(); ++i)
    if (values[i] < 0.0f && !may_be_negative)
      throw SceneError(p.where, "value " + std::to_string(i) + " of \"" + name +
                                    "\" is negative, expected 0 or more");
  return values;
}

SampledSpectrum TemperatureMap::blackbody(float value, const SampledWavelengths& lambda) const {
  const float kelvin = (value - offset) * scale;
  if (!(kelvin > 100.0f) || !std::isfinite(kelvin)) return SampledSpectrum();
  return sample_blackbody(kelvin, lambda);
}

TemperatureMap read_temperature_map(const ParameterSet& parameters) {
  const float cutoff = parameters.get_float("temperaturecutoff", 0.0f);
  return {parameters.get_float("temperatureoffset", cutoff),
          parameters.get_float("temperaturescale", 1.0f)};
}

}  // namespace nephroid
