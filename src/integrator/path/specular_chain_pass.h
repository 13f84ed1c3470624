// One pass of walks for specular chains: lights behind delta lobes alone, which a pass of pairs may
// leave to others. As many walks for each pixel as a map says, with wavelengths and times that no
// other walk shares, because they have no photons in common. It must not know films' sums.
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

/// How much the light of specular chains varies.
struct ChainVariance {
  explicit ChainVariance(const PixelBounds& b, int spacing = 1)
      : walks(b, spacing), choice(b, spacing) {}
  SampleVariance walks;   ///< of the walks of a SpecularChainPass
  SampleVariance choice;  ///< of camera paths that choose one way at each boundary, as far as known
};

struct SpecularChainPass {
  const Scene& scene;
  const FilmFormat& film;
  const OwnedRoutes& owned;
  const SpecularTree& tree;
  const SampleMap& walks;                  ///< of each pixel; may be 0
  uint64_t seed = 0;                       ///< of the estimator
  float specular_alpha = 0;                ///< of the pass
  ChainVariance* measured = nullptr;       ///< measures what each walk finds; null: nobody asks
  TechniqueCounter* techniques = nullptr;  ///< where what was found is counted
  LampCounter* lamps = nullptr;            ///< the same by lamp
  PassControl& control = unwatched;

  /// Numbers of the walks of a pixel that has n, [n][walk].
  using Points = std::vector<std::vector<SobolPoint>>;
  /// Walk k of n has the number first_index(n) + k of its pixel.
  template <class FirstIndex>
  Points points(FirstIndex&& first_index) const {
    Points all(walks.most() + 1);
    for (int n = 1; n <= walks.most(); ++n)
      if (walks.has(n))
        for (int k = 0; k < n; ++k) all[n].push_back(eye_point(first_index(n) + k));
    return all;
  }
  /// What walks need that follow each other on one thread.
  struct Walker {
    explicit Walker(const SpecularChainPass& pass);
    PartSums light;
    TechniqueCounter::Row techniques;
    LampCounter::Slice lamps;
    std::vector<SpecularTree::Light> found;
    uint64_t rays = 0;
  };
  /// Adds the estimate of a pixel, counted from the corner of the crop, to values[part].
  void look(int x, int y, const Points& points, std::span<Rgb> values, Walker& walker) const;
  /// Adds the estimates of all pixels to values[pixel * parts + part]. Returns the number of rays.
  uint64_t render(std::span<Rgb> values, const Points& points) const;
};

}  // namespace nephroid
