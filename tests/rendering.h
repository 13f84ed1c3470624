// Renders small scenes for tests of whole pictures, from a scene's text to a film, without files.
// Also computes statistics over independent seeds, rendered in parallel.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "core/errors.h"
#include "core/parallel.h"
#include "estimators.h"
#include "film/film_settings.h"
#include "input/pbrt_parser.h"
#include "integrator/photon_mapping/photon_map.h"
#include "integrator/presets/integrator_table.h"
#include "integrator/presets/route_presets.h"
#include "scene/scene.h"
#include "source_directory.h"

namespace nephroid::testing_support {

inline std::unique_ptr<Scene> scene_from_text(const std::string& text) {
  Diagnostics diagnostics;
  const SceneDescription d = parse_pbrt_string(
      text, "test.pbrt", testing_support::source_directory() + "/tests", diagnostics);
  return build_scene(d, {}, diagnostics);
}

inline Film film_for(const Scene& scene, const EstimatorSet& preset) {
  return Film(film_settings(scene.film), preset.layout);
}

/// The routes of an integrator or a preset.
inline RoutePlan plan_named(const std::string& name) {
  if (auto routes = route_preset(name)) return {*std::move(routes), {}, false};
  return plan_of_integrator(name);
}

inline RoutePlan plan_of(const std::vector<std::string>& routes,
                         const std::vector<std::string>& aovs = {}) {
  RoutePlan plan;
  for (const std::string& route : routes)
    plan.routes.push_back(parse_route(route, estimator_traits()));
  for (const std::string& aov : aovs) plan.aovs.push_back(parse_aov(aov));
  return plan;
}

/// One name that plan_named() knows for each set of routes: all integrators, and the presets that
/// equal none of them.
inline std::vector<std::string> plan_names() {
  const auto same = [](const RouteDefinition& a, const RouteDefinition& b) {
    return a.expression == b.expression && a.estimator == b.estimator;
  };
  std::vector<std::string> names = integrator_names();
  const std::vector<std::string> integrators = names;
  for (const RoutePreset& preset : route_presets()) {
    const auto routes = plan_named(preset.name).routes;
    if (std::none_of(integrators.begin(), integrators.end(), [&](const std::string& name) {
          const auto others = plan_of_integrator(name).routes;
          return std::equal(routes.begin(), routes.end(), others.begin(), others.end(), same);
        }))
      names.emplace_back(preset.name);
  }
  return names;
}

/// A plan's name as part of a test's name.
inline std::string test_name(std::string plan) {
  std::replace(plan.begin(), plan.end(), '-', '_');
  return plan;
}

/// True if some photons of the plan are merged, which biases the picture.
inline bool merges_photons(const RoutePlan& plan) {
  return std::any_of(plan.routes.begin(), plan.routes.end(), [](const RouteDefinition& route) {
    return route.estimator->merges ||
           descriptor_of({.estimator = route.estimator, .routes = {}, .parts = {}})
               .merges_with_radius;
  });
}

/// The first pass traces a whole photon map, and 16 passes read all of it. Chooses map_photons,
/// camera samples and passes so that the map takes no more photons and camera paths than `passes`
/// passes of other estimators. Plans without photon maps are left unchanged.
inline void use_whole_maps(const RoutePlan& plan, IntegratorOptions& options, uint32_t& passes) {
  if (std::none_of(plan.routes.begin(), plan.routes.end(), [](const RouteDefinition& route) {
        return is_one_of(route.estimator, {"photonmap"});
      }))
    return;
  constexpr int kPasses = 16;
  const int count = static_cast<int>(passes);
  options.edit<PhotonMapOptions>().map_photons = options.photons_per_pass * count;
  options.camera_samples_per_pass =
      (options.camera_samples_per_pass * count + kPasses - 1) / kPasses;
  passes = kPasses;
}

/// A plan, or a plan's name.
struct Plan : RoutePlan {
  Plan(const RoutePlan& plan) : RoutePlan(plan) {}
  Plan(const std::string& name) : RoutePlan(plan_named(name)) {}
  Plan(const char* name) : RoutePlan(plan_named(name)) {}
};

/// Learned values of a plan's estimators, for one scene.
using PlanLearned = std::vector<std::shared_ptr<const Learned>>;
inline PlanLearned learn(const Scene& scene, const Plan& plan, const IntegratorOptions& options,
                         uint64_t seed) {
  const EstimatorSet preset = make_estimators(plan, options, scene);
  const FilmFormat format = film_for(scene, preset).format();
  PlanLearned learned;
  for (const auto& estimator : preset.estimators)
    learned.push_back(LearningLoop().learn(*estimator, seed, scene, format));
  return learned;
}

/// Renders passes [first, first + count) of a scene. Estimators use `learned` if it is given,
/// instead of learning anew, unless what they learn is part of their light.
inline Film render(const Scene& scene, const Plan& plan, const IntegratorOptions& options,
                   uint64_t seed, uint32_t count, uint32_t first = 0,
                   const PlanLearned& learned = {}) {
  EstimatorSet preset = make_estimators(plan, options, scene);
  Film film = film_for(scene, preset);
  preset.learned.resize(preset.estimators.size());
  for (size_t i = 0; i < learned.size(); ++i)
    if (!preset.estimators[i]->descriptor().capabilities.learned_is_light)
      preset.learned[i].use(learned[i]);
  for (uint32_t pass = first; pass < first + count; ++pass)
    preset.render_pass({seed, pass}, scene, film);
  return film;
}

/// Mean of (R + G + B) / 3 over the picture.
inline double picture_mean(const Film& film) {
  double sum = 0;
  const PixelBounds& b = film.bounds();
  for (int y = b.y0; y < b.y1; ++y)
    for (int x = b.x0; x < b.x1; ++x) {
      const Rgb v = film.value(x, y);
      sum += (static_cast<double>(v.r) + v.g + v.b) / 3;
    }
  return sum / static_cast<double>(b.area());
}

/// Mean of independent values with the standard error of that mean.
struct Estimate {
  double mean = 0, error = 0;
};
inline Estimate estimate_of(const std::vector<double>& values) {
  const double n = static_cast<double>(values.size());
  Estimate e;
  for (const double v : values) e.mean += v / n;
  double squares = 0;
  for (const double v : values) squares += (v - e.mean) * (v - e.mean);
  e.error = std::sqrt(squares / (n - 1) / n);
  return e;
}

/// Values of independent renders, as [part][seed].
using SeedValues = std::vector<std::vector<double>>;

/// Means of `across` x `across` equal blocks of the picture, row by row. Width and height must be
/// multiples of `across`.
inline std::vector<double> block_means(const Film& film, int across) {
  const PixelBounds& b = film.bounds();
  std::vector<double> means(static_cast<size_t>(across) * static_cast<size_t>(across), 0.0);
  const int width = b.width() / across, height = b.height() / across;
  for (int y = 0; y < across * height; ++y)
    for (int x = 0; x < across * width; ++x) {
      const Rgb v = film.value(b.x0 + x, b.y0 + y);
      means[static_cast<size_t>(y / height * across + x / width)] +=
          (static_cast<double>(v.r) + v.g + v.b) / (3.0 * width * height);
    }
  return means;
}

/// Added to every seed of a statistical comparison: zero, or set by NEPHROID_TEST_SEED (an integer)
/// for `make test-nightly`. Different values give disjoint sets of seeds.
inline uint64_t seed_offset() {
  const char* text = std::getenv("NEPHROID_TEST_SEED");
  return text ? std::strtoull(text, nullptr, 10) << 20 : 0;
}

/// True in `make test`. Noise limits hold only for the fixed seeds: with others, a few rare bright
/// paths can double the standard error of 16 seeds.
inline bool fixed_seeds() {
  return seed_offset() == 0;
}

/// The standard error above which a comparison is too noisy.
inline double max_error(double limit) {
  return fixed_seeds() ? limit : std::numeric_limits<double>::infinity();
}

/// Calls `values_of_seed` for `seeds` seeds in parallel. It must make its own estimators, which
/// hold statistics. The result does not depend on the number of threads.
inline SeedValues values_over_seeds(
    int seeds, uint64_t first_seed,
    const std::function<std::vector<double>(uint64_t seed)>& values_of_seed) {
  std::vector<std::vector<double>> by_seed(static_cast<size_t>(seeds));
  const uint64_t first = first_seed + seed_offset();
  parallel_chunks(seeds, 1, [&](int64_t s, int64_t, int64_t) {
    by_seed[static_cast<size_t>(s)] = values_of_seed(first + static_cast<uint64_t>(s));
  });
  SeedValues values(by_seed.front().size());
  for (const std::vector<double>& of_seed : by_seed)
    for (size_t i = 0; i < values.size(); ++i) values[i].push_back(of_seed[i]);
  return values;
}

/// Means of all blocks for each seed.
inline std::vector<double> mean_of_blocks(const SeedValues& blocks) {
  std::vector<double> values(blocks[0].size(), 0.0);
  for (const auto& block : blocks)
    for (size_t s = 0; s < block.size(); ++s)
      values[s] += block[s] / static_cast<double>(blocks.size());
  return values;
}

/// Block means over `seeds` independent renders. All use what the first seed learns: an estimator
/// is unbiased whatever it has learned. agreement/learning_test.cpp learns anew for each seed.
inline SeedValues block_values(const Scene& scene, const Plan& plan,
                               const IntegratorOptions& options, int seeds, uint32_t passes,
                               uint64_t first_seed, int across = 1) {
  const PlanLearned learned = learn(scene, plan, options, first_seed + seed_offset());
  return values_over_seeds(seeds, first_seed, [&](uint64_t seed) {
    return block_means(render(scene, plan, options, seed, passes, 0, learned), across);
  });
}

/// IntegratorOptions::nearest_photons for which photon maps use a fixed radius, with a bias that
/// falls with the squared radius as for other estimators.
inline constexpr int kAllPhotons = 1 << 30;

/// Extrapolates block_values() to a radius of zero: the bias falls with r^2, so the value is 2
/// L(r^2/2) - L(r^2). Both renders of a seed share all random numbers, so that light without a
/// radius keeps its own noise. Plans that merge nothing are rendered as they are.
inline SeedValues unbiased_block_values(const Scene& scene, const Plan& plan,
                                        const IntegratorOptions& options, int seeds,
                                        uint32_t passes, uint64_t first_seed, int across = 1) {
  if (!merges_photons(plan))
    return block_values(scene, plan, options, seeds, passes, first_seed, across);
  IntegratorOptions smaller = options;
  smaller.radius *= std::sqrt(0.5f);
  const PlanLearned learned = learn(scene, plan, options, first_seed + seed_offset());
  return values_over_seeds(seeds, first_seed, [&](uint64_t seed) {
    const auto means = [&](const IntegratorOptions& own) {
      return block_means(render(scene, plan, own, seed, passes, 0, learned), across);
    };
    const std::vector<double> large = means(options);
    std::vector<double> values = means(smaller);
    for (size_t i = 0; i < values.size(); ++i) values[i] = 2 * values[i] - large[i];
    return values;
  });
}

/// Picture means over `seeds` independent renders.
inline Estimate mean_over_seeds(const Scene& scene, const Plan& plan,
                                const IntegratorOptions& options, int seeds, uint32_t passes,
                                uint64_t first_seed = 1) {
  return estimate_of(block_values(scene, plan, options, seeds, passes, first_seed)[0]);
}

/// Quantiles of Student's t for 15 and 31 degrees of freedom, at a two-sided level of 1e-5. A
/// correct program fails for one in a hundred thousand choices of the seeds, which are fixed.
inline constexpr double kT15 = 6.5;
inline constexpr double kT31 = 5.27;

}  // namespace nephroid::testing_support
