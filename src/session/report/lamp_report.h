// Which lights the picture is lit by, and why it is black. It must not know scenes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "film/film.h"
#include "integrator/estimator/estimator_statistics.h"

namespace nephroid {

/// The shares of lights in passes 0 to 7, brightest first, and notes on those that bring none.
/// Nothing if these passes were not rendered here, or some estimator does not tell lights apart.
std::vector<std::string> lamp_report(const std::vector<EstimatorStatistics>& statistics);

/// True if every pixel is zero in all routes.
bool is_black(const Film& film);
/// A line on a black picture, in place of its estimated error, with what is known of the cause.
std::string black_picture_report(const std::vector<EstimatorStatistics>& statistics);

}  // namespace nephroid
