// Numbers about a whole film: how far off it is and how its light divides among the routes. It must
// not know passes or clocks.
#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "film/film.h"

namespace nephroid {

/// sqrt(mean over pixels and channels of (stderr^2 + bias^2) / (value^2 + 0.01)): the relative root
/// mean square error that the film claims for itself; the noise of the bias is taken out of its
/// square, [F5]. Empty while a group has fewer than two estimates.
struct EstimatedError {
  double noise = 0, bias = 0;
  double total() const { return std::hypot(noise, bias); }
};
std::optional<EstimatedError> estimated_error(const Film& film);
/// How many times as many passes have an error of `target`, above 0, as it looks now: noise falls
/// with the square root of their number, the bias of merging with the cube root ([E2], alpha =
/// 2/3).
double passes_to(const EstimatedError& error, double target);

/// The same by parts.
struct ErrorShares {
  std::vector<double> groups;  ///< noise of the estimates of each group
  double bias = 0;
};
/// Empty while a group has fewer than two estimates.
std::optional<ErrorShares> error_shares(const Film& film);

/// Shares in the sum of all channels of all pixels; zeros for a black film.
struct EnergyShares {
  std::vector<double> routes, aovs;
  double outliers = 0;  ///< what is held, over the sum with it
};
EnergyShares energy_shares(const Film& film);

}  // namespace nephroid
