// Reports invalid samples: left out because they were not finite. It must not know their cause.
#pragma once

#include <string>
#include <vector>

#include "film/film.h"
#include "scene/scene.h"

namespace nephroid {

/// A line for each route with invalid estimates: their number, the first pixel, and the material
/// seen there. Another line if sums reached their limit. Empty if nothing was left out.
std::vector<std::string> invalid_samples(const Scene& scene, const Film& film);
/// The same without a scene: the material is left out.
std::vector<std::string> invalid_samples(const Film& film);

}  // namespace nephroid
