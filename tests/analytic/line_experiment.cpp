#include "analytic/line_experiment.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "core/sampler.h"
#include "photon/radius_schedule.h"

namespace nephroid {

namespace {

constexpr double kAmplitude = 0.8, kHigh = 1.6, kLow = 0.4;

/// Random numbers in [0,1) for one pass.
class Numbers {
 public:
  Numbers(uint64_t seed, uint32_t pass, uint64_t stream)
      : seed_(hash_combine(seed, pass, stream)) {}
  double operator()() {
    return static_cast<double>(mix_bits(seed_ + ++count_ * 0x9e3779b97f4a7c15ull) >> 11) * 0x1p-53;
  }

 private:
  uint64_t seed_, count_ = 0;
};

double sample(LineDensity density, Numbers& u) {
  if (density == LineDensity::kFlat) return u();
  if (density == LineDensity::kStep) {
    const double v = u();
    return v < kHigh / 2 ? v / kHigh : 0.5 + (v - kHigh / 2) / kLow;
  }
  for (;;) {
    const double x = u();
    if (u() * (1 + kAmplitude) < line_density(density, x)) return x;
  }
}

/// Integral of the density over [0, x], x >= 0.
double cumulative(LineDensity density, double x) {
  if (density == LineDensity::kFlat) return x;
  const double whole = std::floor(x), part = x - whole;
  if (density == LineDensity::kStep)
    return whole + kHigh * std::min(part, 0.5) + kLow * std::max(part - 0.5, 0.0);
  constexpr double kTurn = 2 * std::numbers::pi;
  return x + kAmplitude * std::sin(kTurn * x) / kTurn;
}

/// Photons within `radius` of x on the closed line.
double count(std::span<const double> photons, double x, double radius) {
  int64_t found = 0;
  for (const double p : photons) {
    const double d = std::abs(p - x);
    found += std::min(d, 1 - d) <= radius;
  }
  return static_cast<double>(found);
}

/// The two estimates for one region.
struct Region {
  double width = 0, truth = 0;
  SharedStatistics statistics;  ///< the measure that shrinks, here the radius
  double tau = 0;               ///< tau of [E1]
  double sum = 0;               ///< sum of the estimates [E2] over passes
};

}  // namespace

double line_density(LineDensity density, double x) {
  if (density == LineDensity::kWave) return 1 + kAmplitude * std::cos(2 * std::numbers::pi * x);
  if (density == LineDensity::kStep) return x - std::floor(x) < 0.5 ? kHigh : kLow;
  return 1;
}

double line_mean(LineDensity density, double center, double width) {
  if (!(width > 0)) return line_density(density, center);
  const double begin = center - width / 2 + 1;  // plus one turn: the line is closed
  return (cumulative(density, begin + width) - cumulative(density, begin)) / width;
}

std::vector<std::vector<LineError>> line_errors(const LineSettings& settings,
                                                std::span<const double> widths) {
  std::vector<Region> regions;
  for (const double width : widths) {
    Region& region = regions.emplace_back();
    region.width = width;
    region.truth = line_mean(settings.density, settings.center, width);
    region.statistics.radius_squared = settings.radius;
  }
  std::vector<std::vector<LineError>> errors(regions.size());
  std::vector<double> photons(static_cast<size_t>(settings.photons_per_pass));
  for (uint32_t pass = 0; pass < settings.passes; ++pass) {
    Numbers of_photons(settings.seed, pass, 0), of_points(settings.seed, pass, 1);
    for (double& photon : photons) photon = sample(settings.density, of_photons);
    const double n = static_cast<double>(photons.size());
    const double memoryless = settings.radius * memoryless_radius_squared(pass, settings.alpha);
    for (size_t r = 0; r < regions.size(); ++r) {
      Region& region = regions[r];
      double x = settings.center + (of_points() - 0.5) * region.width;
      x -= std::floor(x);
      const double found = count(photons, x, region.statistics.radius_squared);
      region.tau = (region.tau + found) * region.statistics.update(found, settings.alpha);
      region.sum += count(photons, x, memoryless) / (2 * memoryless * n);
      if (!std::has_single_bit(pass + 1)) continue;
      const double i = pass + 1.0;
      errors[r].push_back(
          {pass + 1, region.tau / (i * n * 2 * region.statistics.radius_squared) - region.truth,
           region.sum / i - region.truth});
    }
  }
  return errors;
}

double line_slope(std::span<const uint32_t> passes, std::span<const double> errors) {
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (size_t i = 0; i < passes.size(); ++i) {
    if (errors[i] == 0) continue;
    const double x = std::log(static_cast<double>(passes[i])), y = std::log(std::abs(errors[i]));
    n += 1, sx += x, sy += y, sxx += x * x, sxy += x * y;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

}  // namespace nephroid
