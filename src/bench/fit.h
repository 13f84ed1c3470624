// Log-log fits and interpolation of measured points. It must not know where the points come from.
#pragma once

#include <optional>
#include <vector>

namespace nephroid {

struct CurvePoint {
  double x = 0, y = 0;
};

/// Exponent p of y ~ x^p by least squares of log y over log x. It uses the points of the second
/// half (x from half of the last x on), but at least the last three. Empty with fewer than three
/// points above 0, or if all have the same x.
std::optional<double> log_slope(const std::vector<CurvePoint>& points);

/// y at x by log-log interpolation of the neighbours. x increases from point to point. Empty
/// outside of the points, and if a neighbour is not above 0.
std::optional<double> log_interpolate(const std::vector<CurvePoint>& points, double x);

}  // namespace nephroid
