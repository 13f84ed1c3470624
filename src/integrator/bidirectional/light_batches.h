// The light paths of a pass that leave photons, traced in batches that fit in memory. Their
// connections to the camera become splats. It must not know the film's sums or what photons are
// merged with.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "film/splats.h"
#include "integrator/bidirectional/path_pair.h"
#include "integrator/photons/photon_pass.h"

namespace nephroid {

/// Keeps references to the pass and the settings.
class LightBatches {
 public:
  struct Config {
    int64_t light_paths = 0;     ///< light paths of the pass, in all batches together
    int64_t memory_photons = 0;  ///< number of photons at which a batch is full
    uint64_t seed = 0;           ///< seed of all passes
    /// Passes differ in their number of light paths: each number has a sequence of its own.
    bool number_varies = false;
  };
  LightBatches(const Config& config, const PhotonPass& pass, const PairSettings& settings)
      : config_(config),
        pass_(pass),
        settings_(settings),
        places_(*settings.owned.routes, settings.owned.group) {}

  /// True once all light paths are traced.
  bool empty() const { return begin_ >= config_.light_paths; }
  /// Traces the next batch and returns its photons. Calls `expose` with splats, a few times, in
  /// order. Adds to the counts.
  std::vector<Photon> next(const std::function<void(std::span<const Splat>)>& expose,
                           EstimatorStatistics& statistics);

  /// Median distance from the eye of the photons in media that the first light paths of the pass
  /// left, however large the batches are; 0 if there are none. Known after the first call of
  /// next().
  float media_distance() const { return media_distance_; }

  /// Traces light path `j` of the pass alone. Adds its connections to `seen`, its photons to
  /// `photons`.
  LightPathCounts trace_path(int64_t j, std::vector<CameraSplat>& seen,
                             std::vector<Photon>& photons) const;
  /// The walk of that light path.
  LightPathRecord record_path(int64_t j) const;

 private:
  struct Chunk {
    std::vector<Photon> photons;
    std::vector<Splat> splats;
    uint64_t rays = 0, useful = 0, specular = 0;
  };
  /// Calls f(sampler, wavelengths) with the random numbers of light path `j` of the pass.
  template <class F>
  void at_path(int64_t j, F&& f) const;
  void trace_chunk(int64_t begin, int64_t end, Chunk& chunk) const;
  void reserve(std::vector<Photon>& photons, std::span<const Chunk> chunks,
               int64_t batch_begin) const;

  const Config config_;
  const PhotonPass& pass_;
  const PairSettings& settings_;
  const PartSums places_;
  int64_t begin_ = 0;  ///< number of the next light path
  float media_distance_ = 0;
};

}  // namespace nephroid
