// Statistics for the BSDF tests: adaptive integrals over the sphere, chi-square with its exact
// tail, and running means. All of it is deterministic.
#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include "core/math.h"
#include "core/sampler.h"

namespace nephroid::testing_bsdf {

/// Counter-based random numbers, independent of the project's samplers.
class TestRandom {
 public:
  explicit TestRandom(uint64_t seed) : state_(mix_bits(seed + 0x1234567ull)) {}
  float next() {
    return bits_to_unit_float(
        static_cast<uint32_t>(mix_bits(state_ += 0x9e3779b97f4a7c15ull) >> 32));
  }
  Vec2f next2() {
    const float x = next();
    return {x, next()};
  }

 private:
  uint64_t state_;
};

inline Vec3f spherical(double z, double phi) {
  const double r = std::sqrt(std::max(0.0, 1.0 - z * z));
  return {static_cast<float>(r * std::cos(phi)), static_cast<float>(r * std::sin(phi)),
          static_cast<float>(z)};
}
inline Vec3f direction_at(float degrees, float phi = 0.7f) {
  return spherical(std::cos(static_cast<double>(degrees) * M_PI / 180.0), phi);
}

using SphereFunction = std::function<double(const Vec3f&)>;

inline double gauss_cell(const SphereFunction& f, double z0, double z1, double p0, double p1) {
  static constexpr double kX[4] = {-0.8611363115940526, -0.3399810435848563, 0.3399810435848563,
                                   0.8611363115940526};
  static constexpr double kW[4] = {0.3478548451374538, 0.6521451548625461, 0.6521451548625461,
                                   0.3478548451374538};
  double sum = 0.0;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      sum += kW[i] * kW[j] *
             f(spherical(0.5 * (z0 + z1) + 0.5 * (z1 - z0) * kX[i],
                         0.5 * (p0 + p1) + 0.5 * (p1 - p0) * kX[j]));
  return sum * 0.25 * (z1 - z0) * (p1 - p0);
}

/// Integral of f over a cell in z and phi, in solid angle, to about `tolerance`.
inline double integrate_cell(const SphereFunction& f, double z0, double z1, double p0, double p1,
                             double tolerance, int depth, double coarse) {
  const double zm = 0.5 * (z0 + z1), pm = 0.5 * (p0 + p1);
  const double parts[4] = {gauss_cell(f, z0, zm, p0, pm), gauss_cell(f, zm, z1, p0, pm),
                           gauss_cell(f, z0, zm, pm, p1), gauss_cell(f, zm, z1, pm, p1)};
  const double fine = parts[0] + parts[1] + parts[2] + parts[3];
  if (depth == 0 || std::abs(fine - coarse) < tolerance) return fine;
  const double t = tolerance * 0.5;
  return integrate_cell(f, z0, zm, p0, pm, t, depth - 1, parts[0]) +
         integrate_cell(f, zm, z1, p0, pm, t, depth - 1, parts[1]) +
         integrate_cell(f, z0, zm, pm, p1, t, depth - 1, parts[2]) +
         integrate_cell(f, zm, z1, pm, p1, t, depth - 1, parts[3]);
}
inline double integrate_cell(const SphereFunction& f, double z0, double z1, double p0, double p1,
                             double tolerance) {
  return integrate_cell(f, z0, z1, p0, p1, tolerance, 7, gauss_cell(f, z0, z1, p0, p1));
}

/// Integral over a range of z and all phi, in solid angle. The initial cells are small enough for
/// every peak.
inline double integrate_range(const SphereFunction& f, double z0, double z1, double tolerance) {
  constexpr int kSplit = 16;
  double sum = 0.0;
  for (int i = 0; i < kSplit; ++i)
    for (int j = 0; j < kSplit; ++j)
      sum += integrate_cell(f, z0 + (z1 - z0) * i / kSplit, z0 + (z1 - z0) * (i + 1) / kSplit,
                            2 * M_PI * j / kSplit, 2 * M_PI * (j + 1) / kSplit,
                            tolerance / (kSplit * kSplit));
  return sum;
}

/// Upper tail of the chi-square distribution: regularised incomplete gamma Q(dof/2, x/2).
inline double chi_square_p_value(double x, int dof) {
  const double a = 0.5 * dof;
  x *= 0.5;
  if (x <= 0.0) return 1.0;
  const double front = std::exp(-x + a * std::log(x) - std::lgamma(a));
  if (x < a + 1.0) {
    double term = 1.0 / a, sum = term;
    for (int n = 1; n < 10000 && term > sum * 1e-14; ++n) sum += term *= x / (a + n);
    return 1.0 - front * sum;
  }
  double b = x + 1.0 - a, c = 1e300, d = 1.0 / b, h = d;
  for (int n = 1; n < 10000; ++n) {
    const double an = -n * (n - a);
    b += 2.0;
    d = 1.0 / (an * d + b);
    c = b + an / c;
    h *= d * c;
    if (std::abs(d * c - 1.0) < 1e-14) break;
  }
  return front * h;
}

/// p-value of counts against expected counts. Bins that expect less than 5 are pooled.
inline double chi_square_test(const std::vector<double>& observed,
                              const std::vector<double>& expected) {
  double statistic = 0.0, pool_o = 0.0, pool_e = 0.0;
  int bins = 0;
  const auto add = [&](double o, double e) {
    statistic += (o - e) * (o - e) / e;
    ++bins;
  };
  for (size_t i = 0; i < observed.size(); ++i) {
    if (expected[i] >= 5.0) {
      add(observed[i], expected[i]);
    } else {
      pool_o += observed[i];
      pool_e += expected[i];
    }
  }
  if (pool_e >= 5.0)
    add(pool_o, pool_e);
  else if (pool_o > 5.0 + 6.0 * std::sqrt(5.0))
    return 0.0;  // many samples where none is expected
  return bins > 1 ? chi_square_p_value(statistic, bins - 1) : 1.0;
}

/// Level of each of n tests so that a false alarm among all has probability `total`.
inline double sidak(double total, int n) {
  return 1.0 - std::pow(1.0 - total, 1.0 / n);
}

/// Mean with its standard error.
struct Mean {
  double n = 0, sum = 0, sum2 = 0;
  void add(double x) { n += 1, sum += x, sum2 += x * x; }
  double mean() const { return sum / n; }
  double error() const {
    return std::sqrt(std::max(0.0, sum2 / n - mean() * mean()) / std::max(1.0, n - 1));
  }
};

}  // namespace nephroid::testing_bsdf
