#include "integrator/mixed/balance.h"

#include <algorithm>
#include <cmath>

namespace nephroid {

namespace {

/// Smooths each tile with its neighbours, since a few passes estimate variance roughly.
std::vector<double> smoothed(const std::vector<double>& values, int width) {
  const int height = static_cast<int>(values.size()) / width;
  std::vector<double> out(values.size());
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      double sum = 0, weights = 0;
      for (int j = std::max(0, y - 1); j <= std::min(height - 1, y + 1); ++j)
        for (int i = std::max(0, x - 1); i <= std::min(width - 1, x + 1); ++i) {
          const double w = (i == x ? 2 : 1) * (j == y ? 2 : 1);
          sum += w * values[j * width + i];
          weights += w;
        }
      out[y * width + x] = sum / weights;
    }
  return out;
}

/// Smoothed typical variance and cost of a sample by tile; empty if there are no samples.
struct OfTiles {
  std::vector<double> typical, cost;
  OfTiles(const SampleVariance::ByTile& tiles, int width)
      : typical(smoothed(tiles.typical, width)), cost(smoothed(tiles.cost, width)) {}
  double samples_wanted(size_t tile) const {
    return cost[tile] > 0 ? std::sqrt(typical[tile] / cost[tile]) : 0;
  }
};

/// sqrt(typical variance / cost) of the tiles that are not black compared with the largest value.
std::vector<double> lit_square_roots(const OfTiles& tiles) {
  std::vector<double> roots;
  for (size_t i = 0; i < tiles.cost.size(); ++i) roots.push_back(tiles.samples_wanted(i));
  const double brightest = roots.empty() ? 0 : *std::max_element(roots.begin(), roots.end());
  std::erase_if(roots, [brightest](double v) { return !(v > 1e-3 * brightest); });
  return roots;
}

/// [A2], [S2] Samples of a tile: sqrt(variance / cost) / unit, and the resulting sum of variance
/// and unit² times rays.
struct Allocation {
  uint16_t samples;
  double inverse_efficiency;
  Allocation(double variance, double cost, double unit, int most)
      : samples(static_cast<uint16_t>(
            std::clamp(cost > 0 ? std::round(std::sqrt(variance / cost) / unit) : 1.0, 1.0,
                       static_cast<double>(most)))),
        inverse_efficiency(variance / samples + unit * unit * cost * samples) {}
};

}  // namespace

double winsorized_mean(std::vector<double> tiles) {
  if (tiles.empty()) return 0;
  std::sort(tiles.begin(), tiles.end());
  const double most = tiles[std::min(tiles.size() - 1, tiles.size() * 199 / 200)];
  double sum = 0;
  for (const double v : tiles) sum += std::min(v, most);
  return sum / static_cast<double>(tiles.size());
}

MeanLimits limits_of_film(int64_t pixels) {
  constexpr double kMaxPathsOfPass = 3.2e6;
  constexpr double kMinLimit = 1.5;  // below it, nearly all tiles would have one path
  MeanLimits limits;
  limits.paths = std::clamp(kMaxPathsOfPass / static_cast<double>(pixels), kMinLimit, limits.paths);
  if (limits.paths < SampleMap::kMaxMean) limits.walks = 2 * limits.paths;
  return limits;
}

SampleAllocation allocate_samples(const PixelBounds& bounds, int spacing,
                                  const TileStatistics& tiles, const MeanLimits& limits) {
  SampleAllocation shares{SampleMap(bounds, 1, spacing), SampleMap(bounds, 0, spacing)};
  const int width = shares.paths.width();
  const OfTiles paths(tiles.paths, width), chains(tiles.chains, width), choice(tiles.choice, width);
  std::vector<double> lit = lit_square_roots(paths);
  if (lit.empty()) lit = lit_square_roots(chains);
  if (lit.empty()) return shares;
  // [A2] The lit tile at the 5th percentile of noise has one path per pass, others in proportion.
  std::sort(lit.begin(), lit.end());
  // The mean of paths is limited: wavelengths and other values that all pixels of a pass share are
  // averaged over passes alone, and many paths per pass are few passes.
  for (double unit = lit[lit.size() / 20];; unit *= 1.1) {
    for (size_t i = 0; i < paths.cost.size(); ++i) {
      const double v = paths.typical[i], c = paths.cost[i];
      const Allocation alone(v, c, unit, SampleMap::kMax);
      shares.paths.counts()[i] = alone.samples;
      if (chains.cost.empty()) continue;
      const Allocation all(v + choice.typical[i], c, unit, SampleMap::kMax);
      const Allocation of_chains(chains.typical[i], chains.cost[i], unit,
                                 SampleMap::kMaxChainWalks);
      // Behind mirrors or glass of the tile there may still be a bright light that no walk has
      // seen.
      const bool unseen = chains.typical[i] <= 0 && chains.cost[i] > 1;
      const bool apart = unseen || alone.inverse_efficiency + of_chains.inverse_efficiency <
                                       all.inverse_efficiency;
      if (!apart) shares.paths.counts()[i] = all.samples;
      shares.chains.counts()[i] = apart ? of_chains.samples : 0;
    }
    if (shares.paths.mean() <= limits.paths &&
        shares.paths.mean() + shares.chains.mean() <= limits.walks)
      return shares;
  }
}

PassNoise::PassNoise(const TileStatistics& found, const SampleAllocation& samples,
                     double measured_light_paths)
    : camera_paths(samples.paths.mean()) {
  // A measured pass sees no noise of camera paths where photons give all light.
  constexpr double kMinShareOfCamera = 0.05;
  const bool separates = !found.chains.cost.empty();
  for (size_t i = 0; i < found.paths.cost.size(); ++i) {
    if (!(found.paths.cost[i] > 0)) continue;
    const double paths = samples.paths.counts()[i], walks = samples.chains.counts()[i];
    double camera = found.paths.typical[i] / paths;
    if (separates && walks > 0) {
      camera += found.chains.typical[i] / walks;
      walk_rays += walks * found.chains.cost[i];
    } else if (separates) {
      camera += found.choice.typical[i] / paths;
    }
    const double photons = found.paths.photons[i];
    tiles.push_back(
        {std::max(camera, kMinShareOfCamera * photons / paths), photons * measured_light_paths});
  }
  if (!tiles.empty()) walk_rays /= static_cast<double>(tiles.size());
}

double Trial::min_variance_of_unseen(const Trial& other) const {
  const double unseen = other.light - light - 2 * other.error;
  return unseen > 0 ? samples * unseen * unseen / (1.1 * other.light) : 0;
}

Balance::Balance(const Trial& trial)
    : variance_of_camera(std::max(trial.variance_of_camera, 0.05 * trial.variance_of_light)),
      cost_of_camera(trial.cost_of_camera),
      pixels(trial.pixels),
      photons_of_path(trial.photons) {
  // b of V(N) = v + b/N [A3].
  variance_of_light = trial.variance_of_light * trial.light_paths;
  if (!(trial.light_paths > 0)) return;
  cost_of_light = trial.cost_of_light / trial.light_paths;
  cost_of_merging = trial.cost_of_merging / trial.light_paths;
}

double Balance::light_paths_of_camera_path() const {
  if (!(cost_of_light > 0) || !(variance_of_camera > 0)) return 0;
  return scale *
         std::sqrt(variance_of_light * cost_of_camera / (variance_of_camera * cost_of_light));
}

double Balance::max_light_paths() const {
  return std::clamp(max_photons / std::max(photons_of_path, 1e-9), kMinLightPaths, kMaxLightPaths);
}

int64_t Balance::light_paths(double camera_paths) const {
  const double most = max_light_paths();
  return static_cast<int64_t>(std::clamp(camera_paths * light_paths_of_camera_path(),
                                         std::clamp(min_light_paths, kMinLightPaths, most), most));
}

int64_t Balance::light_paths(const PassNoise& pass) const {
  const double most = max_light_paths();
  const double rays_of_camera = pass.camera_paths * cost_of_camera / pixels + pass.walk_rays;
  const double rays_of_light =
      (cost_of_light + (pass.camera_paths - 1) * cost_of_merging) / (pixels * scale);
  constexpr double kStep = 1.0625;
  // A measured pass has few light paths. What they do not see, the trial may have seen.
  auto best = static_cast<double>(light_paths(pass.camera_paths));
  double lowest = kInfinity;
  for (double n = best; n <= most; n *= kStep) {
    double deviation = 0;
    for (const PassNoise::Tile& t : pass.tiles) deviation += std::sqrt(t.camera + t.photons / n);
    const double inverse_efficiency = sqr(deviation) * (rays_of_camera + rays_of_light * n);
    if (inverse_efficiency < lowest) {
      lowest = inverse_efficiency;
      best = n;
    }
  }
  return static_cast<int64_t>(best);
}

void Balance::let_photons_lower_variance_of_camera(const Trial& trial) {
  if (!(trial.light_paths > 0 && cost_of_light > 0 && variance_of_camera > 0)) return;
  const double p = cost_of_camera / (cost_of_light * trial.light_paths);
  const double q = variance_of_light / (trial.light_paths * variance_of_camera);
  // Newton's method, from above the only positive root.
  double y = std::sqrt(p) + std::cbrt(2 * p * q);
  for (int i = 0; i < 20 && y > 0; ++i) y -= (y * y * y - p * y - 2 * p * q) / (3 * y * y - p);
  min_light_paths = std::max(min_light_paths, scale * trial.light_paths * y * y);
}

double Balance::inverse_efficiency() const {
  const double paths = static_cast<double>(light_paths(1)) / scale;
  return (variance_of_camera + variance_of_light / paths) *
         (cost_of_camera + cost_of_light * paths);
}

}  // namespace nephroid
