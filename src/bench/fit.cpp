#include "bench/fit.h"

#include <algorithm>
#include <cmath>

namespace nephroid {

std::optional<double> log_slope(const std::vector<CurvePoint>& points) {
  constexpr size_t kMinPoints = 3;
  std::vector<CurvePoint> logs;
  for (const CurvePoint& p : points)
    if (p.x > 0 && p.y > 0) logs.push_back({std::log(p.x), std::log(p.y)});
  if (logs.size() < kMinPoints) return std::nullopt;
  // The second half of the run, with room for rounding.
  const double from = logs.back().x - std::log(2.0) - 1e-9;
  size_t begin = 0;
  while (begin + kMinPoints < logs.size() && logs[begin].x < from) ++begin;

  const double n = static_cast<double>(logs.size() - begin);
  double mean_x = 0, mean_y = 0, xx = 0, xy = 0;
  for (size_t i = begin; i < logs.size(); ++i) {
    mean_x += logs[i].x / n;
    mean_y += logs[i].y / n;
  }
  for (size_t i = begin; i < logs.size(); ++i) {
    const double dx = logs[i].x - mean_x;
    xx += dx * dx;
    xy += dx * (logs[i].y - mean_y);
  }
  if (!(xx > 0)) return std::nullopt;
  return xy / xx;
}

std::optional<double> log_interpolate(const std::vector<CurvePoint>& points, double x) {
  // The last of several points at the same x counts: many passes may read the same photons.
  const auto after =
      std::find_if(points.begin(), points.end(), [&](const CurvePoint& p) { return p.x > x; });
  if (after == points.begin()) return std::nullopt;
  if ((after - 1)->x == x) return (after - 1)->y;
  if (after == points.end()) return std::nullopt;
  const CurvePoint &a = *(after - 1), &b = *after;
  if (!(a.x > 0 && a.y > 0 && b.y > 0)) return std::nullopt;
  const double t = std::log(x / a.x) / std::log(b.x / a.x);
  return a.y * std::pow(b.y / a.y, t);
}

}  // namespace nephroid
