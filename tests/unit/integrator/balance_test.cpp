// Sample allocation, against sums by hand, and against all alternatives where the optimum is known.
#include "integrator/mixed/balance.h"

#include <gtest/gtest.h>

namespace nephroid {
namespace {

constexpr int kTile = SampleMap::kTile;

PixelBounds tiles(int across, int down) {
  return {0, 0, across * kTile, down * kTile};
}

TEST(SampleMap, IsOnePathForEachPixelAtFirst) {
  // Tiles at the border are clipped.
  const PixelBounds b{3, 5, 3 + 2 * kTile + 1, 5 + kTile + 2};
  SampleMap map(b);
  ASSERT_EQ(map.counts().size(), 6u);
  EXPECT_EQ(map.mean(), 1);
  EXPECT_EQ(map.most(), 1);
  map.counts()[map.tile_of(2 * kTile, kTile)] = 7;
  EXPECT_EQ(map.at(2 * kTile, kTile + 1), 7);
  EXPECT_EQ(map.at(2 * kTile - 1, kTile + 1), 1);
  EXPECT_EQ(map.at(2 * kTile, kTile - 1), 1);
  EXPECT_EQ(map.most(), 7);
  EXPECT_EQ(map.mean(), 2);
}

// [A1]
TEST(SampleVariance, IsTheVarianceOverTheBrightnessOfATile) {
  const PixelBounds b = tiles(3, 1);
  SampleVariance spread(b);
  // Each pixel of the first tile has four samples of mean 6, of the second tile three of mean 60.
  // Those of the third have one sample, which gives no variance.
  for (int y = 0; y < kTile; ++y)
    for (int x = 0; x < 3 * kTile; ++x) {
      if (x < kTile)
        for (const double v : {2, 4, 8, 10}) spread.add(x, y, v, v + 1);
      else if (x < 2 * kTile)
        for (const double v : {30, 60, 90}) spread.add(x, y, v, 5);
      else
        spread.add(x, y, 1000, 9);
    }
  const SampleVariance::ByTile found = spread.by_tile();
  const double floor = 0.1 * (6 + 60) / 2;
  EXPECT_NEAR(found.variance[0], (16 + 4 + 4 + 16) / 3.0 / (6 + floor), 1e-12);
  EXPECT_NEAR(found.variance[1], 900 / (60 + floor), 1e-12);
  EXPECT_EQ(found.variance[2], 0);
  EXPECT_NEAR(found.cost[0], 7, 1e-12);
  EXPECT_NEAR(found.cost[1], 5, 1e-12);
  EXPECT_EQ(found.cost[2], 0);

  // With light of another estimator added, the same variance counts less.
  SampleVariance beside(b);
  for (int y = 0; y < b.height(); ++y)
    for (int x = 0; x < b.width(); ++x)
      for (const double v : {10, 20}) beside.add(x, y, v, 1, 500);
  const double all = 0.1 * ((6 + 60) / 2.0 + 15);
  EXPECT_NEAR(spread.by_tile(&beside).variance[0], (16 + 4 + 4 + 16) / 3.0 / (6 + 15 + all), 1e-12);
  EXPECT_NEAR(beside.by_tile().variance[2], (1000 - 15 * 30) / (15 * 1.1), 1e-12);
}

// [A1]
TEST(SampleVariance, HasTypicalOnesWhereFewPixelsAreNoisy) {
  const PixelBounds b = tiles(2, 1);
  SampleVariance spread(b);
  // The light is 6 everywhere. In the first tile all pixels have the variance 2, in the second just
  // one pixel has all of the noise.
  for (int y = 0; y < b.height(); ++y)
    for (int x = 0; x < b.width(); ++x) {
      const double change = x < kTile ? 1 : x == kTile && y == 0 ? 4 : 0;
      for (const double sign : {-1, 1}) spread.add(x, y, 6 + sign * change, 1);
    }
  const SampleVariance::ByTile found = spread.by_tile();
  EXPECT_NEAR(found.variance[0], 2 / 6.6, 1e-12);
  EXPECT_NEAR(found.variance[1], 2 / 6.6, 1e-12);
  EXPECT_NEAR(found.typical[0], 2 / 6.6, 1e-12);
  EXPECT_NEAR(found.typical[1], 2 / 6.6 / 16, 1e-12);
}

// [A6] needs the variance within two passes and over both together.
TEST(SampleVariance, AddsUp) {
  const PixelBounds b = tiles(2, 1);
  SampleVariance first(b), second(b), both(b);
  for (int y = 0; y < b.height(); ++y)
    for (int x = 0; x < b.width(); ++x)
      for (int k = 0; k < 4; ++k) {
        const double light = (x * 7 + y * 3 + k * 5) % 11 + 1, rays = x + k;
        (k < 2 ? first : second).add(x, y, light, rays);
        both.add(x, y, light, rays);
      }
  first.add(second);
  EXPECT_EQ(first.by_tile().variance, both.by_tile().variance);
  EXPECT_EQ(first.by_tile().cost, both.by_tile().cost);
}

/// Blocks of tiles, side by side, wide enough to have tiles without differing neighbours.
struct Blocks {
  static constexpr int kWidth = 5, kHeight = 3;
  explicit Blocks(const std::vector<std::pair<double, double>>& variance_and_cost)
      : across(kWidth * static_cast<int>(variance_and_cost.size())) {
    for (int y = 0; y < kHeight; ++y)
      for (const auto& [variance, cost] : variance_and_cost)
        for (int x = 0; x < kWidth; ++x) {
          spread.typical.push_back(variance);
          spread.cost.push_back(cost);
        }
    const SampleMap map = allocate_samples(tiles(across, kHeight), 1, {spread, {}, {}}).paths;
    for (size_t i = 0; i < variance_and_cost.size(); ++i) {
      const size_t middle = static_cast<size_t>(across) + kWidth * i + kWidth / 2;
      samples.push_back(map.counts()[middle]);
    }
  }
  int across;
  SampleVariance::ByTile spread;
  std::vector<int> samples;  ///< samples per pixel in the middle of each block
};

// [A2]
TEST(AllocateSamples, GoesWithTheRootOfVarianceOverCost) {
  const std::vector<std::pair<double, double>> v_and_c = {{2, 1}, {8, 1},  {18, 1},  {32, 4},
                                                          {2, 1}, {50, 1}, {128, 4}, {2, 1}};
  const Blocks blocks(v_and_c);
  EXPECT_EQ(blocks.samples, (std::vector<int>{1, 2, 3, 2, 1, 5, 4, 1}));
  // No other allocation has less error for the same work: variance times cost grows if any block
  // has one path more or fewer.
  const auto expense = [&](const std::vector<int>& n) {
    double error = 0, work = 0;
    for (size_t i = 0; i < n.size(); ++i) {
      error += v_and_c[i].first / n[i];
      work += v_and_c[i].second * n[i];
    }
    return error * work;
  };
  for (size_t i = 0; i < v_and_c.size(); ++i)
    for (const int step : {-1, 1}) {
      std::vector<int> other = blocks.samples;
      if ((other[i] += step) < 1) continue;
      EXPECT_GT(expense(other), expense(blocks.samples)) << "block " << i << ", " << step;
    }
}

TEST(AllocateSamples, KeepsItsBounds) {
  // A block ten thousand times as noisy as the rest has eight paths. A black block has one, and
  // does not make quiet ones look noisy.
  EXPECT_EQ(Blocks({{1, 1}, {1e4, 1}, {1, 1}, {4, 1}, {1, 1}, {1, 1}, {1, 1}, {1, 1}}).samples,
            (std::vector<int>{1, 8, 1, 2, 1, 1, 1, 1}));
  EXPECT_EQ(Blocks({{0, 1}, {1, 1}, {1, 1}, {1, 1}, {1, 1}, {1, 1}, {9, 1}}).samples,
            (std::vector<int>{1, 1, 1, 1, 1, 1, 3}));
  EXPECT_EQ(Blocks({{0, 1}, {0, 2}}).samples, (std::vector<int>{1, 1}));
  EXPECT_EQ(Blocks({{0, 0}, {0, 0}}).samples, (std::vector<int>{1, 1}));
  EXPECT_EQ(Blocks({{4, 1}, {4, 1}}).samples, (std::vector<int>{1, 1}));
}

TEST(AllocateSamples, LooksForChainsWhereThatIsCheaper) {
  struct Block {
    double chains, cost, choice;
    int expected_paths, expected_chains;
  };
  // Camera paths have variance 4 and cost 4 rays.
  const std::vector<Block> blocks = {
      {0, 1, 0, 1, 0},       // no boundaries, no light
      {0, 3, 0, 1, 1},       // boundaries, but no light yet: it may be rare
      {2, 9, 3, 1, 0},       // a tree costs more than it gains
      {1, 4, 100, 1, 1},     // rare reflections of lamps
      {36, 4, 1000, 1, 3},   // bright reflections
      {1e6, 4, 1e8, 1, 32},  // the maximum
      {0, 1, 0, 1, 0},
  };
  constexpr int kSide = 5;
  const int across = kSide * static_cast<int>(blocks.size());
  TileStatistics tiles_found;
  for (int y = 0; y < kSide; ++y)
    for (const Block& b : blocks)
      for (int x = 0; x < kSide; ++x) {
        tiles_found.paths.typical.push_back(4);
        tiles_found.paths.cost.push_back(4);
        tiles_found.chains.typical.push_back(b.chains);
        tiles_found.chains.cost.push_back(b.cost);
        tiles_found.choice.typical.push_back(b.choice);
        tiles_found.choice.cost.push_back(0);
      }
  const SampleAllocation shares = allocate_samples(tiles(across, kSide), 1, tiles_found);
  for (size_t i = 0; i < blocks.size(); ++i) {
    const size_t middle = static_cast<size_t>(across) * 2 + kSide * i + kSide / 2;
    EXPECT_EQ(shares.paths.counts()[middle], blocks[i].expected_paths) << i;
    EXPECT_EQ(shares.chains.counts()[middle], blocks[i].expected_chains) << i;
  }
}

TEST(AllocateSamples, HasFewPathsAPass) {
  // Ratios are kept, but quiet blocks have more than their share.
  const std::vector<int> samples =
      Blocks({{1, 1}, {64, 1}, {64, 1}, {64, 1}, {16, 1}, {64, 1}}).samples;
  EXPECT_EQ(samples, (std::vector<int>{1, 3, 3, 3, 1, 3}));
  // The caller's upper limit on the mean holds.
  SampleVariance::ByTile spread;
  for (int i = 0; i < 24; ++i) {
    spread.typical.push_back(i < 4 ? 1 : 64);
    spread.cost.push_back(1);
  }
  spread.light.assign(24, 1);
  double last = 0;
  for (const double most : {1.0, 2.0, 3.0}) {
    const double mean =
        allocate_samples({0, 0, 24 * 4, 4}, 1, {spread, {}, {}}, {most}).paths.mean();
    EXPECT_LE(mean, most);
    EXPECT_GT(mean, last);
    last = mean;
  }
}

TEST(AllocateSamples, HasFewWalksOfBothKindsTogether) {
  TileStatistics found;
  for (int i = 0; i < 24; ++i) {
    const double variance = i < 4 ? 1 : 64;
    for (SampleVariance::ByTile* of : {&found.paths, &found.chains}) {
      of->typical.push_back(variance);
      of->cost.push_back(2);
    }
    found.choice.typical.push_back(1e6);
    found.choice.cost.push_back(0);
  }
  double last = 0;
  for (const double most : {2.0, 4.0, 6.0}) {
    const SampleAllocation shares = allocate_samples({0, 0, 24 * 4, 4}, 1, found, {8, most});
    const double mean = shares.paths.mean() + shares.chains.mean();
    EXPECT_LE(mean, most);
    EXPECT_GT(mean, last);
    last = mean;
  }
}

TEST(MeanLimits, AreLowerInLargeFilms) {
  for (const int64_t pixels : {1, 512 * 512, 1280 * 1000}) {
    EXPECT_EQ(limits_of_film(pixels).paths, SampleMap::kMaxMean);
    EXPECT_EQ(limits_of_film(pixels).walks, kInfinity);
  }
  EXPECT_DOUBLE_EQ(limits_of_film(1600 * 1000).paths, 2);
  EXPECT_DOUBLE_EQ(limits_of_film(1600 * 1000).walks, 4);
  EXPECT_EQ(limits_of_film(3840 * 2160).paths, 1.5);
  EXPECT_EQ(limits_of_film(3840 * 2160).walks, 3);
}

// [A4]
TEST(Trial, KnowsTheLeastVarianceOfWhatItHasNotSeen) {
  const Trial blind{.light = 2, .error = 0.01, .samples = 500},
      sees{.light = 3, .error = 0.1, .samples = 100};
  EXPECT_DOUBLE_EQ(blind.min_variance_of_unseen(sees), 500 * 0.8 * 0.8 / 3.3);
  EXPECT_EQ(sees.min_variance_of_unseen(blind), 0);
  EXPECT_EQ(sees.min_variance_of_unseen(sees), 0);
  const Trial lucky{.light = 3, .error = 0.9, .samples = 100};
  EXPECT_EQ(blind.min_variance_of_unseen(lucky), 0) << "one bright path is no proof";
}

TEST(WinsorizedMean, LeavesOutTheFewThatStandOut) {
  EXPECT_EQ(winsorized_mean({}), 0);
  EXPECT_EQ(winsorized_mean({3}), 3);
  std::vector<double> values(1000, 2.0);
  EXPECT_DOUBLE_EQ(winsorized_mean(values), 2);
  values[500] = values[20] = 1e9;
  EXPECT_DOUBLE_EQ(winsorized_mean(values), 2);
  // It is a mean, not a median.
  for (size_t i = 0; i < 300; ++i) values[i] = 12;
  EXPECT_NEAR(winsorized_mean(values), 5, 0.02);
}

/// A model pass: per pixel, camera paths have variance a and cost c; N light paths have variance
/// b/N and cost d N.
struct Model {
  double a, b, c, d;
  double variance(double camera, double light) const {
    return a / camera + (b > 0 ? b / light : 0);
  }
  double cost(double camera, double light) const { return c * camera + d * light; }
  double expense(double camera, double light) const {
    return variance(camera, light) * cost(camera, light);
  }
  Trial trial(double light) const { return {a, light > 0 ? b / light : 0, c, d * light, light}; }
};

// [A3]
TEST(Balance, FindsTheBestNumberOfLightPaths) {
  for (const Model& m : {Model{0.2, 500, 1e5, 4}, Model{0.01, 2000, 4e5, 9}, Model{1, 3e4, 1e6, 2}})
    for (const double camera : {1.0, 2.6, 8.0}) {
      const Balance balance(m.trial(1 << 16));
      const double found = static_cast<double>(balance.light_paths(camera));
      double best = 1024;
      for (double n = 1024; n <= 1 << 20; n *= 1.001)
        if (m.expense(camera, n) < m.expense(camera, best)) best = n;
      EXPECT_NEAR(found, best, 0.02 * best);
      EXPECT_NEAR(balance.inverse_efficiency(),
                  m.expense(1, static_cast<double>(balance.light_paths(1))),
                  1e-6 * balance.inverse_efficiency());
    }
}

TEST(PassNoise, AddsUpWhatAPassHasInATile) {
  // The first tile has walks for chains, the second leaves these to camera paths, the third has
  // seen no camera paths at all.
  TileStatistics found;
  found.paths.typical = {6, 8, 9};
  found.paths.photons = {5, 1000, 7};
  found.paths.cost = {2, 3, 0};
  found.chains.typical = {12, 13, 14};
  found.chains.cost = {20, 21, 22};
  found.choice.typical = {15, 16, 17};
  found.choice.cost = {0, 0, 0};
  const PixelBounds b = tiles(3, 1);
  SampleAllocation samples{SampleMap(b), SampleMap(b, 0)};
  samples.paths.counts() = {2, 4, 3};
  samples.chains.counts() = {3, 0, 0};
  const PassNoise pass(found, samples, 100);
  EXPECT_EQ(pass.camera_paths, 3);
  EXPECT_EQ(pass.walk_rays, 3 * 20 / 2.0);
  ASSERT_EQ(pass.tiles.size(), 2u);
  EXPECT_EQ(pass.tiles[0].camera, 6 / 2.0 + 12 / 3.0);
  EXPECT_EQ(pass.tiles[0].photons, 500);
  EXPECT_EQ(pass.tiles[1].camera, 0.05 * 1000 / 4) << "more than (8 + 16) / 4";
  EXPECT_EQ(pass.tiles[1].photons, 1e5);
}

// [A8]
TEST(Balance, HasLightPathsForTheLeastMeanStandardDeviationOfTiles) {
  constexpr double kPixels = 1 << 14, kScale = 4;
  Trial trial = Model{0.2, 500, 1e5, 4}.trial(kPixels);
  trial.cost_of_merging = 0.25 * trial.cost_of_light;
  trial.pixels = kPixels;
  Balance balance(trial);
  balance.scale = kScale;
  TileStatistics found;
  const PixelBounds b = tiles(20, 5);
  SampleAllocation samples{SampleMap(b, 2), SampleMap(b, 0)};
  found.paths.typical.assign(100, 0.1);
  found.paths.photons.assign(100, 1);
  found.paths.cost.assign(100, 6);
  const auto inverse_efficiency = [&](double n, double walk_rays = 0) {
    double deviation = 0;
    for (const double v : found.paths.typical) deviation += std::sqrt(v / 2 + kPixels / n);
    // A light path costs 4 rays, 1 of them for merging, which a second camera path does again.
    return deviation * deviation *
           (2 * 1e5 / kPixels + walk_rays + (4 + 1) * n / (kPixels * kScale));
  };
  const auto best = [&] { return balance.light_paths(PassNoise(found, samples, kPixels)); };
  const int64_t even = best();
  for (int noisy : {0, 3, 10}) {
    // A few tiles that are very noisy do not take the photons from all others.
    std::fill_n(found.paths.typical.begin(), noisy, 10);
    const auto n = static_cast<double>(best());
    EXPECT_GT(n, static_cast<double>(balance.light_paths(2))) << noisy;
    EXPECT_LE(inverse_efficiency(n), 1.001 * inverse_efficiency(n * 1.07)) << noisy;
    EXPECT_LE(inverse_efficiency(n), 1.001 * inverse_efficiency(n / 1.07)) << noisy;
  }
  std::fill_n(found.paths.typical.begin(), 10, 0.1);
  EXPECT_EQ(best(), even);
  // A pass that takes longer for its walks can have more photons in the same proportion.
  PassNoise with_walks(found, samples, kPixels);
  with_walks.walk_rays = 20;
  const auto more = static_cast<double>(balance.light_paths(with_walks));
  EXPECT_GT(more, 1.2 * static_cast<double>(even));
  EXPECT_LE(inverse_efficiency(more, 20), 1.001 * inverse_efficiency(more * 1.07, 20));
  EXPECT_LE(inverse_efficiency(more, 20), 1.001 * inverse_efficiency(more / 1.07, 20));
  // What the measured pass has not seen, the trial has.
  found.paths.photons.assign(100, 0);
  EXPECT_EQ(best(), balance.light_paths(2));
  // Memory is a limit.
  found.paths.photons.assign(100, 1e6);
  balance.photons_of_path = 1;
  balance.max_photons = 3e4;
  EXPECT_LE(best(), 30000);
  EXPECT_GT(best(), 28000);
}

TEST(Balance, KeepsAsManyPhotonsAsMemoryIsFor) {
  const Model m{0.2, 5e4, 1e6, 4};
  Trial many = m.trial(1 << 16);
  const int64_t best = Balance(many).light_paths(1);
  for (const double photons : {0.01, 4.0}) {
    many.photons = photons;
    const Balance balance(many);
    const double most = std::min(balance.max_photons / photons, 4194304.0);
    EXPECT_EQ(balance.light_paths(100), static_cast<int64_t>(most));
    const double camera = balance.max_camera_paths();
    EXPECT_NEAR(static_cast<double>(balance.light_paths(camera)), most, 2);
    EXPECT_NEAR(static_cast<double>(balance.light_paths(camera / 2)), most / 2, 2);
    EXPECT_NEAR(camera, most / static_cast<double>(best), 1e-3 * camera);
  }
}

TEST(Balance, HasAFewestNumberOfLightPathsUnlessTheyLeaveTooManyPhotons) {
  const Model m{0.2, 500, 1e5, 4};
  Trial trial = m.trial(1 << 14);
  trial.photons = 4;
  Balance balance(trial);
  const int64_t best = balance.light_paths(1);
  balance.min_light_paths = 3.0 * static_cast<double>(best);
  EXPECT_EQ(balance.light_paths(1), 3 * best);
  balance.min_light_paths = 0.5 * static_cast<double>(best);
  EXPECT_EQ(balance.light_paths(1), best);
  balance.min_light_paths = 1e9;
  EXPECT_EQ(balance.light_paths(1), static_cast<int64_t>(balance.max_photons / 4));
}

// [A7] With more photons of all light, camera paths have less left to find.
TEST(Balance, HasMorePhotonsWhereTheyLowerTheNoiseOfCameraPaths) {
  constexpr double kTrialPaths = 1 << 14, kScale = 8;
  // The last two need fewer light paths than their trials had, so the bound counts.
  for (const Model& m :
       {Model{0.044, 270, 8.6e4, 3}, Model{0.023, 190, 7e4, 4.4}, Model{0.47, 1600, 9.6e4, 1.9},
        Model{0.0078, 12, 5.9e4, 4.7}, Model{0.16, 1, 1e4, 6}}) {
    const Trial trial = m.trial(kTrialPaths);
    Balance balance(trial);
    balance.scale = kScale;
    balance.min_light_paths = kScale * kTrialPaths;
    balance.let_photons_lower_variance_of_camera(trial);
    const auto expense = [&](double n) {
      return (m.a * std::sqrt(kTrialPaths / n) + m.b / n) * (m.c + m.d * n);
    };
    double best = kTrialPaths;
    for (double n = best; n <= 1 << 20; n *= 1.001)
      if (expense(n) < expense(best)) best = n;
    EXPECT_NEAR(static_cast<double>(balance.light_paths(1)), kScale * best, 0.002 * kScale * best);
  }
}

TEST(Balance, KeepsItsBoundsWhereAllPhotonsAreMerged) {
  const Model m{0.044, 270, 8.6e4, 3};
  Trial trial = m.trial(1 << 14);
  trial.photons = 4;
  Balance full(trial);
  full.max_photons = 1 << 16;
  full.let_photons_lower_variance_of_camera(trial);
  EXPECT_EQ(full.light_paths(1), 1 << 14) << "as many as memory is for";
  for (const Model& odd : {Model{0, 0, 1e5, 4}, Model{0.2, 0, 0, 4}, Model{0.2, 500, 1e5, 0}}) {
    Balance balance(odd.trial(1 << 14));
    balance.let_photons_lower_variance_of_camera(odd.trial(1 << 14));
    EXPECT_EQ(balance.light_paths(1), 1024);
  }
  Balance none(Model{0.3, 0, 2e5, 0}.trial(0));
  none.let_photons_lower_variance_of_camera(Model{0.3, 0, 2e5, 0}.trial(0));
  EXPECT_EQ(none.min_light_paths, 0);
}

// A small lattice of pixels represents a larger film: as many light paths per pixel, at the same
// efficiency.
TEST(Balance, GrowsWithTheFilm) {
  const Model m{0.2, 500, 1e5, 4};
  Trial many = m.trial(1 << 14);
  many.photons = 4;
  const Balance lattice(many);
  Balance film = lattice;
  film.scale = 16;
  film.max_photons = 16 * lattice.max_photons;
  EXPECT_NEAR(static_cast<double>(film.light_paths(2)),
              16 * static_cast<double>(lattice.light_paths(2)), 16);
  EXPECT_NEAR(film.inverse_efficiency(), lattice.inverse_efficiency(),
              1e-3 * lattice.inverse_efficiency());
  EXPECT_NEAR(film.max_camera_paths(), lattice.max_camera_paths(),
              1e-6 * lattice.max_camera_paths());
}

TEST(SampleMap, HasLargerTilesWhereItIsLearnedFromFewerPixels) {
  const PixelBounds b{0, 0, 100, 40};
  SampleMap map(b, 1, 3);
  ASSERT_EQ(map.counts().size(), 9u * 4u);
  map.counts()[map.tile_of(13, 12)] = 5;
  EXPECT_EQ(map.at(12, 12), 5);
  EXPECT_EQ(map.at(23, 23), 5);
  EXPECT_EQ(map.at(24, 12), 1);
  SampleVariance spread(b, 3);
  for (int y = 0; y < 40; y += 3)
    for (int x = 0; x < 100; x += 3)
      for (const double v : {1, 3}) spread.add(x, y, x < 50 ? v : 2 * v, 7);
  const SampleVariance::ByTile found = spread.by_tile();
  ASSERT_EQ(found.variance.size(), map.counts().size());
  EXPECT_NEAR(found.cost[map.tile_of(0, 0)], 7, 1e-12);
  EXPECT_NEAR(found.light[map.tile_of(99, 39)], 4, 1e-12);
}

TEST(Balance, KeepsItsBoundsWhateverTrialsSay) {
  // Light paths that add no noise, or cost nothing, are reduced to the minimum.
  EXPECT_EQ(Balance(Model{0.2, 0, 1e5, 4}.trial(1 << 16)).light_paths(1), 1024);
  EXPECT_EQ(Balance(Model{0.2, 500, 1e5, 0}.trial(1 << 16)).light_paths(1), 1024);
  // Camera paths without noise do not give all work to light paths.
  const Balance still(Model{0, 500, 1e5, 4}.trial(1 << 16));
  EXPECT_LT(still.light_paths(1), 1 << 22);
  EXPECT_EQ(still.light_paths(1e3), 1 << 22);
  // Passes without light paths.
  EXPECT_NEAR(Balance(Model{0.3, 0, 2e5, 0}.trial(0)).inverse_efficiency(), 6e4, 1e-6);
}

}  // namespace
}  // namespace nephroid
