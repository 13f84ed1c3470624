// Refractive indices by the names of Mitsuba's substances, and by number. It must not know BSDFs.
#pragma once

#include <string>

#include "input/mitsuba/plugin_properties.h"

namespace nephroid::mitsuba {

/// The refractive index of a number or a name such as "bk7"; `fallback` is a name, too.
double refraction_index(PluginProperties& properties, const std::string& name,
                        const char* fallback);

/// Interior over exterior index: "int_ior" over "ext_ior", which is air by default.
double relative_index(PluginProperties& properties, const char* interior);

/// Reflectance of diffuse light that meets the boundary of a dielectric from inside, averaged by
/// its irradiance; `eta` is the relative index, above 1 for glass in air.
double internal_diffuse_reflectance(double eta);

}  // namespace nephroid::mitsuba
