// Weights, integrals and inversion of splines; see catmull_rom.h.
#include "scene/bsdf/catmull_rom.h"

namespace nephroid {
namespace {

// Weights of an interval's two values and of its two slopes (times its width).
struct HermiteBasis {
  float f0, f1, d0, d1;
};

HermiteBasis value_basis(float t) {
  const float t2 = t * t, t3 = t2 * t;
  return {2 * t3 - 3 * t2 + 1, 3 * t2 - 2 * t3, t3 - 2 * t2 + t, t3 - t2};
}

// Slopes are differences of values, so everything is a combination of values.
SplineWeights combine(std::span<const float> x, int i, const HermiteBasis& b) {
  SplineWeights s;
  s.first = i - 1;
  s.w = {0.0f, b.f0, b.f1, 0.0f};
  const auto add = [&](float d, const SplineSlope& slope) {
    s.w[slope.to - s.first] += d * slope.scale;
    s.w[slope.from - s.first] -= d * slope.scale;
  };
  add(b.d0, slope_at_start(x, i));
  add(b.d1, slope_at_end(x, i));
  return s;
}

}  // namespace

std::optional<int> spline_interval(std::span<const float> x, float at) {
  if (!(at >= x.front() && at <= x.back())) return std::nullopt;
  const auto above = std::upper_bound(x.begin() + 1, x.end() - 1, at);
  return static_cast<int>(above - x.begin()) - 1;
}

std::optional<SplineWeights> spline_value(std::span<const float> x, float at) {
  const std::optional<int> i = spline_interval(x, at);
  if (!i) return std::nullopt;
  return combine(x, *i, value_basis((at - x[*i]) / (x[*i + 1] - x[*i])));
}

float spline_integrate(std::span<const float> x, std::span<const float> f,
                       std::span<float> cumulative) {
  double sum = 0.0;
  cumulative[0] = 0.0f;
  for (size_t i = 0; i + 1 < x.size(); ++i) {
    sum += SplineSegment(x, static_cast<int>(i), [&](int k) { return f[k]; }).integral(1.0f);
    cumulative[i + 1] = static_cast<float>(sum);
  }
  return cumulative[x.size() - 1];
}

float spline_invert(std::span<const float> x, std::span<const float> f, float value) {
  if (!(value > f.front())) return x.front();
  if (!(value < f.back())) return x.back();
  const int i = *spline_interval(f, value);
  const SplineSegment segment(x, i, [&](int k) { return f[k]; });
  const float t = solve_rising((value - f[i]) / (f[i + 1] - f[i]), [&](float s) {
    return std::pair{segment.value(s) - value, segment.derivative(s)};
  });
  return x[i] + t * (x[i + 1] - x[i]);
}

}  // namespace nephroid
