// Density estimation at a visible point: light that nearby photons reflect towards the eye
// (docs/estimators.md, [M1] and [M2]; nearest photons: [N1]). It must not know films, passes or the
// MIS weights of other techniques.
#pragma once

#include <array>

#include "film/part_sums.h"
#include "photon/path_recorder.h"
#include "photon/photon_grid.h"
#include "route/scene_symbols.h"
#include "transport/walk_symbols.h"

namespace nephroid {

/// Least |cosine| between the normals of photon and visible point: below it the photon lies on
/// another wall and does not count.
inline constexpr float kMergeMinNormalCosine = 0.7f;

/// [E4] A photon's term in the bias estimate, over its term in the light.
inline float bias_factor(float distance_squared, float radius) {
  return 2 * distance_squared < radius * radius ? -2.0f : 2.0f;
}

/// A point at which a camera walk gathers.
struct MergePoint {
  const WalkVertex& vertex;
  EyeState eye = 0;                      ///< state of the eye side, this vertex excluded
  ClassMask classes = ClassMask::kNone;  ///< classes with finite lobes here that may merge
  int events = 0;                        ///< events of the eye side, this vertex included
  SampledSpectrum throughput;            ///< throughput of the walk up to here
  int left = kAllWavelengths;  ///< index of the hero, if the walk kept no other wavelength
};

/// The direction from which a photon arrives at a visible point.
struct PhotonArrival {
  Vec3f wi;  ///< local, on the side of the surface on which the photon arrived
  float cos_geometric = 0;
};
/// Empty if the photon lies on another wall.
std::optional<PhotonArrival> arrival_at(const WalkVertex& vertex, const Photon& photon);

/// An event of the eye path that joins a photon to a path of the group.
struct MergeEvent {
  Part part = kNoPart;
  EventClass letter = EventClass::kDiffuse;
  Vec3f wi;          ///< local
  BsdfEval bsdf;     ///< never black
  float cosine = 0;  ///< |w_i·n_s| / |w_i·n_p| of [M1]
};

/// Joins the photons around one visible point to it, one by one.
class PhotonMerger {
 public:
  /// `next(event symbol)` is the eye state after an event here.
  template <class Next>
  PhotonMerger(const OwnedRoutes& owned, const MergePoint& at, int max_depth, Next&& next)
      : routes_(*owned.routes), group_(owned.group), at_(at), max_depth_(max_depth) {
    const Label label = label_at(*owned.symbols, at.vertex);
    for (const EventClass c : kSurfaceClasses)
      for (const bool transmitted : {false, true})
        states_[static_cast<size_t>(c)][transmitted] = next(event_symbol(c, transmitted, label));
  }

  /// Calls reflects(MergeEvent) for each class whose event makes a path of the group that is not
  /// too long. Returns true if there was one.
  template <class Reflects>
  bool each_event(const Photon& photon, Reflects&& reflects) const {
    const WalkVertex& vertex = at_.vertex;
    if (photon.events + at_.events > max_depth_) return false;
    const std::optional<PhotonArrival> arrival = arrival_at(vertex, photon);
    if (!arrival) return false;
    const bool transmitted = vertex.transmits(arrival->wi);
    bool counts = false;
    for (const EventClass c : kSurfaceClasses) {
      if (!contains(at_.classes, c)) continue;
      const Part part = routes_.meet(states_[static_cast<size_t>(c)][transmitted], photon.state);
      if (!routes_.owns(group_, part)) continue;
      const BsdfEval e =
          vertex.bsdf.eval(vertex.wo, arrival->wi, TransportMode::kRadiance, c, ClassMask::kAll);
      if (e.f.is_black()) continue;
      counts = true;
      reflects(
          MergeEvent{part, c, arrival->wi, e, abs_cos_theta(arrival->wi) / arrival->cos_geometric});
    }
    return counts;
  }

 private:
  const Routes& routes_;
  const size_t group_;
  const MergePoint& at_;
  const int max_depth_;
  /// Eye states after this vertex, by class and side.
  std::array<std::array<EyeState, 2>, std::size(kSurfaceClasses)> states_{};
};

/// [M1] Adds throughput * sum of f * flux to the parts that own the photons' paths, to be divided
/// by (N pi r^2). The sums' bias [E4] is divided likewise. Returns the number of photons that
/// count. Paths of other routes and paths longer than `max_depth` events are left out.
/// [M2] A path that kept one wavelength on either side adds to that one alone, times the number of
/// wavelengths. Two sides that kept different ones make no path.
/// The recorder, if there is one, gets each path.
uint32_t merge_photons(const PhotonGrid& grid, const OwnedRoutes& owned, const MergePoint& at,
                       int max_depth, float radius, PartSums& sums,
                       PathRecorder* recorder = nullptr);

/// A query for the nearest photons of a map.
struct NearestPhotons {
  size_t wanted = 0;     ///< number of photons, at least 2
  float max_radius = 0;  ///< world units
  int set = 0;           ///< set of the eye walk's wavelengths; others only choose the radius
};
/// The result of a NearestPhotons query.
struct NearestMerge {
  uint32_t found = 0;  ///< photons that counted, of all sets
  float radius = 0;    ///< radius of the estimate, world units
};

/// Adds the estimate [N1] from the photons of the set to the parts that own their paths, to be
/// divided by the set's number of paths. `scratch` is overwritten.
NearestMerge merge_nearest(const PhotonGrid& grid, const OwnedRoutes& owned, const MergePoint& at,
                           int max_depth, const NearestPhotons& nearest,
                           std::vector<PhotonGrid::Neighbour>& scratch, PartSums& sums);

}  // namespace nephroid
