// What both photon integrators share: the wavelengths, time and photons of a pass, and the short camera
// walk C S* D@ that merges at every vertex with a D lobe and goes on through S lobes.
// Who calls it: caustic_photons.cpp and sppm.cpp. It must not know how radii shrink.
#pragma once

#include "integrator/estimator.h"
#include "photon/merge.h"
#include "photon/photon_tracer.h"
#include "transport/camera_path.h"

namespace nephroid {

/// Wavelengths and time that all photons and camera walks of a pass share, stratified over passes.
struct PassSetting {
  SampledWavelengths lambda;
  float time = 0;
};
PassSetting pass_setting(const PassKey& key);

/// Photons of a pass when the user gave no number: it grows with the picture, within bounds.
int64_t default_photons_per_pass(int64_t pixels);

/// Calls `merge(walk, vertex, eye_state)` at each vertex of the walk with a finite D lobe, `light(walk,
/// radiance)` for emission that the walk sees.
template <class Merge, class Emission>
class MergeWalkVisitor {
 public:
  MergeWalkVisitor(const Scene& scene, const Routes& routes, Merge& merge, Emission& emission)
      : scene_(scene), routes_(routes), merge_(merge), emission_(emission) {}

  void escape(const Walk& walk) {
    for (const int i : scene_.light_sampler->infinite_lights())
      emission_(walk, state_,
                scene_.lights[static_cast<size_t>(i)]->radiance_at_infinity(walk.ray.d,
                                                                            walk.lambda));
  }
  void emitter(const Walk& walk, const SurfaceInteraction& hit, const Light& light) {
    emission_(walk, state_, light.radiance(hit.p, hit.ng, hit.uv, hit.wo, walk.lambda));
  }
  ClassMask vertex(const Walk& walk, const WalkVertex& v, PathSampler&) {
    if (contains(v.bsdf.finite_classes(), EventClass::kDiffuse))
      merge_(walk, v, routes_.next(state_, EventClass::kDiffuse));
    return ClassMask::kSpecular;
  }
  bool scatter(const Walk&, const BsdfSample& s) {
    state_ = routes_.next(state_, s.event);
    return true;
  }

 private:
  const Scene& scene_;
  const Routes& routes_;
  Merge& merge_;
  Emission& emission_;
  EyeState state_ = Routes::kEyeStart;
};

}  // namespace nephroid
