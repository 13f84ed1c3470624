// Density estimation at one visible point: what the photons around it reflect towards the eye
// (docs/estimators.md, [M1] and [M2]; by the nearest photons [N1]). It must not know films, passes
// or how other techniques are weighed against it.
#pragma once

#include <array>

#include "film/part_sums.h"
#include "photon/photon_grid.h"
#include "route/scene_symbols.h"
#include "transport/walk_symbols.h"

namespace nephroid {

/// Photons whose surface is tilted against the visible point's by more than this do not count: they
/// lie on another wall.
inline constexpr float kMergeMinNormalCosine = 0.7f;

/// [E4] What a merge within `radius` adds to the estimate of its bias, over what it adds to the
/// light.
inline float bias_factor(float distance_squared, float radius) {
  return 2 * distance_squared < radius * radius ? -2.0f : 2.0f;
}

/// A point at which a camera walk gathers.
struct MergePoint {
  const WalkVertex& vertex;
  EyeState eye = 0;                      ///< of the eye side, this vertex excluded
  ClassMask classes = ClassMask::kNone;  ///< that have finite lobes here and may merge
  int events = 0;                        ///< of the eye side, this vertex included
  SampledSpectrum throughput;            ///< of the walk up to here
  int left = kAllWavelengths;            ///< or the hero's number, if the walk kept no other
};

/// How a photon arrives at a visible point.
struct PhotonArrival {
  Vec3f wi;  ///< local, on the side on which the photon arrived on its own surface
  float cos_geometric = 0;
};
/// Empty if the photon lies on another wall.
std::optional<PhotonArrival> arrival_at(const WalkVertex& vertex, const Photon& photon);

/// An event of the eye path by which a photon makes a path of the group.
struct MergeEvent {
  Part part = kNoPart;
  EventClass letter = EventClass::kDiffuse;
  Vec3f wi;          ///< local
  BsdfEval bsdf;     ///< never black
  float cosine = 0;  ///< the visible point's over the photon's own: a photon lies on its surface
                     ///< with the density of its own cosine, shading normals weigh it as path
                     ///< tracing would
};

/// The photons at one visible point, one after another.
class PhotonMerger {
 public:
  /// `next(event symbol)`: the eye state behind an event here.
  template <class Next>
  PhotonMerger(const OwnedRoutes& owned, const MergePoint& at, int max_depth, Next&& next)
      : routes_(*owned.routes), group_(owned.group), at_(at), max_depth_(max_depth) {
    const Label label = label_at(*owned.symbols, at.vertex);
    for (const EventClass c : kSurfaceClasses)
      for (const bool transmitted : {false, true})
        states_[static_cast<size_t>(c)][transmitted] = next(event_symbol(c, transmitted, label));
  }

  /// Calls reflects(MergeEvent) for each class in which the photon makes a path of the group that
  /// is not too long. Returns true if there was one.
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
  /// Eye states behind this vertex, by class and side.
  std::array<std::array<EyeState, 2>, std::size(kSurfaceClasses)> states_{};
};

/// Adds throughput * sum of f * flux to the parts that own the photons' paths, to be divided by
/// (N pi r^2); returns how many photons counted. What belongs to other routes or makes the path
/// longer than `max_depth` events is passed over. A path that kept only one wavelength, on
/// either side, adds to that one alone, times the number of wavelengths; two sides that kept
/// different ones make no path. The sums' bias [E4] is
/// divided like the light.
uint32_t merge_photons(const PhotonGrid& grid, const OwnedRoutes& owned, const MergePoint& at,
                       int max_depth, float radius, PartSums& sums);

/// How the nearest photons of a map are read.
struct NearestPhotons {
  size_t wanted = 0;     ///< photons, at least 2
  float max_radius = 0;  ///< world units
  int set = 0;           ///< of the wavelengths of the eye's walk: others only choose the radius
};
/// What was read.
struct NearestMerge {
  uint32_t found = 0;  ///< photons that counted, of all sets
  float radius = 0;    ///< of the estimate, world units
};

/// Adds the estimate [N1] of what the photons of the set reflect to the parts that own their paths,
/// to be divided by the number of paths of the set. `scratch` is overwritten.
NearestMerge merge_nearest(const PhotonGrid& grid, const OwnedRoutes& owned, const MergePoint& at,
                           int max_depth, const NearestPhotons& nearest,
                           std::vector<PhotonGrid::Neighbour>& scratch, PartSums& sums);

}  // namespace nephroid
