// Deterministic counts of what an estimator did, for progress and the report.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "film/lamp_light.h"
#include "film/technique_light.h"

namespace nephroid {

/// Deterministic counts of what an estimator did so far, for progress and report.
struct EstimatorStatistics {
  uint64_t rays = 0;        ///< closest-hit and shadow queries
  uint64_t light_rays = 0;  ///< of these, of paths that all pixels share, where they are told apart
  uint64_t learning_rays = 0;  ///< of these, before the first pass and beside passes, to learn
  /// Of these, what depends on how photons are split into batches: paths retraced for each, and
  /// probes of the discs in which they are merged.
  uint64_t batch_rays = 0;
  uint64_t camera_paths = 0;
  uint64_t photons_merged = 0;  ///< by these, of estimators of pairs of paths
  bool photons_stay = false;    ///< traced once, for all passes
  uint64_t photon_paths = 0;    ///< emitted
  uint64_t photons_stored = 0;
  uint64_t photon_paths_useful = 0;                    ///< paths that stored at least one photon
  uint64_t photon_paths_specular = 0;                  ///< paths that met an S vertex
  uint64_t light_paths = 0;                            ///< emitted to be connected to the camera
  uint64_t light_paths_useful = 0;                     ///< that were, at one vertex at least
  uint64_t splats = 0;                                 ///< connections that expose the film
  float radius_min_pixels = 0, radius_max_pixels = 0;  ///< merge radius over footprint, last pass
  /// Memory, the most that was held at once; the film is not counted. `photon_bytes` is of photons
  /// and of what finds them, `pixel_bytes` of what is kept for each pixel and of what a pass adds
  /// up, `bytes` of both together.
  uint64_t bytes = 0, photon_bytes = 0, pixel_bytes = 0;
  /// Of pairs of paths (`bdpt`, `vcm`, `bpm`, `path+photons`): what each technique found in passes
  /// 0 to 7. Samples count before they are clamped.
  std::vector<RouteTechniques> techniques;
  /// Light by lamp in those passes of 0 to 7 that were counted; of estimators that tell lamps
  /// apart.
  std::vector<LampLight> lamps;
  uint32_t lamp_passes = 0;
  bool tells_lamps = false;        ///< or finds no light at all
  std::vector<std::string> notes;  ///< sentences for the report, e.g. why a route is black

  /// Counts memory that is held at the same time.
  void hold(uint64_t of_photons, uint64_t of_pixels) {
    photon_bytes = std::max(photon_bytes, of_photons);
    pixel_bytes = std::max(pixel_bytes, of_pixels);
    bytes = std::max(bytes, of_photons + of_pixels);
  }
};

}  // namespace nephroid
