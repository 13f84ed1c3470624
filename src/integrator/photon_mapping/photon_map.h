// `photonmap`: a photon map of its route, traced once and read by all passes ([N1]). Its photons
// lie in 16 sets; pass p reads set p mod 16 and shares its wavelengths, time and roughness
// threshold. Passes after the 16th smooth edges, lenses and gather rays, not the light itself. It
// must not know how photons are found. Papers: Jensen 1996, 2001.
#pragma once

#include <span>

#include "integrator/estimator/estimator.h"
#include "route/scene_symbols.h"

namespace nephroid {

struct PhotonPass;
struct TracedMap;

struct PhotonMapOptions {
  int64_t map_photons = 0;    ///< photon paths per map; 0: as many as 16 passes emit
  int nearest_photons = 100;  ///< photons per estimate
};

class PhotonMap : public Estimator {
 public:
  PhotonMap(OwnedRoutes owned, const IntegratorOptions& options);

  static const EstimatorDescriptor kDescriptor;
  const EstimatorDescriptor& descriptor() const override { return kDescriptor; }
  std::shared_ptr<const Learned> learn(const Scene& scene, const FilmFormat& film, uint64_t seed,
                                       PassControl& control) const override;
  std::shared_ptr<const Learned> read_learned(ByteReader& from, const FilmFormat&) const override;
  void render_pass(const PassKey& key, const Learned* learned, const Scene& scene, Film& film,
                   PassControl& control) override;
  EstimatorStatistics statistics() const override;

  /// Largest radius of an estimate in footprints: the user's, or the default.
  static float largest_radius(const IntegratorOptions& options);

 private:
  /// Smallest and largest radius among a row's estimates, in footprints.
  struct RadiusRange {
    float smallest = kInfinity, largest = 0;
  };
  /// Runs one walk per pixel, with random numbers of `walk_seed`, that reads the photons of a set.
  void read(const TracedMap& map, const PassKey& set, uint64_t walk_seed, const PhotonPass& pass,
            const Scene& scene, Film& film, std::span<RadiusRange> rows);
  /// The seed of the map's own random numbers.
  uint64_t seed_of_map(uint64_t seed) const;

  OwnedRoutes owned_;
  IntegratorOptions options_;
  bool photons_can_count_;
  uint32_t walks_per_pass_;  ///< walks per pixel and pass
  uint64_t found_ = 0;       ///< photons merged
  EstimatorStatistics statistics_;
};

}  // namespace nephroid
