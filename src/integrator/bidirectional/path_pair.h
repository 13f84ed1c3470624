// One eye path and one light path, and all ways to make whole paths of them: the light of every
// pair of vertices, one on each side, with its weight among all techniques (docs/estimators.md,
// section 13). A technique (s,t) makes a path of s vertices of the light side, its start on the
// light included, and t of the eye side, the lens included. To evaluate a pair: trace_light_path,
// which finds t = 1 on its way, then trace_eye_path with what it left, which finds all others. One
// technique alone: PairSettings::technique. Both are functions of the samplers' numbers alone. It
// must not know passes or films' sums.
#pragma once

#include <memory>
#include <vector>

#include "film/part_sums.h"
#include "integrator/bidirectional/technique_choice.h"
#include "integrator/estimator/estimator.h"
#include "integrator/estimator/features.h"
#include "integrator/learning/radiance_guide.h"
#include "integrator/path/specular_tree.h"
#include "photon/emission_guide.h"
#include "photon/photon_grid.h"
#include "route/scene_symbols.h"
#include "transport/camera_connection.h"
#include "transport/camera_path.h"
#include "transport/casters.h"
#include "transport/path_points.h"
#include "transport/path_weights.h"

namespace nephroid {

/// Photons that eye paths are merged with, in a radius that is a function of the place alone
/// ([W8]), so that every technique agrees on it.
struct PairMerging {
  const PhotonGrid* grid = nullptr;  ///< null while the photons are traced
  double photons = 1;                ///< light paths that they come from
  float radius_pixels = 0;
  PixelFootprint footprint;
  Vec3f eye{0, 0, 0};  ///< where distances count from
  /// Where a small radius stands for a wider one: how many photons that would merge for one.
  float photons_for_one = 1;
  bool connects = true;  ///< false: only lights are connected
  /// Where not all photons are merged, what walks find well is left to them.
  CasterRule rule;

  bool merges_all_light() const { return rule.merges_all_light() && photons > 0; }
  float radius_at(const Vec3f& p) const { return radius_pixels * footprint.width(length(p - eye)); }
  /// `first`: no event between the eye and `p` but delta lobes, so that every photon is a sample of
  /// its own. Else all photons share the way there, which counts once.
  double weight_at(const Vec3f& p, bool first) const {
    if (!(photons > 0)) return 0;
    return heuristic((first ? photons : 1) * photons_for_one * kPi *
                     sqr(static_cast<double>(radius_at(p))));
  }
};

/// What all pairs of a pass share.
struct PairSettings {
  const Scene& scene;
  const OwnedRoutes& owned;
  const CameraView* view = nullptr;  ///< null: light paths are not connected to the camera
  float specular_alpha = 0;          ///< of the pass
  int max_depth = 100;               ///< scattering events of a whole path
  /// Light paths whose vertices are connected to the camera for each camera path that a pixel has:
  /// the number of pixels where each camera path has a light path of its own.
  double light_paths = 1;
  TechniqueChoice technique{};
  const PairMerging* merging = nullptr;     ///< null: connections only
  const EmissionGuide& guide = kUnguided;   ///< of the starts of light paths
  const RadianceGuide* radiance = nullptr;  ///< of the directions of eye paths; null: of none
  bool merges_only = false;  ///< all other techniques have been made, but count in weights
  const SpecularTree* tree = nullptr;  ///< of eye paths, where all techniques are made
  bool has_trees() const {
    return !merges_only && technique.connects && technique.s < 0 && technique.t < 0;
  }

  bool connects() const { return !merging || merging->connects; }
  bool merges_all_light() const { return merging && merging->merges_all_light(); }
};

/// A vertex at which a light path can be connected: all that is needed to evaluate it later.
struct LightVertex {
  bool in_medium = false;
  SurfaceInteraction surface;          ///< in a medium: p and wo only
  const Material* material = nullptr;  ///< null in a medium
  HenyeyGreenstein phase;
  int medium_index = -1;  ///< of a vertex in a medium
  Vec3f wo;               ///< local
  bool merges = true, subsurface_exit = false;
  ClassMask classes = ClassMask::kNone;  ///< finite, and of use to the routes
  SampledSpectrum flux;                  ///< that arrives: divide by nothing, one light path's
  SampledWavelengths lambda;
  float specular_alpha = 0;
  LightState state = 0;  ///< of the light side, this vertex excluded
  Lamp lamp = 0;         ///< where the path started
  int events = 0;        ///< before this vertex
  PartialMisWeights sums;
  double merge = 0;  ///< [W8] of D and G here, seen by way of another finite event

  /// Its BSDF, made anew the first time it is asked for; null in a medium.
  const Bsdf* bsdf() const;

 private:
  friend class LightSubpath;
  mutable BsdfArena arena_;
  mutable const Bsdf* bsdf_ = nullptr;
};

/// The vertices of a light path. Meant to be kept from path to path: memory is reused.
class LightSubpath {
 public:
  size_t size() const { return size_; }
  const LightVertex& operator[](size_t i) const { return *vertices_[i]; }
  void clear() { size_ = 0; }
  /// One more vertex, with the values of the start.
  LightVertex& add();

 private:
  std::vector<std::unique_ptr<LightVertex>> vertices_;
  size_t size_ = 0;
};

/// A light path seen by the camera: `value` counts as radiance times the line's film density and
/// weight are applied, divided by the number of light paths.
struct CameraSplat {
  LensConnection seen;
  Part part = kNoPart;  ///< one that the group owns
  Lamp lamp = 0;
  SampledSpectrum value;
};

/// Work done by a light path.
struct LightPathCounts {
  uint64_t rays = 0;
  bool specular = false;  ///< it had an S event
};

/// Traces a light path from `sampler`'s numbers, leaves its vertices in `path` (cleared first) and
/// adds its connections to the camera to `seen`. `lambda` and `u_time` are those of the eye path.
/// With `photons` the vertices go there instead, for merging. The path's numbers begin at
/// `first_dimension`. Returns the number of rays and whether the path had an S event.
LightPathCounts trace_light_path(const PairSettings& settings, const SampledWavelengths& lambda,
                                 float u_time, PathSampler& sampler, LightSubpath* path,
                                 std::vector<CameraSplat>* seen, std::vector<Photon>* photons,
                                 int first_dimension = 0);

/// What else an eye path is for.
struct EyePathExtras {
  Features* features = nullptr;                    ///< what it sees first goes there
  std::vector<RadianceRecord>* records = nullptr;  ///< what it finds behind its vertices goes there
  SpecularRoot::Leaves leaves = SpecularRoot::Leaves::kBranches;  ///< to trees, if there is one
  /// Where photons come in batches: how many of all of them it merges where it leaves its first
  /// rough vertex by a D ([W12]).
  uint32_t* merged = nullptr;
  bool counts_merged = false;  ///< adds those of a batch there and finds no light
};

/// Work done by an eye path.
struct EyePathCounts {
  uint64_t rays = 0;    ///< but for probes
  uint64_t probes = 0;  ///< rays, of the discs in which photons were merged
  uint64_t merged = 0;  ///< photons within the merge radius
};

/// Runs the eye path that `camera` starts and adds the light of all techniques with t > 1 to
/// `light`, before the camera's weight. Its wavelengths, where not all are kept, are dealt with:
/// the sums are those of the wavelengths that it started with.
EyePathCounts trace_eye_path(const PairSettings& settings, const LightSubpath& path,
                             CameraPath& camera, PathSampler& sampler, PartSums& light,
                             const EyePathExtras& extras = {});

}  // namespace nephroid
