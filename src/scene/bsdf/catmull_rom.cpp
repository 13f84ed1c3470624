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

HermiteBasis integral_basis(float t) {
  const float t2 = t * t, t3 = t2 * t, t4 = t2 * t2;
  return {0.5f * t4 - t3 + t, t3 - 0.5f * t4, 0.25f * t4 - t3 * (2.0f / 3.0f) + 0.5f * t2,
          0.25f * t4 - t3 * (1.0f / 3.0f)};
}

// Slopes are differences of values, so everything is a combination of values.
SplineWeights combine(std::span<const float> x, int i, const HermiteBasis& b) {
  const size_t k = i;
  const float width = x[k + 1] - x[k];
  SplineWeights s;
  s.first = i - 1;
  s.w = {0.0f, b.f0, b.f1, 0.0f};
  if (k > 0) {
    const float slope = b.d0 * width / (x[k + 1] - x[k - 1]);
    s.w[0] -= slope;
    s.w[2] += slope;
  } else {
    s.w[1] -= b.d0;
    s.w[2] += b.d0;
  }
  if (k + 2 < x.size()) {
    const float slope = b.d1 * width / (x[k + 2] - x[k]);
    s.w[1] -= slope;
    s.w[3] += slope;
  } else {
    s.w[1] -= b.d1;
    s.w[2] += b.d1;
  }
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
  return spline_value_at(x, *i, (at - x[*i]) / (x[*i + 1] - x[*i]));
}

SplineWeights spline_value_at(std::span<const float> x, int i, float t) {
  return combine(x, i, value_basis(t));
}

SplineWeights spline_integral_at(std::span<const float> x, int i, float t) {
  SplineWeights s = combine(x, i, integral_basis(t));
  for (float& w : s.w) w *= x[i + 1] - x[i];
  return s;
}

float spline_integrate(std::span<const float> x, std::span<const float> f,
                       std::span<float> cumulative) {
  double sum = 0.0;
  cumulative[0] = 0.0f;
  for (size_t i = 0; i + 1 < x.size(); ++i) {
    sum += spline_integral_at(x, static_cast<int>(i), 1.0f).of([&](int k) { return f[k]; });
    cumulative[i + 1] = static_cast<float>(sum);
  }
  return cumulative[x.size() - 1];
}

float spline_invert(std::span<const float> x, std::span<const float> f, float value) {
  if (!(value > f.front())) return x.front();
  if (!(value < f.back())) return x.back();
  const int i = *spline_interval(f, value);
  const auto at = [&](int j) { return f[j]; };
  const float t = solve_rising([&](float s) {
    // The derivative only steers the search, so a finite difference will do.
    constexpr float kStep = 1e-3f;
    const float here = spline_value_at(x, i, s).of(at);
    const float there = spline_value_at(x, i, s + kStep).of(at);
    return std::pair{here - value, (there - here) / kStep};
  });
  return x[i] + t * (x[i + 1] - x[i]);
}

}  // namespace nephroid
