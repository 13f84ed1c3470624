#include "photon/merge.h"

#include <array>

#include "transport/walk_symbols.h"

namespace nephroid {

namespace {

/// Eye states behind this vertex, by class and side.
struct MergeStates {
  std::array<std::array<EyeState, 2>, std::size(kSurfaceClasses)> of{};

  MergeStates(const OwnedRoutes& owned, const MergePoint& at) {
    const Label label = label_at(*owned.symbols, at.vertex);
    for (const EventClass c : kSurfaceClasses)
      for (const bool transmitted : {false, true})
        of[static_cast<size_t>(c)][transmitted] =
            owned.routes->merge(at.eye, event_symbol(c, transmitted, label));
  }
};

/// Photons at one visible point.
class Merger {
 public:
  Merger(const OwnedRoutes& owned, const MergePoint& at, int max_depth)
      : owned_(owned), at_(at), max_depth_(max_depth), states_(owned, at) {}

  /// Calls reflects(part, f) for each class in which the photon makes a path of the group, with
  /// what the surface scatters of it, never black, its surface's cosine corrected. Returns true if
  /// there was one.
  template <class F>
  bool each_event(const Photon& photon, F&& reflects) const {
    const WalkVertex& vertex = at_.vertex;
    if (photon.events + at_.events > max_depth_) return false;
    const std::optional<PhotonArrival> arrival = arrival_at(vertex, photon);
    if (!arrival) return false;
    const Vec3f& wi = arrival->wi;
    const bool transmitted = vertex.transmits(wi);
    bool counts = false;
    for (const EventClass c : kSurfaceClasses) {
      if (!contains(at_.classes, c)) continue;
      const Part part =
          owned_.routes->meet(states_.of[static_cast<size_t>(c)][transmitted], photon.state);
      if (!owned_.routes->owns(owned_.group, part)) continue;
      const BsdfEval e =
          vertex.bsdf.eval(vertex.wo, wi, TransportMode::kRadiance, c, ClassMask::kAll);
      if (e.f.is_black()) continue;
      counts = true;
      // A photon lies on its surface with the density of its own cosine; shading normals weigh it
      // as path tracing would.
      reflects(part, e.f * (abs_cos_theta(wi) / arrival->cos_geometric));
    }
    return counts;
  }

  bool counts(const Photon& photon) const {
    return each_event(photon, [](Part, const SampledSpectrum&) {});
  }

  /// Adds throughput * f * flux * weight to the parts of the photon's paths, and that times `bias`
  /// to their bias. True if it counts.
  bool add(const Photon& photon, float weight, float bias, PartSums& sums) const {
    return each_event(photon, [&](Part part, const SampledSpectrum& scattered) {
      // A path that lost its secondary wavelengths, on either side or on both, stands for all of
      // them once.
      const SampledSpectrum value =
          whole_spectrum(at_.throughput * scattered * photon.flux * weight,
                         at_.secondary_terminated || photon.secondary_terminated);
      sums.add(part, value);
      sums.add_bias(value * bias);
    });
  }

 private:
  const OwnedRoutes& owned_;
  const MergePoint& at_;
  const int max_depth_;
  const MergeStates states_;
};

}  // namespace

std::optional<PhotonArrival> arrival_at(const WalkVertex& vertex, const Photon& photon) {
  if (abs_dot(photon.ng, vertex.surface.ng) < kMergeMinNormalCosine) return std::nullopt;
  // The side on which the photon arrived on its own surface, the normals brought to agree, tells
  // reflection from transmission: on a curved surface its direction alone may lie below the visible
  // point's tangent plane.
  const float agree = dot(photon.ng, vertex.surface.ng) < 0.0f ? -1.0f : 1.0f;
  const float arrives = dot(photon.wi, photon.ng) * agree;
  if (!(std::abs(arrives) > 0.0f)) return std::nullopt;
  PhotonArrival arrival{vertex.to_local(photon.wi), std::abs(arrives)};
  if (arrival.wi.z * arrives < 0.0f) arrival.wi.z = -arrival.wi.z;
  return arrival;
}

uint32_t merge_photons(const PhotonGrid& grid, const OwnedRoutes& owned, const MergePoint& at,
                       int max_depth, float radius, PartSums& sums) {
  const Merger merger(owned, at, max_depth);
  uint32_t found = 0;
  grid.query(at.vertex.surface.p, radius, [&](const Photon& photon, float d2) {
    found += merger.add(photon, 1.0f, bias_factor(d2, radius), sums);
  });
  return found;
}

NearestMerge merge_nearest(const PhotonGrid& grid, const OwnedRoutes& owned, const MergePoint& at,
                           int max_depth, const NearestPhotons& nearest,
                           std::vector<PhotonGrid::Neighbour>& scratch, PartSums& sums) {
  const Merger merger(owned, at, max_depth);
  grid.nearest(
      at.vertex.surface.p, nearest.max_radius, nearest.wanted,
      [&](const Photon& photon) { return merger.counts(photon); }, scratch);
  NearestMerge result{static_cast<uint32_t>(scratch.size()), nearest.max_radius};
  if (scratch.size() == nearest.wanted) result.radius = std::sqrt(scratch.back().distance_squared);
  if (!(result.radius > 0.0f)) return result;
  // [N1] the cone, whose integral over the disk is 1.
  const float top = 3.0f / (kPi * sqr(result.radius));
  for (const PhotonGrid::Neighbour& neighbour : scratch) {
    const Photon& photon = grid.photons()[neighbour.index];
    if (photon.set != nearest.set) continue;
    merger.add(photon, top * (1.0f - std::sqrt(neighbour.distance_squared) / result.radius), 0,
               sums);
  }
  return result;
}

}  // namespace nephroid
