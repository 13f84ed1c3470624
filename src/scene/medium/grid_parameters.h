// What the parameters of media on regular grids have in common: the resolution, arrays that fit it,
// and temperatures. Who calls it: the makers of media. It must not know how grids are looked up.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/spectra.h"
#include "input/scene_description.h"
#include "scene/medium/medium_space.h"
#include "scene/medium/sampled_grid.h"

namespace nephroid {

/// Cells of the majorants of a regular grid, as in pbrt-v4.
inline constexpr std::array<int, 3> kGridMajorants = {16, 16, 16};

/// "nx", "ny" and "nz", each 1 if absent. Throws SceneError unless they are positive and the
/// parameter `data`, which must be there, has nx*ny*nz items of `numbers_per_item` numbers.
std::array<int, 3> read_grid_resolution(const MediumDescription& description,
                                        const std::string& data, size_t numbers_per_item);

/// The parameter `name`, which must be there: nx*ny*nz floats, x running fastest. Throws SceneError
/// for another number of them, for values that are not finite and, unless `may_be_negative`, for
/// negative ones.
std::vector<float> read_grid_floats(const MediumDescription& description, const std::string& name,
                                    const std::array<int, 3>& resolution,
                                    bool may_be_negative = false);

/// Temperatures of a file as kelvin: (value - offset) * scale.
struct TemperatureMap {
  float offset = 0, scale = 1;
  /// Planck's law with a maximum of 1 at a value of the file; black up to 100 K, as in pbrt-v4.
  SampledSpectrum blackbody(float value, const SampledWavelengths& lambda) const;
};
/// "temperatureoffset" (or its old name "temperaturecutoff") and "temperaturescale".
TemperatureMap read_temperature_map(const ParameterSet& parameters);

}  // namespace nephroid
