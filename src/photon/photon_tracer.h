// Shoots photons from the lights and keeps those that belong to an estimator's routes. Photon
// number j of pass i depends on (seed, i, j) alone; chunks of numbers are traced on any thread and
// joined in the order of their numbers (docs/architecture.md, section 5). It must not know films or
// cameras.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "core/pass_control.h"
#include "photon/photon.h"
#include "photon/photon_guide.h"
#include "route/scene_symbols.h"
#include "transport/random_walk.h"

namespace nephroid {

struct PhotonTrace {
  std::vector<Photon> photons;
  uint64_t paths = 0;           ///< emitted
  uint64_t useful_paths = 0;    ///< that stored at least one photon
  uint64_t specular_paths = 0;  ///< that had an S event
  uint64_t rays = 0;
};

struct PhotonTraceSettings {
  PassKey key;
  int64_t photons_per_pass = 0;  ///< the sequence of a pass starts where the one before ended
  SampledWavelengths lambda;     ///< of the pass
  float time = 0;
  float specular_alpha = 0;  ///< of the pass
  int max_events = 0;        ///< of the whole path: a photon lands with fewer than these
  const PhotonGuide* guide = &kUnguidedPhotons;
  PassControl* control = &unwatched;  ///< asked between chunks of photons
};

/// Traces photons begin <= j < end of the pass and stores one at every surface with a finite lobe
/// of class D or G where its light side may be merged by the group. Flux is that of one photon:
/// divide by the number emitted.
PhotonTrace trace_photons(const Scene& scene, const OwnedRoutes& owned,
                          const PhotonTraceSettings& settings, int64_t begin, int64_t end);

/// What paths of learning found.
struct UsefulStarts {
  std::vector<UsefulStart> starts;
  /// Of those that needed an S behind a rough vertex for it, where they met it, in the place of
  /// `first_hit`.
  std::vector<UsefulStart> casters;
  uint64_t rays = 0;
};
/// Starts of the paths begin <= j < end that left a photon which is of use. `is_useful` is called
/// on any thread.
UsefulStarts trace_useful_starts(const Scene& scene, const OwnedRoutes& owned,
                                 const PhotonTraceSettings& settings, int64_t begin, int64_t end,
                                 const std::function<bool(const Photon&)>& is_useful);

/// Traces from photon `begin` on until the pass ends or `limit` photons are stored, whichever comes
/// first, in groups of whole chunks: a pass whose photons do not fit in memory is traced, gathered
/// and dropped in batches. Moves `begin` to where it stopped, which depends on the scene and the
/// settings alone.
PhotonTrace trace_batch(const Scene& scene, const OwnedRoutes& owned,
                        const PhotonTraceSettings& settings, int64_t limit, int64_t& begin);

/// The photons of a map: path j of each set, for j = 0, 1, ... in all sets alike, until the sets
/// end or `limit` photons are stored. It stops with a whole chunk of each set and keeps all of its
/// photons; `paths_of_set` is the number emitted in each set. If `limit` ends it, the photons
/// choose that number, and flux over it is biased by about a round's part of the map (ADR 16). A
/// photon knows the number of its set; there are at most 256. The sets' photons_per_pass are equal.
struct PhotonMapTrace {
  PhotonTrace trace;
  int64_t paths_of_set = 0;
};
PhotonMapTrace trace_map(const Scene& scene, const OwnedRoutes& owned,
                         std::span<const PhotonTraceSettings> sets, int64_t limit);

/// Photons are traced in chunks of this many; batches of a pass are whole chunks.
inline constexpr int64_t kPhotonChunk = 1024;

}  // namespace nephroid
