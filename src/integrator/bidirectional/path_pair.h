// The MIS-weighted light of all techniques (s,t) that combine one eye path and one light path
// (docs/estimators.md, section 13). s counts light vertices with the start on the light, t eye
// vertices with the lens. trace_light_path finds t = 1, then trace_eye_path finds all others. It
// must not know passes or the film's sums.
#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "film/part_sums.h"
#include "integrator/bidirectional/technique_choice.h"
#include "integrator/estimator/estimator.h"
#include "integrator/estimator/features.h"
#include "integrator/learning/radiance_guide.h"
#include "integrator/path/specular_tree.h"
#include "photon/emission_guide.h"
#include "photon/path_recorder.h"
#include "photon/photon_maps.h"
#include "route/scene_symbols.h"
#include "transport/camera_connection.h"
#include "transport/camera_path.h"
#include "transport/casters.h"
#include "transport/path_points.h"
#include "transport/path_weights.h"

namespace nephroid {

/// The photons that eye paths merge. The radius is a function of the place alone ([W8]), so all
/// techniques agree on it.
struct PairMerging {
  const PhotonGrid* grid = nullptr;  ///< null while the photons are traced
  /// Photons that camera paths merge along their flights, until a first event that is no S. Null:
  /// there are none.
  const MediumPhotons* media = nullptr;
  bool gathers_in_media = false;  ///< photons of media are stored, and merged as above
  /// d of [V8]. Nearer photons are merged in discs as wide as there: with the footprint of a pixel
  /// right before the camera, single photons would be bright dots.
  float media_distance = 0;
  double photons = 1;  ///< light paths that left them, N of [W8]
  float radius_pixels = 0;
  PixelFootprint footprint;
  Vec3f eye{0, 0, 0};  ///< origin of distances
  /// In trials with a small radius: photons that the wide radius merges for each one merged here.
  float photons_for_one = 1;
  bool corrects_edges = true;  ///< [W13]
  bool connects = true;        ///< false: eye vertices are connected to lights only
  CasterRule rule;             ///< rule that says which photons are merged

  void merge(const PhotonMaps& maps) {
    grid = &maps.surfaces();
    media = &maps.media();
  }
  void forget_photons() {
    grid = nullptr;
    media = nullptr;
  }
  bool merges_all_light() const { return rule.merges_all_light() && photons > 0; }
  /// True if a path merges only at the first vertex that lets it. There all photons find the rest
  /// of the path. At a later one the eye's part counts once, so it would have next to no weight.
  bool merges_once() const { return rule.holds_in_front() && !connects; }
  float radius_at(const Vec3f& p) const { return radius_pixels * footprint.width(length(p - eye)); }
  /// Radius of the disc of a photon in a medium. It is smaller than on a surface: a flight passes
  /// photons at all distances.
  float radius_in_media_at(const Vec3f& p) const {
    return 0.5f * radius_pixels * footprint.width(std::max(length(p - eye), media_distance));
  }
  /// m of [W8]. `first`: only delta lobes lie between the eye and `p`, so each photon is a sample
  /// of its own. Else all photons share the way there, and it counts once.
  double weight_at(const Vec3f& p, bool first) const {
    if (!(photons > 0)) return 0;
    return heuristic((first ? photons : 1) * photons_for_one * kPi *
                     sqr(static_cast<double>(radius_at(p))));
  }
};

/// Settings shared by all pairs of a pass.
struct PairSettings {
  const Scene& scene;
  const OwnedRoutes& owned;
  const CameraView* view = nullptr;  ///< null: light paths are not connected to the camera
  float specular_alpha = 0;          ///< roughness threshold of the pass
  int max_depth = 100;               ///< scattering events of a whole path
  /// N of [W9]: light paths connected to the camera for each camera path of a pixel. It is the
  /// number of pixels if each camera path has a light path of its own.
  double light_paths = 1;
  TechniqueChoice technique{};
  const PairMerging* merging = nullptr;     ///< null: connections only
  const EmissionGuide& guide = kUnguided;   ///< guide of light path starts
  const RadianceGuide* radiance = nullptr;  ///< guide of eye path directions; null: unguided
  bool merges_only = false;            ///< other techniques are already done; they count in weights
  const SpecularTree* tree = nullptr;  ///< tree grown from eye paths if all techniques are made
  bool has_trees() const {
    return !merges_only && technique.connects && technique.s < 0 && technique.t < 0;
  }

  bool connects() const { return !merging || merging->connects; }
  bool merges_all_light() const { return merging && merging->merges_all_light(); }
  bool merges_direct_light() const { return merging && merging->rule.merges_direct_light(); }
  bool gathers_in_media() const { return merging && merging->gathers_in_media; }
};

/// A vertex of a light path with the data to evaluate connections to it later.
struct LightVertex {
  bool in_medium = false;
  SurfaceInteraction surface;          ///< surface point; in a medium p and wo only
  const Material* material = nullptr;  ///< null in a medium
  HenyeyGreenstein phase;
  int medium_index = -1;  ///< index of the medium; -1 on a surface
  Vec3f wo;               ///< local direction back along the path
  bool merges = true, subsurface_exit = false;
  ClassMask classes = ClassMask::kNone;  ///< finite classes of use to the routes
  SampledSpectrum flux;                  ///< arriving flux of this one light path
  SampledWavelengths lambda;
  float specular_alpha = 0;
  LightState state = 0;  ///< state of the light side before this vertex
  Lamp lamp = 0;         ///< lamp on which the path started
  int events = 0;        ///< events before this vertex
  PartialMisWeights sums;
  double merge = 0;  ///< m of [W8] for D and G here, behind another finite event

  /// The BSDF, made on first use; null in a medium.
  const Bsdf* bsdf() const;

 private:
  friend class LightSubpath;
  mutable BsdfArena arena_;
  mutable const Bsdf* bsdf_ = nullptr;
};

/// The vertices of a light path. Keep the object from path to path: its memory is reused.
class LightSubpath {
 public:
  size_t size() const { return size_; }
  const LightVertex& operator[](size_t i) const { return *vertices_[i]; }
  void clear() { size_ = 0; }
  /// Appends a vertex and resets its flags.
  LightVertex& add();

 private:
  std::vector<std::unique_ptr<LightVertex>> vertices_;
  size_t size_ = 0;
};

/// A connection of a light path to the camera. `value` includes the line's film density and weight;
/// it must still be divided by the number of light paths.
struct CameraSplat {
  LensConnection seen;
  Part part = kNoPart;  ///< a part that the group owns
  Lamp lamp = 0;
  SampledSpectrum value;
};

/// Work done by a light path.
struct LightPathCounts {
  uint64_t rays = 0;
  bool specular = false;  ///< the path had an S event
};

/// Traces a light path with `sampler`'s numbers from `first_dimension` on. Leaves its vertices in
/// `path` (cleared first), adds its connections to the camera to `seen` and its photons to
/// `photons`; each may be null. `lambda` and `u_time` are those of the eye path.
LightPathCounts trace_light_path(const PairSettings& settings, const SampledWavelengths& lambda,
                                 float u_time, PathSampler& sampler, LightSubpath* path,
                                 std::vector<CameraSplat>* seen, std::vector<Photon>* photons,
                                 int first_dimension = 0);

/// The walk of a light path, as trace_light_path() runs it with the same arguments.
LightPathRecord record_light_path(const PairSettings& settings, const SampledWavelengths& lambda,
                                  float u_time, PathSampler& sampler);

/// Optional outputs of an eye path; null: not wanted.
struct EyePathExtras {
  Features* features = nullptr;                    ///< features at the first vertex
  std::vector<RadianceRecord>* records = nullptr;  ///< records of light behind the vertices
  SpecularRoot::Leaves leaves = SpecularRoot::Leaves::kBranches;  ///< light left to specular trees
  /// If photons come in batches: k of [W12], the number of photons of all batches merged at the
  /// first rough vertex, if the path leaves it by a D.
  uint32_t* merged = nullptr;
  bool counts_merged = false;  ///< only adds the photons of a batch to `merged`, finds no light
  /// Receives each path but those of connections, which pair passes alone do not make.
  PathRecorder* recorder = nullptr;
};

/// Work done by an eye path.
struct EyePathCounts {
  uint64_t rays = 0;    ///< rays without probes
  uint64_t probes = 0;  ///< rays that probe merge discs
  uint64_t merged = 0;  ///< photons within the merge radius
};

/// Runs the eye path that `camera` starts and adds the light of all techniques with t > 1 to
/// `light`, before the camera's weight. The sums belong to the wavelengths at the start, even if
/// the path drops some.
EyePathCounts trace_eye_path(const PairSettings& settings, const LightSubpath& path,
                             CameraPath& camera, PathSampler& sampler, PartSums& light,
                             const EyePathExtras& extras = {});

}  // namespace nephroid
