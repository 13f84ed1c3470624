// Renders small scenes for the tests that look at whole pictures: from a scene's text to a film,
// without files, and statistics over independent seeds. Used by statistical, analytic, agreement
// and determinism tests.
#pragma once

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "core/errors.h"
#include "film/film.h"
#include "input/pbrt_parser.h"
#include "integrator/estimator.h"
#include "scene/scene.h"

namespace nephroid::testing_support {

inline std::unique_ptr<Scene> scene_from_text(const std::string& text) {
  Diagnostics diagnostics;
  const SceneDescription d =
      parse_pbrt_string(text, "test.pbrt", NEPHROID_SOURCE_DIR "/tests", diagnostics);
  return build_scene(d, {}, diagnostics);
}

inline Film film_for(const Scene& scene, const Preset& preset) {
  FilmSettings settings;
  settings.width = scene.film.width;
  settings.height = scene.film.height;
  settings.crop = {scene.film.crop_x0, scene.film.crop_y0, scene.film.crop_x1, scene.film.crop_y1};
  settings.imaging_ratio = scene.film.imaging_ratio;
  settings.max_component = scene.film.max_component;
  settings.color_space = scene.film.color_space;
  settings.white_balance = scene.film.white_balance;
  settings.gbuffer = scene.film.gbuffer != GBufferSpace::kNone;
  return Film(settings, preset.layout);
}

/// Renders passes [first, first + count) of a scene.
inline Film render(const Scene& scene, const std::string& integrator,
                   const IntegratorOptions& options, uint64_t seed, uint32_t count,
                   uint32_t first = 0) {
  Preset preset = make_integrator(integrator, options, scene);
  Film film = film_for(scene, preset);
  for (uint32_t pass = first; pass < first + count; ++pass)
    for (const auto& estimator : preset.estimators)
      estimator->render_pass({seed, pass}, scene, film);
  return film;
}

/// Mean over the picture of the luminance-like sum of channels / 3.
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

/// Means of `across` x `across` equal blocks of the picture, row by row. The size must be a
/// multiple.
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

/// Block means over `seeds` independent renders.
inline SeedValues block_values(const Scene& scene, const std::string& integrator,
                               const IntegratorOptions& options, int seeds, uint32_t passes,
                               uint64_t first_seed, int across = 1) {
  SeedValues values(static_cast<size_t>(across) * static_cast<size_t>(across));
  for (int s = 0; s < seeds; ++s) {
    const std::vector<double> means = block_means(
        render(scene, integrator, options, first_seed + static_cast<uint64_t>(s), passes), across);
    for (size_t i = 0; i < means.size(); ++i) values[i].push_back(means[i]);
  }
  return values;
}

/// The same without the bias of the merge radius, which falls with r^2: 2 L(r^2/2) - L(r^2). Both
/// renders of a seed share all random numbers, so what does not depend on the radius keeps its own
/// noise only.
inline SeedValues unbiased_block_values(const Scene& scene, const std::string& integrator,
                                        IntegratorOptions options, int seeds, uint32_t passes,
                                        uint64_t first_seed, int across = 1) {
  const SeedValues large =
      block_values(scene, integrator, options, seeds, passes, first_seed, across);
  options.radius *= std::sqrt(0.5f);
  SeedValues values = block_values(scene, integrator, options, seeds, passes, first_seed, across);
  for (size_t i = 0; i < values.size(); ++i)
    for (size_t s = 0; s < values[i].size(); ++s) values[i][s] = 2 * values[i][s] - large[i][s];
  return values;
}

/// Picture means over `seeds` independent renders.
inline Estimate mean_over_seeds(const Scene& scene, const std::string& integrator,
                                const IntegratorOptions& options, int seeds, uint32_t passes,
                                uint64_t first_seed = 1) {
  return estimate_of(block_values(scene, integrator, options, seeds, passes, first_seed)[0]);
}

/// Quantiles of Student's t for 15 and 31 degrees of freedom at a two-sided level of 1e-5: a test
/// that is right fails once in a hundred thousand choices of the seeds, and these are fixed.
inline constexpr double kT15 = 6.5;
inline constexpr double kT31 = 5.27;

}  // namespace nephroid::testing_support
