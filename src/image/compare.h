// Errors of a picture against a reference: the figures of `nephroid compare` and its heat map.
// Works on linear RGB in the colour space of the reference, into which the test is converted;
// values that are not finite count as 1e6, so that they are visible but do not spread. It must not
// know films or scenes.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "film/image_io.h"

namespace nephroid {

struct CompareOptions {
  /// Subtracts the reference's own squared error (its stderr channels) from rmse, relmse and
  /// relmse_trim. The result estimates the error against the truth and may be negative.
  bool subtract_reference_error = false;
};

/// A relative mean error with half the width of its 95 % interval, if the error is known.
struct MeanRatio {
  double value = 0;  ///< mean of the test over mean of the reference, minus 1; NaN if that is 0
  std::optional<double> half_width;
  uint64_t pixels = 0;

  /// False if the reference is black.
  bool is_defined() const { return !std::isnan(value); }
};

/// Deviations z: the difference over its standard error, from the errors of both pictures.
struct Deviations {
  double share_within = 0;  ///< share of pixels with |z| < kDeviationLimit in all three channels
  double share_in_95 = 0;   ///< share of pixels and channels within their 95 % interval
  double rms = 0;           ///< root mean square of z; 1 if both errors are right
};
inline constexpr double kDeviationLimit = 3.3;

struct Comparison {
  bool is_same = false;  ///< R, G and B of both pictures are equal in every pixel
  double rmse = 0;
  double relmse = 0;       ///< mean over pixels and channels of (x - r)^2 / (r^2 + 0.01)
  double relmse_trim = 0;  ///< the same without the worst 0.1 % of pixels: one, or more of many
  MeanRatio mean;          ///< all pixels, no interval
  MeanRatio dim_mean;      ///< pixels whose reference is below 10 in every channel
  std::optional<Deviations>
      deviations;  ///< empty unless both pictures have stderr channels, in the same space
};

/// Throws UsageError if the sizes differ, if a picture has fewer than three channels, or if the
/// reference's error is to be subtracted and it has no stderr channels.
Comparison compare_pictures(const Picture& reference, const Picture& test,
                            const CompareOptions& options);

/// Squared relative error of each pixel, mean over channels, rows from the top.
std::vector<double> relative_squared_errors(const Picture& reference, const Picture& test);

/// Colours of the heat map: lightness rises with the logarithm of the squared relative error from
/// kHeatMin to kHeatMax; errors outside are clamped. Three sRGB bytes.
inline constexpr double kHeatMin = 1e-5, kHeatMax = 10;
struct HeatColor {
  uint8_t r = 0, g = 0, b = 0;
};
HeatColor heat_color(double squared_relative_error);

/// heat_color of each pixel as interleaved bytes.
std::vector<uint8_t> heat_map(const Picture& reference, const Picture& test);

/// Writes the heat map as PNG. Throws IoError.
void write_heat_map(const std::string& path, const Picture& reference, const Picture& test);

/// The scale of the heat map: a line "error  #rrggbb" per decade.
std::string heat_map_legend();

}  // namespace nephroid
