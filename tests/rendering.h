// Renders small scenes for the tests that look at whole pictures: from a scene's text to a film, without
// files, and statistics over independent seeds. Used by statistical, analytic, agreement and determinism
// tests.
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
  return Film(settings, preset.route_names);
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

/// Picture means over `seeds` independent renders.
inline Estimate mean_over_seeds(const Scene& scene, const std::string& integrator,
                                const IntegratorOptions& options, int seeds, uint32_t passes,
                                uint64_t first_seed = 1) {
  std::vector<double> values;
  for (int s = 0; s < seeds; ++s)
    values.push_back(picture_mean(
        render(scene, integrator, options, first_seed + static_cast<uint64_t>(s), passes)));
  return estimate_of(values);
}

/// Quantile of Student's t for 15 degrees of freedom at a two-sided level of 1e-5: with 16 seeds a test that
/// is right fails once in a hundred thousand choices of the seeds, and these are fixed.
inline constexpr double kT15 = 6.5;

}  // namespace nephroid::testing_support
