// The interface of every algorithm that turns a pass key into light on the film.
// An estimator has no loop over passes, opens no file and looks at no clock: session/ owns those.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/sampler.h"
#include "film/film.h"
#include "film/technique_light.h"
#include "input/format_rows.h"
#include "route/routes.h"

namespace nephroid {

class Scene;

struct Capabilities {
  bool independent_passes = true;  ///< passes may be rendered anywhere, in any order, and added up
  bool per_pixel_state = false;    ///< keeps more than the film does (E1)
  bool consistent = true;          ///< tends to the truth as passes are added; else an error stays
};

/// Deterministic counts of what an estimator did so far, for progress and report.
struct EstimatorStatistics {
  uint64_t rays = 0;        ///< closest-hit and shadow queries
  uint64_t light_rays = 0;  ///< of these, of paths that all pixels share, where they are told apart
  uint64_t learning_rays = 0;  ///< of these, before the first pass and beside passes, to learn
  uint64_t again_rays = 0;  ///< of these, of camera paths walked again for more batches of photons
  uint64_t camera_paths = 0;
  bool photons_stay = false;  ///< traced once, for all passes
  uint64_t photon_paths = 0;  ///< emitted
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
  std::vector<std::string> notes;  ///< sentences for the report, e.g. why a route is black

  /// Counts memory that is held at the same time.
  void hold(uint64_t of_photons, uint64_t of_pixels) {
    photon_bytes = std::max(photon_bytes, of_photons);
    pixel_bytes = std::max(pixel_bytes, of_pixels);
    bytes = std::max(bytes, of_photons + of_pixels);
  }
};

class Estimator {
 public:
  virtual ~Estimator() = default;
  virtual Capabilities capabilities() const = 0;
  /// True if its passes add what the camera sees first to the film's features.
  virtual bool records_features() const { return false; }
  /// Adds pass `key.pass` to the film. The film's estimate counts are updated by the estimator.
  virtual void render_pass(const PassKey& key, const Scene& scene, Film& film) = 0;
  virtual EstimatorStatistics statistics() const = 0;
  /// Adds what it keeps from pass to pass beside the film, so that it can go on from there; nothing
  /// where passes are independent. What was learned is no state: it is learned again.
  virtual void add_state(const Scene&, const Film&, RenderState&) {}
};

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

/// Algorithm options, from defaults, the scene's Integrator line and -D key=value, in this order.
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

/// Estimators and the film that they fill; estimator i samples the film's group i (one more, if
/// there is one, its features).
struct Preset {
  FilmLayout layout;
  std::vector<std::unique_ptr<Estimator>> estimators;
  std::shared_ptr<const Routes> routes;
  std::vector<std::string> warnings;  ///< about the routes: overlaps, paths that are never found
  std::vector<std::string> notes;     ///< why routes are black that no photon could find
};

/// The routes by which a picture is made.
struct RoutePlan {
  std::vector<RouteDefinition> routes;
  std::vector<AovDefinition> aovs;
  bool strict = false;  ///< overlaps are errors
};

/// Estimators for the routes of a plan in a scene. Throws UsageError for an expression that is
/// wrong, for routes that leave a path out, and for what an estimator cannot do in this scene.
Preset make_preset(const RoutePlan& plan, const IntegratorOptions& options, const Scene& scene);

/// Names of the table: "path", "sppm", "mixed".
std::vector<std::string> integrator_names();
/// The integrator that stands for a pbrt-v4 name ("volpath" -> "path" ...); empty if there is none.
std::string integrator_for_scene_name(const std::string& pbrt_name);
/// All integrators of the format; refused are those for which nothing stands here.
std::vector<FormatType> scene_integrator_types();

/// The plan that an integrator's name stands for. Throws UsageError for an unknown name.
RoutePlan plan_of_integrator(const std::string& name);
/// make_preset of the plan that a name stands for.
Preset make_integrator(const std::string& name, const IntegratorOptions& options,
                       const Scene& scene);

}  // namespace nephroid
