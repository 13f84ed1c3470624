// Parameters common to media on regular grids: resolution, arrays that fit it, and temperatures. It
// must not know how grids are looked up.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/spectra.h"
#include "input/scene_description.h"
#include "scene/medium/medium_space.h"
#include "scene/medium/sampled_grid.h"

namespace nephroid {

/// Majorant cells of a regular grid, as in pbrt-v4.
inline constexpr std::array<int, 3> kGridMajorants = {16, 16, 16};

/// Reads "nx", "ny" and "nz", each 1 by default. Throws SceneError unless they are positive and the
/// mandatory parameter `data` has nx*ny*nz items of `numbers_per_item` numbers.
std::array<int, 3> read_grid_resolution(const MediumDescription& description,
                                        const std::string& data, size_t numbers_per_item);

/// Reads the mandatory parameter `name`: nx*ny*nz floats, x running fastest. Throws SceneError for
/// another count, for values that are not finite, and for negative ones unless `may_be_negative`.
std::vector<float> read_grid_floats(const MediumDescription& description, const std::string& name,
                                    const std::array<int, 3>& resolution,
                                    bool may_be_negative = false);

/// Maps the temperatures of a file to kelvin: (value - offset) * scale.
struct TemperatureMap {
  float offset = 0, scale = 1;
  /// Planck's law at a value of the file, normalised to a maximum of 1; black up to 100 K, as in
  /// pbrt-v4.
  SampledSpectrum blackbody(float value, const SampledWavelengths& lambda) const;
};
/// Reads "temperatureoffset" (or its old name "temperaturecutoff") and "temperaturescale".
TemperatureMap read_temperature_map(const ParameterSet& parameters);

}  // namespace nephroid
