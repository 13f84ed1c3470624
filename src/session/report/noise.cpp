// Sums over the film are taken per chunk of rows, then in the order of the chunks: the stop rule
// must not depend on threads.
#include "session/report/noise.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

#include "core/parallel.h"

namespace nephroid {
namespace {

constexpr int64_t kRowsPerChunk = 16;
constexpr double kRelativeFloor = 0.01;

/// Sum of term(x, y) over the film's pixels.
template <class Term>
double sum_over_pixels(const Film& film, const Term& term) {
  const PixelBounds& bounds = film.bounds();
  std::vector<double> sums(chunk_count(bounds.height(), kRowsPerChunk));
  parallel_chunks(bounds.height(), kRowsPerChunk, [&](int64_t chunk, int64_t begin, int64_t end) {
    double sum = 0;
    for (int64_t row = begin; row < end; ++row)
      for (int x = bounds.x0; x < bounds.x1; ++x) sum += term(x, bounds.y0 + static_cast<int>(row));
    sums[chunk] = sum;
  });
  return std::accumulate(sums.begin(), sums.end(), 0.0);
}

/// All light of a pixel, held outliers included, as the error refers to it.
Rgb all_light(const Film& film, int x, int y) {
  const Rgb value = film.value(x, y);
  return film.rejection() != nullptr ? value + film.outliers(x, y) : value;
}

/// Mean over pixels and channels of error^2 / (value^2 + 0.01).
template <class Error>
double relative_square(const Film& film, const Error& error_of) {
  const double sum = sum_over_pixels(film, [&](int x, int y) {
    const Rgb value = all_light(film, x, y), error = error_of(x, y);
    double pixel = 0;
    for (int c = 0; c < 3; ++c) {
      const double v = value[c], e = error[c];
      pixel += e * e / (v * v + kRelativeFloor);
    }
    return pixel;
  });
  return sum / (3.0 * static_cast<double>(film.bounds().area()));
}

/// [F5] The bias term.
double relative_square_of_bias(const Film& film) {
  if (!film.has_bias()) return 0;
  const double sum = sum_over_pixels(film, [&](int x, int y) {
    const Rgb value = all_light(film, x, y);
    const double v = (double{value.r} + value.g + value.b) / 3, b = film.bias(x, y),
                 e = film.bias_error(x, y);
    return (b * b - e * e) / (v * v + kRelativeFloor);
  });
  return std::max(0.0, sum / static_cast<double>(film.bounds().area()));
}

bool has_error(const Film& film) {
  for (int g = 0; g < film.layout().group_count(); ++g)
    if (film.estimates(g) < 2) return false;
  return true;
}

}  // namespace

std::optional<EstimatedError> estimated_error(const Film& film) {
  if (!has_error(film)) return std::nullopt;
  const double noise =
      relative_square(film, [&](int x, int y) { return film.standard_error(x, y); });
  return EstimatedError{std::sqrt(noise), std::sqrt(relative_square_of_bias(film))};
}

double passes_to(const EstimatedError& error, double target) {
  // Solves noise^2 / g + bias^2 / g^(2/3) = target^2 for g = t^3 by Newton's method from above,
  // where the polynomial is convex.
  const double noise2 = sqr(error.noise / target), bias2 = sqr(error.bias / target);
  double t = std::cbrt(noise2) + std::sqrt(bias2);
  for (int i = 0; i < 32 && t > 0; ++i)
    t -= (t * t * t - bias2 * t - noise2) / std::max(3 * t * t - bias2, 1e-300);
  return t * t * t;
}

std::optional<ErrorShares> error_shares(const Film& film) {
  if (!has_error(film)) return std::nullopt;
  ErrorShares shares;
  for (int g = 0; g < film.layout().group_count(); ++g)
    shares.groups.push_back(std::sqrt(
        relative_square(film, [&](int x, int y) { return film.standard_error(g, x, y); })));
  shares.bias = std::sqrt(relative_square_of_bias(film));
  return shares;
}

EnergyShares energy_shares(const Film& film) {
  const auto energy = [&](Rgb (Film::*value_of)(int, int, int) const, size_t layer) {
    return sum_over_pixels(film, [&](int x, int y) {
      const Rgb value = (film.*value_of)(static_cast<int>(layer), x, y);
      return double{value.r} + value.g + value.b;
    });
  };
  EnergyShares shares;
  for (size_t r = 0; r < film.layout().routes.size(); ++r)
    shares.routes.push_back(energy(&Film::route_value, r));
  for (size_t a = 0; a < film.layout().aovs.size(); ++a)
    shares.aovs.push_back(energy(&Film::aov_value, a));
  const double total = std::accumulate(shares.routes.begin(), shares.routes.end(), 0.0);
  if (film.rejection() != nullptr) {
    const double held = sum_over_pixels(film, [&](int x, int y) {
      const Rgb value = film.outliers(x, y);
      return double{value.r} + value.g + value.b;
    });
    shares.outliers = total + held > 0 ? held / (total + held) : 0;
  }
  for (std::vector<double>* list : {&shares.routes, &shares.aovs})
    for (double& share : *list) share = total > 0 ? share / total : 0;
  return shares;
}

}  // namespace nephroid
