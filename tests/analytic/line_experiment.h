// The one-dimensional validation of Hachisuka & Jensen 2009, equations [E3] of docs/estimators.md.
// Photons of a known density fall on a line. Regions gather them with shared statistics [E1] and
// with the memoryless radius [E2], and errors are against the known mean.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace nephroid {

/// Densities on the closed line [0, 1), each with integral 1.
enum class LineDensity {
  kFlat,  ///< 1
  kWave,  ///< 1 + 0.8 cos(2 pi x)
  kStep,  ///< 1.6 in the first half, 0.4 in the second
};

/// Density at x in [0, 1), per unit length.
double line_density(LineDensity density, double x);
/// Mean density over [center - width/2, center + width/2], width at most 1. Width 0: the density at
/// the centre.
double line_mean(LineDensity density, double center, double width);

struct LineSettings {
  LineDensity density = LineDensity::kWave;
  double center = 0;         ///< centre of all regions
  double radius = 0.05;      ///< radius of the first pass, below 1/4
  double alpha = 2.0 / 3.0;  ///< alpha of [E1] and [E2]
  int photons_per_pass = 50000;
  uint32_t passes = 1000;
  uint64_t seed = 0;
};

/// Estimate minus truth, per unit length, after some passes.
struct LineError {
  uint32_t passes = 0;
  double shared = 0;      ///< error of [E1]
  double memoryless = 0;  ///< error of [E2]
};

/// Errors of regions of these widths after 1, 2, 4, 8 ... passes, as [region][power of two]. Each
/// pass gathers around one point, distributed uniformly over the region. Pure function.
std::vector<std::vector<LineError>> line_errors(const LineSettings& settings,
                                                std::span<const double> widths);

/// Slope of log|error| over log(passes) by least squares. Points without error are skipped.
double line_slope(std::span<const uint32_t> passes, std::span<const double> errors);

}  // namespace nephroid
