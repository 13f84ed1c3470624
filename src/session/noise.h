// Numbers about a whole film: how noisy it is and how its light divides among the routes.
// Who calls it: the render session and the report. It must not know passes or clocks.
#pragma once

#include <optional>
#include <vector>

#include "film/film.h"

namespace nephroid {

/// sqrt(mean over pixels and channels of stderr^2 / (value^2 + 0.01)): the relative root mean
/// square error that the film claims for itself. Empty while a group has fewer than two estimates.
std::optional<double> estimated_noise(const Film& film);

/// Shares in the sum of all channels of all pixels; zeros for a black film.
struct EnergyShares {
  std::vector<double> routes, aovs;
  double outliers = 0;  ///< what is held, over the sum with it
};
EnergyShares energy_shares(const Film& film);

}  // namespace nephroid
