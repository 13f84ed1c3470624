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
  const WalkVertex& vertex = at.vertex;
  const MergeStates states(owned, at);
  uint32_t found = 0;
  grid.query(vertex.surface.p, radius, [&](const Photon& photon, float) {
    if (photon.events + at.events > max_depth) return;
    const std::optional<PhotonArrival> arrival = arrival_at(vertex, photon);
    if (!arrival) return;
    const Vec3f& wi = arrival->wi;
    const bool transmitted = vertex.transmits(wi);
    bool counts = false;
    for (const EventClass c : kSurfaceClasses) {
      if (!contains(at.classes, c)) continue;
      const Part part =
          owned.routes->meet(states.of[static_cast<size_t>(c)][transmitted], photon.state);
      if (!sums.owns(part)) continue;
      const BsdfEval e =
          vertex.bsdf.eval(vertex.wo, wi, TransportMode::kRadiance, c, ClassMask::kAll);
      if (e.f.is_black()) continue;
      counts = true;
      // A photon lies on its surface with the density of its own cosine; shading normals weigh it
      // as path tracing would.
      const SampledSpectrum f =
          at.throughput * e.f * photon.flux * (abs_cos_theta(wi) / arrival->cos_geometric);
      // A path that lost its secondary wavelengths, on either side or on both, stands for all of
      // them once.
      if (at.secondary_terminated || photon.secondary_terminated) {
        SampledSpectrum hero;
        hero.set(0, f[0] * kSpectrumSamples);
        sums.add(part, hero);
      } else {
        sums.add(part, f);
      }
    }
    found += counts;
  });
  return found;
}

}  // namespace nephroid
