// Measured scattering coefficients of milk, skin, juices ... by pbrt-v4's names: Jensen, Marschner,
// Levoy & Hanrahan 2001, "A Practical Model for Subsurface Light Transport", and Narasimhan, Gupta,
// Donner, Ramamoorthi, Nayar & Jensen 2006, "Acquiring Scattering Properties of Participating Media
// by Dilution". Who calls it: media and subsurface materials. It must not know what uses them.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/color.h"

namespace nephroid {

/// Coefficients in 1/mm as linear sRGB. The scattering coefficient is the reduced one, which stands
/// for the true one times 1 - g: it belongs to an isotropic phase function.
struct ScatteringPreset {
  Rgb sigma_s, sigma_a;
};

/// The coefficients of a substance; empty for a name that the table does not have.
std::optional<ScatteringPreset> scattering_preset(std::string_view name);

/// All names, in the order of the papers, for messages.
std::vector<std::string> scattering_preset_names();

}  // namespace nephroid
