// Mitsuba's films, reconstruction filters and samplers as directives of pbrt-v4.
#pragma once

#include <string>
#include <vector>

#include "input/mitsuba/plugin.h"

namespace nephroid::mitsuba {

struct FilmSize {
  int width = 0, height = 0;  ///< pixels of the full picture
  double aspect() const { return static_cast<double>(width) / height; }
};

/// Sets film and pixel filter from the sensor's film, or from Mitsuba's default.
FilmSize write_film(PluginProperties& sensor, const std::string& scene_name);

void write_sampler(PluginProperties& sensor);

std::vector<Plugin> film_plugins();

}  // namespace nephroid::mitsuba
