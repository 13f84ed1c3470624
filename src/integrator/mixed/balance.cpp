#include "integrator/mixed/balance.h"

#include <algorithm>
#include <cmath>

namespace nephroid {

namespace {

/// Light paths of a pass.
constexpr double kFewest = 1 << 10, kMost = 1 << 20;

/// Each tile with its neighbours: the spread of a few passes is a rough guess.
std::vector<double> smoothed(const std::vector<double>& values, int width) {
  const int height = static_cast<int>(values.size()) / width;
  std::vector<double> out(values.size());
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      double sum = 0, weights = 0;
      for (int j = std::max(0, y - 1); j <= std::min(height - 1, y + 1); ++j)
        for (int i = std::max(0, x - 1); i <= std::min(width - 1, x + 1); ++i) {
          const double w = (i == x ? 2 : 1) * (j == y ? 2 : 1);
          sum += w * values[static_cast<size_t>(j * width + i)];
          weights += w;
        }
      out[static_cast<size_t>(y * width + x)] = sum / weights;
    }
  return out;
}

/// Variance and cost of a sample; nothing where there are no samples.
struct OfTiles {
  std::vector<double> variance, cost;
  OfTiles(const SampleSpread::ByTile& spread, int width)
      : variance(smoothed(spread.variance, width)), cost(smoothed(spread.cost, width)) {}
  double root(size_t tile) const {
    return cost[tile] > 0 ? std::sqrt(variance[tile] / cost[tile]) : 0;
  }
};

/// Of the tiles that are not black beside the brightest.
std::vector<double> lit_roots(const OfTiles& tiles) {
  std::vector<double> roots;
  for (size_t i = 0; i < tiles.cost.size(); ++i) roots.push_back(tiles.root(i));
  const double brightest = roots.empty() ? 0 : *std::max_element(roots.begin(), roots.end());
  std::erase_if(roots, [brightest](double v) { return !(v > 1e-3 * brightest); });
  return roots;
}

/// So many samples that one more is worth `unit`^2 rays of variance, and what the tile then costs
/// in variance and in rays that are worth as much.
struct Share {
  uint16_t samples;
  double expense;
  Share(double variance, double cost, double unit, int most)
      : samples(static_cast<uint16_t>(
            std::clamp(cost > 0 ? std::round(std::sqrt(variance / cost) / unit) : 1.0, 1.0,
                       static_cast<double>(most)))),
        expense(variance / samples + unit * unit * cost * samples) {}
};

}  // namespace

int SampleMap::most() const {
  return *std::max_element(counts_.begin(), counts_.end());
}

int SampleMap::fewest() const {
  return *std::min_element(counts_.begin(), counts_.end());
}

bool SampleMap::has(int samples) const {
  return std::find(counts_.begin(), counts_.end(), samples) != counts_.end();
}

double SampleMap::mean() const {
  double sum = 0;
  for (const uint16_t n : counts_) sum += n;
  return sum / static_cast<double>(counts_.size());
}

SampleSpread::ByTile SampleSpread::by_tile(const SampleSpread* beside) const {
  const SampleMap tiles(bounds_);
  const ByTile other = beside ? beside->by_tile() : ByTile{};
  ByTile out;
  out.variance.assign(tiles.counts().size(), 0);
  out.cost = out.variance;
  out.light = out.variance;
  std::vector<double> pixels(out.variance);
  double all_light = 0, all_pixels = 0;
  size_t i = 0;
  for (int y = 0; y < bounds_.height(); ++y)
    for (int x = 0; x < bounds_.width(); ++x) {
      const Sums& s = sums_[i++];
      if (s.samples < 2) continue;
      const size_t tile = tiles.tile_of(x, y);
      const double mean = s.light / s.samples;
      out.cost[tile] += s.rays / s.samples;
      out.variance[tile] += std::max(0.0, (s.square - mean * s.light) / (s.samples - 1));
      out.light[tile] += std::abs(mean);
      all_light += std::abs(mean) + (beside ? other.light[tile] : 0);
      ++pixels[tile];
      ++all_pixels;
    }
  // Between the absolute error, which forgets the shadows, and the relative one, which forgets
  // the lights.
  const double floor = 0.1 * all_light / std::max(1.0, all_pixels);
  for (size_t t = 0; t < out.variance.size(); ++t) {
    if (!(pixels[t] > 0)) continue;
    out.light[t] /= pixels[t];
    const double brightness = out.light[t] + (beside ? other.light[t] : 0) + floor;
    out.variance[t] = brightness > 0 ? out.variance[t] / (pixels[t] * brightness) : 0;
    out.cost[t] /= pixels[t];
  }
  return out;
}

double steady_mean(std::vector<double> tiles) {
  if (tiles.empty()) return 0;
  std::sort(tiles.begin(), tiles.end());
  const double most = tiles[std::min(tiles.size() - 1, tiles.size() * 199 / 200)];
  double sum = 0;
  for (const double v : tiles) sum += std::min(v, most);
  return sum / static_cast<double>(tiles.size());
}

Shares share_out(const PixelBounds& bounds, const Spreads& spreads, bool glints_apart,
                 double most_mean) {
  Shares shares{SampleMap(bounds), SampleMap(bounds, 0)};
  const int width = shares.paths.width();
  const OfTiles paths(spreads.paths, width), glints(spreads.glints, width),
      choice(spreads.choice, width);
  std::vector<double> lit = lit_roots(paths);
  if (lit.empty()) lit = lit_roots(glints);
  if (lit.empty()) return shares;
  // The quietest of the tiles that have light have one path a pass.
  std::sort(lit.begin(), lit.end());
  // Fewer have one where that would be many paths a pass: what all pixels of a pass share, its
  // wavelengths above all, is averaged over passes alone.
  for (double unit = lit[lit.size() / 20];; unit *= 1.1) {
    for (size_t i = 0; i < paths.cost.size(); ++i) {
      const double v = paths.variance[i], c = paths.cost[i];
      const Share alone(v, c, unit, SampleMap::kMost);
      shares.paths.counts()[i] = alone.samples;
      if (glints.cost.empty()) continue;
      const Share all(v + choice.variance[i], c, unit, SampleMap::kMost);
      const Share of_glints(glints.variance[i], glints.cost[i], unit, SampleMap::kMostGlints);
      // What no walk has seen in the mirrors and the glass of a tile may still be there, and
      // bright.
      const bool unseen = glints.variance[i] <= 0 && glints.cost[i] > 1;
      const bool apart = glints_apart || unseen || alone.expense + of_glints.expense < all.expense;
      if (!apart) shares.paths.counts()[i] = all.samples;
      shares.glints.counts()[i] = apart ? of_glints.samples : 0;
    }
    if (shares.paths.mean() <= most_mean) return shares;
  }
}

double Trial::least_of_unseen(const Trial& other) const {
  const double unseen = other.light - light - 2 * other.error;
  return unseen > 0 ? samples * unseen * unseen / (1.1 * other.light) : 0;
}

Balance::Balance(const Trial& many, const Trial& few) {
  // V(N) = v + b/N.
  const double b =
      std::max(0.0, (few.variance - many.variance) / (1 / few.light_paths - 1 / many.light_paths));
  variance_of_light = b;
  cost_of_light = many.cost_of_light / many.light_paths;
  photons_of_path = many.photons;
  take_camera_paths(many);
}

void Balance::take_camera_paths(const Trial& trial) {
  const double b = trial.light_paths > 0 ? variance_of_light / trial.light_paths : 0;
  variance_of_camera = std::max(0.05 * trial.variance, trial.variance - b);
  cost_of_camera = trial.cost_of_camera;
}

Balance Balance::with_camera_paths_of(const Trial& trial) const {
  Balance other = *this;
  other.take_camera_paths(trial);
  return other;
}

double Balance::light_paths_of_camera_path() const {
  if (!(cost_of_light > 0) || !(variance_of_camera > 0)) return 0;
  return std::sqrt(variance_of_light * cost_of_camera / (variance_of_camera * cost_of_light));
}

double Balance::most_light_paths() const {
  return std::clamp(kMostPhotons / std::max(photons_of_path, 1e-9), kFewest, kMost);
}

int64_t Balance::light_paths(double camera_paths) const {
  return static_cast<int64_t>(
      std::clamp(camera_paths * light_paths_of_camera_path(), kFewest, most_light_paths()));
}

double Balance::expense() const {
  const double paths = static_cast<double>(light_paths(1));
  return (variance_of_camera + variance_of_light / paths) *
         (cost_of_camera + cost_of_light * paths);
}

}  // namespace nephroid
