// Samples that a render left out because they were not finite, in sentences. It must not know where
// they come from.
#pragma once

#include <string>
#include <vector>

#include "film/film.h"
#include "scene/scene.h"

namespace nephroid {

/// A line for each route of which estimates were not finite, with how many, and the first pixel and
/// what is seen there; and one if sums reached their limit. Empty if nothing was left out.
std::vector<std::string> invalid_samples(const Scene& scene, const Film& film);
/// The same where there is no scene to look at.
std::vector<std::string> invalid_samples(const Film& film);

}  // namespace nephroid
