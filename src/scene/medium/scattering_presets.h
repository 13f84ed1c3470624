// Measured scattering coefficients of milk, skin, juices and others, by pbrt-v4's names. It must
// not know what uses them. Papers: Jensen et al. 2001, A Practical Model for Subsurface Light
// Transport; Narasimhan et al. 2006, Acquiring Scattering Properties of Participating Media by
// Dilution.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/color.h"

namespace nephroid {

/// Coefficients in 1/mm as linear sRGB. Scattering is the reduced coefficient, the true one times 1
/// - g, which belongs to an isotropic phase function.
struct ScatteringPreset {
  Rgb sigma_s, sigma_a;
};

/// The coefficients of a substance. Empty for a name that is not in the table.
std::optional<ScatteringPreset> scattering_preset(std::string_view name);

/// All names, in the order of the papers, for messages.
std::vector<std::string> scattering_preset_names();

}  // namespace nephroid
