#include "photon/merge.h"

namespace nephroid {

MergeResult merge_photons(const PhotonGrid& grid, const Routes& routes, Route route,
                          const WalkVertex& vertex, EyeState eye, int eye_events, int max_depth,
                          bool eye_terminated, float radius) {
  MergeResult result;
  const SurfaceInteraction& at = vertex.surface;
  grid.query(at.p, radius, [&](const Photon& photon, float) {
    if (photon.events + eye_events > max_depth) return;
    if (routes.meet(eye, photon.state) != route) return;
    if (abs_dot(photon.ng, at.ng) < kMergeMinNormalCosine) return;
    // The side on which the photon arrived on its own surface, the normals brought to agree, tells
    // reflection from transmission: on a curved surface its direction alone may lie below the
    // visible point's tangent plane.
    const float agree = dot(photon.ng, at.ng) < 0.0f ? -1.0f : 1.0f;
    const float arrives = dot(photon.wi, photon.ng) * agree;
    const float cos_geometric = std::abs(arrives);
    if (!(cos_geometric > 0.0f)) return;
    Vec3f wi = vertex.to_local(photon.wi);
    if (wi.z * arrives < 0.0f) wi.z = -wi.z;
    const BsdfEval e = vertex.bsdf.eval(vertex.wo, wi, TransportMode::kRadiance,
                                        EventClass::kDiffuse, ClassMask::kAll);
    if (e.f.is_black()) return;
    ++result.found;
    // A photon lies on its surface with the density of its own cosine; shading normals weigh it as
    // path tracing would.
    const SampledSpectrum f = e.f * photon.flux * (abs_cos_theta(wi) / cos_geometric);
    // A path that lost its secondary wavelengths, on either side or on both, stands for all of them
    // once.
    if (eye_terminated || photon.secondary_terminated)
      result.hero.set(0, result.hero[0] + f[0] * kSpectrumSamples);
    else
      result.reflected += f;
  });
  return result;
}

}  // namespace nephroid
