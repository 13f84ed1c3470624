// Catmull-Rom splines through unequally spaced points: values, integrals and their inverses. The
// slope at a point is that of the line between its neighbours, at the ends that of the first or
// last interval. It must not know what is tabulated. Sources: Catmull & Rom 1974; pbrt-v4 section
// A.5 (slopes at the ends).
#pragma once

#include <array>
#include <optional>
#include <span>
#include <utility>

#include "core/math.h"

namespace nephroid {

/// A linear combination of four neighbouring values. Those with weight 0 may not exist.
struct SplineWeights {
  int first = 0;
  std::array<float, 4> w{};

  /// Sum of weight times `value(i)`, i the index of the point.
  template <class Value>
  float of(Value&& value) const {
    float sum = 0.0f;
    for (int j = 0; j < 4; ++j)
      if (w[j] != 0.0f) sum += w[j] * value(first + j);
    return sum;
  }
};

/// Index of the interval of the ascending points `x` that holds `at`; the last point belongs to the
/// last interval. Empty outside of the points, and for NaN.
std::optional<int> spline_interval(std::span<const float> x, float at);

/// Weights of the spline's value at `at`. Empty outside of the points.
std::optional<SplineWeights> spline_value(std::span<const float> x, float at);

/// The slope at an end of an interval times the interval's width:
/// scale * (value(to) - value(from)).
struct SplineSlope {
  int from = 0, to = 0;
  float scale = 1;
};
/// The slope at the start of interval `i`, and at its end.
inline SplineSlope slope_at_start(std::span<const float> x, int i) {
  const size_t k = i;
  if (k == 0) return {i, i + 1, 1.0f};
  return {i - 1, i + 1, (x[k + 1] - x[k]) / (x[k + 1] - x[k - 1])};
}
inline SplineSlope slope_at_end(std::span<const float> x, int i) {
  const size_t k = i;
  if (k + 2 == x.size()) return {i, i + 1, 1.0f};
  return {i, i + 2, (x[k + 1] - x[k]) / (x[k + 2] - x[k])};
}

/// The spline on one interval: a cubic in the share t in [0,1] of the interval.
class SplineSegment {
 public:
  /// Interval `i` of the points `x`; value(k) is the value at point k.
  template <class Value>
  SplineSegment(std::span<const float> x, int i, Value&& value) {
    width_ = x[i + 1] - x[i];
    const auto of = [&](const SplineSlope& s) { return s.scale * (value(s.to) - value(s.from)); };
    const float begin = value(i), end = value(i + 1);
    const float first = of(slope_at_start(x, i)), last = of(slope_at_end(x, i));
    c_ = {begin, first, 3 * (end - begin) - 2 * first - last, 2 * (begin - end) + first + last};
  }
  float value(float t) const { return ((c_[3] * t + c_[2]) * t + c_[1]) * t + c_[0]; }
  /// Derivative of the value by t.
  float derivative(float t) const { return (3 * c_[3] * t + 2 * c_[2]) * t + c_[1]; }
  /// Integral over x from the interval's start.
  float integral(float t) const {
    return width_ * t *
           (((c_[3] * 0.25f * t + c_[2] * (1.0f / 3.0f)) * t + c_[1] * 0.5f) * t + c_[0]);
  }
  float width() const { return width_; }

 private:
  float width_;
  std::array<float, 4> c_;  ///< coefficients of t^0 to t^3
};

/// Fills `cumulative` with the spline's integral from x[0] to each point; returns the last.
float spline_integrate(std::span<const float> x, std::span<const float> f,
                       std::span<float> cumulative);

/// The x at which the spline through the ascending values `f` equals `value`, clamped to the first
/// and the last point.
float spline_invert(std::span<const float> x, std::span<const float> f, float value);

/// Root in [0,1] of a non-decreasing function that is at most 0 at 0, to float precision: Newton's
/// method from `start`, with bisection where a step leads astray. `eval(t)` returns value and
/// derivative.
template <class Eval>
float solve_rising(float start, Eval&& eval) {
  float low = 0.0f, high = 1.0f, t = start;
  for (int step = 0; step < 64; ++step) {
    const std::pair<float, float> at = eval(t);
    (at.first < 0.0f ? low : high) = t;
    const float newton = t - at.first / at.second;
    const float next = newton > low && newton < high ? newton : 0.5f * (low + high);
    if (std::abs(next - t) < 1e-6f || high - low < 1e-6f) return next;
    t = next;
  }
  return t;
}

}  // namespace nephroid
