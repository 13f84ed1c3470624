// Mitsuba's sun and sky as lights of pbrt-v4, and the frame of its environment maps.
#pragma once

#include "input/mitsuba/plugin.h"

namespace nephroid::mitsuba {

/// From the frame of pbrt-v4's latitude-longitude maps (+z up, phi from +x) to Mitsuba's: +y up,
/// the left edge of the image at -z, its first quarter at +x.
Mat44d environment_frame();

inline constexpr const char* kSkyNote =
    "the sky is that of Hosek and Wilkie (2012) in rgb, the sun that of Preetham et al. (1999)";

void write_sky(PluginProperties& properties, LightDescription& light);
void write_sun(PluginProperties& properties, LightDescription& light);
/// The sun becomes a light of its own.
void write_sun_and_sky(PluginProperties& properties, LightDescription& light);

}  // namespace nephroid::mitsuba
