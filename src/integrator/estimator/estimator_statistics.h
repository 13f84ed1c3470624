// Deterministic counts of an estimator's work, for progress and the report.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "film/lamp_light.h"
#include "film/technique_light.h"

namespace nephroid {

/// Counts since the first pass. The ray counts below `rays` are parts of it.
struct EstimatorStatistics {
  uint64_t rays = 0;           ///< closest-hit and shadow queries
  uint64_t light_rays = 0;     ///< rays of paths that all pixels share, where counted apart
  uint64_t learning_rays = 0;  ///< rays of learning, before the first pass and beside passes
  /// Rays whose number depends on how photons are split into batches: paths retraced for each
  /// batch, and probes of merge discs.
  uint64_t batch_rays = 0;
  uint64_t camera_paths = 0;
  uint64_t photons_merged = 0;  ///< photons merged with camera paths (estimators of path pairs)
  bool photons_stay = false;    ///< photons are traced once, for all passes
  uint64_t photon_paths = 0;    ///< photon paths emitted
  uint64_t photons_stored = 0;
  uint64_t photon_paths_useful = 0;    ///< paths that stored at least one photon
  uint64_t photon_paths_specular = 0;  ///< paths that met an S vertex
  uint64_t light_paths = 0;            ///< light paths emitted to be connected to the camera
  uint64_t light_paths_useful = 0;     ///< light paths connected to the camera at least once
  uint64_t splats = 0;                 ///< connections to the camera that expose the film
  float radius_min_pixels = 0, radius_max_pixels = 0;  ///< merge radius over footprint, last pass
  /// Peak memory without the film. `photon_bytes` counts photons and the structures that find them,
  /// `pixel_bytes` per-pixel state and the sums of a pass, `bytes` both together.
  uint64_t bytes = 0, photon_bytes = 0, pixel_bytes = 0;
  /// Light found by each technique in passes 0 to 7, by estimators of path pairs (`bdpt`, `vcm`,
  /// `bpm`, `path+photons`), before clamping.
  std::vector<RouteTechniques> techniques;
  /// Light by lamp in the counted passes among 0 to 7, by estimators that tell lamps apart.
  std::vector<LampLight> lamps;
  uint32_t lamp_passes = 0;
  bool tells_lamps = false;        ///< `lamps` is filled, or the estimator finds no light at all
  std::vector<std::string> notes;  ///< sentences for the report, e.g. why a route is black

  /// Updates peak memory with blocks held at the same time.
  void hold(uint64_t of_photons, uint64_t of_pixels) {
    photon_bytes = std::max(photon_bytes, of_photons);
    pixel_bytes = std::max(pixel_bytes, of_pixels);
    bytes = std::max(bytes, of_photons + of_pixels);
  }
};

}  // namespace nephroid
