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
    ++result.found;
    const Vec3f wi = vertex.to_local(photon.wi);
    const float cos_geometric = abs_dot(photon.wi, at.ng);
    if (!(cos_geometric > 0.0f)) return;
    const BsdfEval e = vertex.bsdf.eval(vertex.wo, wi, TransportMode::kRadiance,
                                        EventClass::kDiffuse, ClassMask::kAll);
    // Photons measure flux through the real surface; shading normals weigh it as path tracing would.
    const SampledSpectrum f = e.f * photon.flux * (abs_cos_theta(wi) / cos_geometric);
    // A path that lost its secondary wavelengths, on either side or on both, stands for all of them once.
    if (eye_terminated || photon.secondary_terminated)
      result.hero.set(0, result.hero[0] + f[0] * kSpectrumSamples);
    else
      result.reflected += f;
  });
  return result;
}

}  // namespace nephroid
