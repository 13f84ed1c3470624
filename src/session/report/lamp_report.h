// Reports the shares of lights in the picture, or why it is black. It must not know scenes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "film/film.h"
#include "integrator/estimator/estimator_statistics.h"

namespace nephroid {

/// Shares of lights in passes 0 to 7, brightest first, and notes on lights without any. Empty if
/// these passes were not rendered here, or if an estimator does not count lamps separately.
std::vector<std::string> lamp_report(const std::vector<EstimatorStatistics>& statistics);

/// True if every pixel is zero in all routes.
bool is_black(const Film& film);
/// A line on a black picture with its likely cause, in place of the estimated error.
std::string black_picture_report(const std::vector<EstimatorStatistics>& statistics);

}  // namespace nephroid
