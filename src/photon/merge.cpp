#include "photon/merge.h"

namespace nephroid {

namespace {

/// The merger of a point at which the routes of the group merge.
PhotonMerger merger_at(const OwnedRoutes& owned, const MergePoint& at, int max_depth) {
  return PhotonMerger(owned, at, max_depth,
                      [&](EventSymbol event) { return owned.routes->merge(at.eye, event); });
}

/// Adds throughput * f * flux * weight to the parts of the photon's paths, and that times `bias` to
/// their bias. True if the photon counts.
bool add(const PhotonMerger& merger, const MergePoint& at, const Photon& photon, float weight,
         float bias, PartSums& sums, PathRecorder* recorder = nullptr) {
  if (are_apart(at.left, photon.left)) return false;
  return merger.each_event(photon, [&](const MergeEvent& event) {
    const SampledSpectrum value = merged_spectrum(
        at.throughput * (event.bsdf.f * event.cosine) * photon.flux.unpacked() * weight, at.left,
        photon.left);
    sums.add(event.part, value);
    sums.add_merged(value, value * bias);
    if (recorder != nullptr)
      recorder->merge({event.part, Technique::kMerge, value},
                      event_at(at.vertex, event.letter, event.wi), photon);
  });
}

}  // namespace

std::optional<PhotonArrival> arrival_at(const WalkVertex& vertex, const Photon& photon) {
  const Vec3f ng = photon.ng.unpacked();
  if (abs_dot(ng, vertex.surface.ng) < kMergeMinNormalCosine) return std::nullopt;
  // The side of its own surface on which the photon arrived tells reflection from transmission,
  // with both normals oriented alike. Its direction alone may lie below the visible point's tangent
  // plane if the surface is curved.
  const float agree = dot(ng, vertex.surface.ng) < 0.0f ? -1.0f : 1.0f;
  const Vec3f wi = photon.wi.unpacked();
  // Packing moves directions by up to 1e-4, so the cosine of a grazing photon is not known.
  constexpr float kMinCosine = 1e-3f;
  const float arrives = dot(wi, ng) * agree;
  if (!(std::abs(arrives) > kMinCosine)) return std::nullopt;
  PhotonArrival arrival{vertex.to_local(wi), std::abs(arrives)};
  if (arrival.wi.z * arrives < 0.0f) arrival.wi.z = -arrival.wi.z;
  return arrival;
}

uint32_t merge_photons(const PhotonGrid& grid, const OwnedRoutes& owned, const MergePoint& at,
                       int max_depth, float radius, PartSums& sums, PathRecorder* recorder) {
  const PhotonMerger merger = merger_at(owned, at, max_depth);
  uint32_t found = 0;
  grid.query(at.vertex.surface.p, radius, [&](const Photon& photon, float d2) {
    found += add(merger, at, photon, 1.0f, bias_factor(d2, radius), sums, recorder);
  });
  return found;
}

NearestMerge merge_nearest(const PhotonGrid& grid, const OwnedRoutes& owned, const MergePoint& at,
                           int max_depth, const NearestPhotons& nearest,
                           std::vector<PhotonGrid::Neighbour>& scratch, PartSums& sums) {
  const PhotonMerger merger = merger_at(owned, at, max_depth);
  grid.nearest(
      at.vertex.surface.p, nearest.max_radius, nearest.wanted,
      [&](const Photon& photon) {
        return !are_apart(at.left, photon.left) &&
               merger.each_event(photon, [](const MergeEvent&) {});
      },
      scratch);
  NearestMerge result{static_cast<uint32_t>(scratch.size()), nearest.max_radius};
  if (scratch.size() == nearest.wanted) result.radius = std::sqrt(scratch.back().distance_squared);
  if (!(result.radius > 0.0f)) return result;
  // [N1] A cone kernel whose integral over the disk is 1.
  const float top = 3.0f / (kPi * sqr(result.radius));
  for (const PhotonGrid::Neighbour& neighbour : scratch) {
    const Photon& photon = grid.photons()[neighbour.index];
    if (photon.set != nearest.set) continue;
    add(merger, at, photon, top * (1.0f - std::sqrt(neighbour.distance_squared) / result.radius), 0,
        sums);
  }
  return result;
}

}  // namespace nephroid
