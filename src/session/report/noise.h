// Figures of a whole film: its estimated error and the shares of its routes in the light. It must
// not know passes or clocks.
#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "film/film.h"

namespace nephroid {

/// [F5] The film's estimated relative root mean square error: sqrt(mean over pixels and channels of
/// (stderr^2 + bias^2) / (value^2 + 0.01)). The noise of the bias estimate is subtracted from its
/// square. Empty while a group has fewer than two estimates.
struct EstimatedError {
  double noise = 0, bias = 0;
  double total() const { return std::hypot(noise, bias); }
};
std::optional<EstimatedError> estimated_error(const Film& film);
/// Estimated factor of passes for an error of `target`, above 0. Noise falls with the square root
/// of their number, the bias of merging with the cube root ([E2], alpha = 2/3).
double passes_to(const EstimatedError& error, double target);

/// The estimated error by its parts.
struct ErrorShares {
  std::vector<double> groups;  ///< [group]: noise
  double bias = 0;
};
/// Empty while a group has fewer than two estimates.
std::optional<ErrorShares> error_shares(const Film& film);

/// Shares of layers in the sum over all channels and pixels; zeros for a black film.
struct EnergyShares {
  std::vector<double> routes, aovs;
  double outliers = 0;  ///< share of held outliers in all light
};
EnergyShares energy_shares(const Film& film);

}  // namespace nephroid
