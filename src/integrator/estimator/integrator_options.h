// The numbers that a user may set of the algorithms, from defaults, the scene's Integrator line and
// -D key=value, in this order.
#pragma once

#include <cstdint>

#include "scene/scene.h"

namespace nephroid {

/// Which techniques of a bidirectional estimator are made: all, or one alone.
struct TechniqueChoice {
  int s = -1, t = -1;    ///< vertices of the light and of the eye side; -1: any number
  bool connects = true;  ///< false: merges alone
  bool weighted = true;  ///< false: each as if there were no other
  bool makes(int light_vertices, int eye_vertices) const {
    return connects && (s < 0 || s == light_vertices) && (t < 0 || t == eye_vertices);
  }
  bool merges() const { return s < 0 && t < 0; }
};

struct IntegratorOptions {
  int max_depth = 100;  ///< scattering events of the whole path, camera and light side together
  /// Pixel footprints of the first merge radius.
  float radius = 0;              ///< 0: the default of the integrator
  int64_t photons_per_pass = 0;  ///< 0: chosen from the film's size
  float alpha = 2.0f / 3.0f;     ///< of [E1] and [E2]
  /// Walks of `path` do not look at what is useful for its routes: the same seed gives the same
  /// paths whatever the routes are.
  bool blind_walks = false;
  bool specular_trees = false;      ///< walks of one way each look for lights both ways
  bool guides_photons = true;       ///< photons start and go where earlier ones were of use
  bool guides_walks = true;         ///< camera walks go where earlier ones found light
  int point_lights = 0;             ///< connections of a pixel and pass; 0: the default
  int camera_samples_per_pass = 0;  ///< 0: the default of the integrator
  TechniqueChoice technique;        ///< of bidirectional estimators
  int hit_points = 0;               ///< of a pixel, in `ppm`; 0: chosen from the scene's samples
  int64_t map_photons = 0;    ///< paths emitted for a photon map; 0: as many as 16 passes have
  int nearest_photons = 100;  ///< of an estimate from a photon map
  int64_t memory_photons =
      1 << 20;  ///< photons kept at once (96 bytes each); a larger pass runs in batches
  // Of Metropolis light transport.
  float mutations = 0;       ///< a pixel and pass; 0: the default
  int64_t chain_length = 0;  ///< mutations of a chain; 0: the default
  float large_step = 0.1f;   ///< probability
};

}  // namespace nephroid
