// Explains a pixel: the shares of its routes and layers, which the film has, and those of its
// lights, techniques and words, from paths that are traced again. It must not know how estimators
// work.
#pragma once

#include <string>
#include <vector>

#include "film/film.h"
#include "integrator/presets/estimator_set.h"

namespace nephroid {

/// A layer of the film.
struct Share {
  std::string name;
  Rgb value;
};

/// A sum over paths that were traced again. Shares are parts of their total luminance.
struct EstimatedShare {
  std::string name;
  Rgb value;
  double error = 0;  ///< standard error of the value's luminance
  double share = 0, share_error = 0;
};

/// All paths of one word and one route.
struct InspectedPath {
  std::string word;  ///< as in docs/routes.md: "C <TS'glass'> <RD'floor'> <L.'key'>"
  std::string route, light;
  Rgb value;
  double share = 0, share_error = 0;  ///< as in EstimatedShare
  std::string technique;              ///< technique that finds most of the value
  /// Vertices of the brightest path: the lens, the scattering events, and the light, or a point far
  /// away in its direction. Subsurface light has two vertices, one where it enters.
  std::vector<Vec3f> points;
  /// The same in pixels of the full picture; NaN where the camera does not see them.
  std::vector<Vec2f> pixels;
};

struct PixelInspection {
  int x = 0, y = 0;
  uint64_t samples = 0;  ///< estimates of the pixel
  Rgb value, standard_error;
  std::vector<Share> routes, layers;
  std::vector<EstimatedShare> lights, techniques;  ///< brightest first
  Rgb traced;                                      ///< sum of all paths that were traced again
  double traced_error = 0;                         ///< standard error of its luminance
  std::vector<InspectedPath> paths;                ///< brightest words first, at most kMaxWords
  std::vector<std::string> notes;                  ///< limits of the estimates, as sentences

  static constexpr size_t kMaxWords = 16;
};

struct InspectionSettings {
  int camera_paths = 4096;
  int64_t light_paths = 1 << 19;
  uint64_t seed = 0;            ///< the render's seed, so that its learned values are used
  IntegratorOptions options{};  ///< the render's options
};

/// Traces paths of a pixel again. Called while no pass is rendered. A function of its arguments.
/// Throws UsageError for a pixel outside of the crop.
PixelInspection inspect_pixel(const Scene& scene, EstimatorSet& set, const Film& film, int x, int y,
                              const InspectionSettings& settings);

}  // namespace nephroid
