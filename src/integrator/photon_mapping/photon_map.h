// `photonmap`: a photon map of its route, traced once and read by all passes, each estimate made of
// the nearest photons. The map's photons lie in 16 sets, each with the wavelengths, time and
// roughness threshold of one photon pass; pass p walks with those of set p mod 16, so 16 passes
// read the whole map once and further passes smooth edges, lenses and gather rays, but not the
// light itself. Who calls it: presets. It must not know how photons are found. Papers: Jensen 1996,
// 2001.
#pragma once

#include <memory>
#include <optional>
#include <span>

#include "integrator/estimator/estimator.h"
#include "photon/photon_grid.h"
#include "route/scene_symbols.h"

namespace nephroid {

struct PhotonPass;

class PhotonMap : public Estimator {
 public:
  PhotonMap(OwnedRoutes owned, const IntegratorOptions& options);

  Capabilities capabilities() const override { return {.consistent = false}; }
  void render_pass(const PassKey& key, const Scene& scene, Film& film) override;
  EstimatorStatistics statistics() const override;

  /// Of an estimate, in footprints: the user's, or the default.
  static float largest_radius(const IntegratorOptions& options);

 private:
  struct Map {
    uint64_t seed = 0;
    std::unique_ptr<PhotonGrid> grid;
    double paths_of_set = 0;
  };
  /// Smallest and largest radius of a row's estimates in footprints.
  struct RadiusRange {
    float smallest = kInfinity, largest = 0;
  };
  /// One walk of each pixel, by the random numbers of `walk_seed`, which reads the photons of a
  /// set.
  void read(const Map& map, const PassKey& set, uint64_t walk_seed, const PhotonPass& pass,
            const Scene& scene, Film& film, std::span<RadiusRange> rows);
  /// Traces the map of a seed if there is none yet.
  const Map& map_of(uint64_t seed, const Scene& scene, const Film& film);

  OwnedRoutes owned_;
  IntegratorOptions options_;
  bool photons_can_count_;
  uint32_t walks_per_pass_;  ///< of a pixel
  std::optional<Map> map_;
  uint64_t found_ = 0;  ///< photons merged
  EstimatorStatistics statistics_;
};

}  // namespace nephroid
