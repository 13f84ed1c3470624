// Sums over the film, per chunk of rows and then in the order of the chunks: the stop rule must not
// depend on threads.
#include "session/noise.h"

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
  std::vector<double> sums(static_cast<size_t>(chunk_count(bounds.height(), kRowsPerChunk)));
  parallel_chunks(bounds.height(), kRowsPerChunk, [&](int64_t chunk, int64_t begin, int64_t end) {
    double sum = 0;
    for (int64_t row = begin; row < end; ++row)
      for (int x = bounds.x0; x < bounds.x1; ++x) sum += term(x, bounds.y0 + static_cast<int>(row));
    sums[static_cast<size_t>(chunk)] = sum;
  });
  return std::accumulate(sums.begin(), sums.end(), 0.0);
}

}  // namespace

std::optional<double> estimated_noise(const Film& film) {
  for (int g = 0; g < film.layout().group_count(); ++g)
    if (film.estimates(g) < 2) return std::nullopt;
  const double sum = sum_over_pixels(film, [&](int x, int y) {
    // Of all light, whatever is held: that is what the error is of.
    const Rgb held = film.rejection() != nullptr ? film.outliers(x, y) : Rgb();
    const Rgb value = film.value(x, y) + held, error = film.standard_error(x, y);
    double pixel = 0;
    for (int c = 0; c < 3; ++c) {
      const double v = value[c], e = error[c];
      pixel += e * e / (v * v + kRelativeFloor);
    }
    return pixel;
  });
  return std::sqrt(sum / (3.0 * static_cast<double>(film.bounds().area())));
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
