// Traces photons and keeps those of an estimator's routes. Photon j of pass i depends on (seed, i,
// j) alone. Chunks of photons are traced on any thread and joined in the order of their numbers
// (docs/architecture.md, section 5). It must not know films or cameras.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "core/pass_control.h"
#include "photon/photon.h"
#include "photon/photon_guide.h"
#include "route/scene_symbols.h"
#include "transport/random_walk.h"
#include "transport/walk_record.h"

namespace nephroid {

struct PhotonTrace {
  std::vector<Photon> photons;
  uint64_t paths = 0;           ///< light paths emitted
  uint64_t useful_paths = 0;    ///< paths that stored a photon
  uint64_t specular_paths = 0;  ///< paths with an S event
  uint64_t rays = 0;
};

struct PhotonTraceSettings {
  PassKey key;
  int64_t photons_per_pass = 0;  ///< each pass continues the sequence of the one before
  SampledWavelengths lambda;     ///< wavelengths of the pass
  float time = 0;
  float specular_alpha = 0;  ///< specular threshold of the pass, [C2]
  int max_events = 0;        ///< events of a whole path; a photon lands with fewer
  const PhotonGuide* guide = &kUnguidedPhotons;
  PassControl* control = &unwatched;  ///< asked between chunks of photons
};

/// Traces the light paths begin <= j < end of the pass. Stores a photon at every surface with a
/// finite D or G lobe where the group may merge its light side. Flux is that of one photon: divide
/// by the number emitted.
PhotonTrace trace_photons(const Scene& scene, const OwnedRoutes& owned,
                          const PhotonTraceSettings& settings, int64_t begin, int64_t end);

/// Adds the photons of light path `j` alone to `photons`.
void trace_photons_of_path(const Scene& scene, const OwnedRoutes& owned,
                           const PhotonTraceSettings& settings, int64_t j,
                           std::vector<Photon>& photons);
/// The walk of that light path.
LightPathRecord record_photon_path(const Scene& scene, const OwnedRoutes& owned,
                                   const PhotonTraceSettings& settings, int64_t j);

/// The useful starts found by paths of learning.
struct UsefulStarts {
  std::vector<UsefulStart> starts;
  /// The starts whose path needed an S behind a rough vertex; `first_hit` is where it met that S.
  std::vector<UsefulStart> casters;
  uint64_t rays = 0;
};
/// Starts of the paths begin <= j < end that stored a useful photon. `is_useful` is called on any
/// thread.
UsefulStarts trace_useful_starts(const Scene& scene, const OwnedRoutes& owned,
                                 const PhotonTraceSettings& settings, int64_t begin, int64_t end,
                                 const std::function<bool(const Photon&)>& is_useful);

/// Traces from light path `begin` on, in groups of whole chunks, until the pass ends or `limit`
/// photons are stored. So a pass whose photons do not fit in memory is traced, gathered and dropped
/// in batches. Moves `begin` to where it stopped, which depends on the scene and the settings
/// alone.
PhotonTrace trace_batch(const Scene& scene, const OwnedRoutes& owned,
                        const PhotonTraceSettings& settings, int64_t limit, int64_t& begin);

/// The photons of a map. All sets trace the same path numbers, in whole chunks, until they end or
/// `limit` photons are stored. `paths_of_set` is the number of paths emitted in each set. If
/// `limit` ends the trace, that number depends on the photons, and flux over it is biased by about
/// a chunk's part of the map (ADR 16). A photon keeps the index of its set, of at most 256. The
/// sets' photons_per_pass are equal.
struct PhotonMapTrace {
  PhotonTrace trace;
  int64_t paths_of_set = 0;
};
PhotonMapTrace trace_map(const Scene& scene, const OwnedRoutes& owned,
                         std::span<const PhotonTraceSettings> sets, int64_t limit);

/// Light paths in a chunk; batches of a pass are whole chunks.
inline constexpr int64_t kPhotonChunk = 1024;

}  // namespace nephroid
