// What both photon integrators share: the wavelengths, time and photons of a pass, and the short
// camera walk C S* D@ that merges at every vertex with a D lobe and goes on through S lobes. Who
// calls it: caustic_photons.cpp and sppm.cpp. It must not know how radii shrink.
#pragma once

#include "integrator/estimator.h"
#include "photon/merge.h"
#include "photon/photon_tracer.h"
#include "transport/camera_path.h"

namespace nephroid {

/// What all photons and camera walks of a pass share. Wavelengths and time are stratified over
/// passes.
struct PhotonPass {
  PhotonTraceSettings trace;  ///< with the pass's wavelengths, time and number of photons
  SensorWeights weights;
  PixelFootprint footprint;
  float u_time = 0;  ///< of the camera walks; trace.time is the same moment
  SobolPoint point;  ///< of the camera walks
};
PhotonPass start_photon_pass(const PassKey& key, const Scene& scene, const Film& film,
                             const IntegratorOptions& options);

/// Adds what one batch of photons did to the counts.
void count_photons(const PhotonTrace& trace, EstimatorStatistics& statistics);

/// Says why there is no light from photons, if there is none; `found` is how many were merged.
void explain_darkness(uint64_t found, EstimatorStatistics& statistics);

/// Calls `merge(walk, vertex, eye_state)` at each vertex of the walk with a finite D lobe.
template <class Merge>
class MergeWalkVisitor {
 public:
  MergeWalkVisitor(const Routes& routes, Merge& merge) : routes_(routes), merge_(merge) {}

  ClassMask letters() const { return ClassMask::kSpecular; }
  bool looks_under_surfaces() const { return true; }
  void escape(const Walk&) {}
  void emitter(const Walk&, const SurfaceInteraction&, const Light&) {}
  void medium_emission(const SampledSpectrum&) {}
  void medium_vertex(const Walk&, const MediumVertex&, PathSampler&) {}
  void vertex(const Walk& walk, const WalkVertex& v, PathSampler&) {
    if (v.merges && contains(v.bsdf.finite_classes(), EventClass::kDiffuse))
      merge_(walk, v, routes_.next(state_, EventClass::kDiffuse));
  }
  bool scatter(const Walk&, EventClass letter) {
    state_ = routes_.next(state_, letter);
    return true;
  }

 private:
  const Routes& routes_;
  Merge& merge_;
  EyeState state_ = Routes::kEyeStart;
};

}  // namespace nephroid
