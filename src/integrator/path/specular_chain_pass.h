// One pass of walks for specular chains: lights behind delta lobes alone, which a pass of path
// pairs may leave to it. A map gives the walks per pixel. Each walk has wavelengths and a time of
// its own, since it needs no photons. It must not know the film's sums.
#pragma once

#include <span>
#include <vector>

#include "film/film.h"
#include "film/part_sums.h"
#include "integrator/estimator/lamp_counter.h"
#include "integrator/estimator/sample_map.h"
#include "integrator/estimator/technique_counter.h"
#include "integrator/path/specular_tree.h"
#include "transport/path_points.h"

namespace nephroid {

/// Variance of the light of specular chains.
struct ChainVariance {
  explicit ChainVariance(const PixelBounds& b, int spacing = 1)
      : walks(b, spacing), choice(b, spacing) {}
  SampleVariance walks;   ///< variance of the walks of a SpecularChainPass: σ_g² of [S2]
  SampleVariance choice;  ///< predicted variance of camera paths that choose one way: σ_p² there
};

struct SpecularChainPass {
  const Scene& scene;
  const FilmFormat& film;
  const OwnedRoutes& owned;
  const SpecularTree& tree;
  const SampleMap& walks;                  ///< walks per pixel; may be 0
  uint64_t seed = 0;                       ///< the estimator's seed
  float specular_alpha = 0;                ///< roughness threshold of the pass
  ChainVariance* measured = nullptr;       ///< collects the variance of walks; null: not measured
  TechniqueCounter* techniques = nullptr;  ///< counts the light found
  LampCounter* lamps = nullptr;            ///< counts it by lamp
  PassControl& control = unwatched;

  /// Sobol' points of the walks of a pixel with n walks, [n][walk].
  using Points = std::vector<std::vector<SobolPoint>>;
  /// Walk k of a pixel with n walks has Sobol' index first_index(n) + k.
  template <class FirstIndex>
  Points points(FirstIndex&& first_index) const {
    Points all(walks.most() + 1);
    for (int n = 1; n <= walks.most(); ++n)
      if (walks.has(n))
        for (int k = 0; k < n; ++k) all[n].push_back(eye_point(first_index(n) + k));
    return all;
  }
  /// State of consecutive walks on one thread.
  struct Walker {
    explicit Walker(const SpecularChainPass& pass);
    PartSums light;
    TechniqueCounter::Row techniques;
    LampCounter::Slice lamps;
    std::vector<SpecularTree::Light> found;
    uint64_t rays = 0;
    PathRecorder* recorder = nullptr;  ///< null: paths are not recorded
  };
  /// Adds the estimate of a pixel, counted from the crop's corner, to values[part].
  void look(int x, int y, const Points& points, std::span<Rgb> values, Walker& walker) const;
  /// Adds the estimates of all pixels to values[pixel * parts + part]. Returns the number of rays.
  uint64_t render(std::span<Rgb> values, const Points& points) const;
};

}  // namespace nephroid
