// Common parts of the photon estimators: wavelengths, time, roughness threshold and photons of a
// pass, and the camera walk to every vertex where its routes may merge photons. It must not know
// how radii shrink.
#pragma once

#include "integrator/estimator/estimator.h"
#include "photon/merge.h"
#include "photon/photon_grid.h"
#include "photon/photon_tracer.h"
#include "transport/camera_path.h"
#include "transport/walk_symbols.h"

namespace nephroid {

/// Numbers in [0,1) for the wavelengths (sample_visible) and the time of a pass. 2^k passes from a
/// multiple of 2^k on are stratified in each of the two and jointly, so a moving object has all its
/// colours everywhere. They have 2^k times the wavelengths of one pass, evenly spaced ([P5] of
/// docs/estimators.md).
Vec2f wavelengths_and_time_of_pass(const PassKey& key);

/// Settings shared by all photons and camera walks of a pass. Wavelengths and time are stratified
/// over passes.
struct PhotonPass {
  PhotonTraceSettings trace;  ///< with the pass's wavelengths, time and number of photons
  SensorWeights weights;
  PixelFootprint footprint;
  float u_time = 0;         ///< time of the camera walks in [0,1); trace.time is the same moment
  uint32_t first_hero = 0;  ///< h of [P6], the hero wavelength of pixel (0, 0)
  SobolPoint point;         ///< Sobol' point of the camera walks
};
PhotonPass start_photon_pass(const PassKey& key, const Scene& scene, const FilmFormat& film,
                             const IntegratorOptions& options, PassControl& control = unwatched);

/// Starts camera walk number `sample` of a pixel, with the wavelengths, time and roughness
/// threshold of the pass. The hero differs between neighbouring pixels ([P6]).
inline CameraPath start_merging_path(const Scene& scene, int x, int y, PathSampler& sampler,
                                     const PhotonPass& pass, int sample = 0) {
  const uint32_t hero = pass.first_hero + x + 3 * y + 5 * sample;
  CameraPath path = start_camera_path(
      scene, x, y, sampler, pass.trace.lambda.with_hero(static_cast<int>(hero % kSpectrumSamples)),
      pass.u_time);
  path.walk.specular_alpha = pass.trace.specular_alpha;
  path.walk.per_wavelength = true;
  return path;
}

/// True if the group may own photons that are possible in the scene.
bool photons_can_count(const OwnedRoutes& owned);

/// True if a photon may be stored at the first surface of its path.
bool deposits_at_once(const OwnedRoutes& owned);

/// The group's routes, as "route 'a'" or "routes 'a', 'b'".
std::string names_of_routes(const OwnedRoutes& owned);

/// True if paths of the scene can have events of this class.
bool has_events(const OwnedRoutes& owned, EventClass letter);

/// Adds the counts of one batch of photons.
void count_photons(const PhotonTrace& trace, EstimatorStatistics& statistics);

/// Calls `merge(walk, merge_point)` at each vertex of the walk where photons may be merged.
template <class Merge>
class MergeWalkVisitor {
 public:
  MergeWalkVisitor(const OwnedRoutes& owned, Merge& merge)
      : routes_(*owned.routes),
        symbols_(*owned.symbols),
        group_(owned.group),
        merge_(merge),
        eye_(routes_.start()) {}

  ClassMask useful(const WalkVertex& v) const {
    return routes_.useful_before_merge(group_, eye_, label_at(symbols_, v));
  }
  bool scatters_in(const Medium& medium) const {
    return contains(routes_.useful_before_merge(group_, eye_, symbols_.medium(medium.index())),
                    EventClass::kVolume);
  }
  bool looks_under_surfaces() const { return true; }
  void escape(const Walk&) {}
  void emitter(const Walk&, const SurfaceInteraction&, const Light&) {}
  void medium_emission(const Medium&, const SampledSpectrum&) {}
  void medium_vertex(const Walk&, const MediumVertex&, PathSampler&) {}
  void vertex(const Walk& walk, const WalkVertex& v, PathSampler&) {
    if (!v.merges) return;
    const ClassMask classes =
        routes_.merges(group_, eye_, label_at(symbols_, v)) & v.bsdf.finite_classes();
    if (classes == ClassMask::kNone) return;
    merge_(walk,
           MergePoint{v, eye_, classes, walk.events + 1, walk.throughput, walk.lambda.left()});
  }
  bool scatter(const Walk&, const WalkEvent& event) {
    eye_ = routes_.next(eye_, symbol_of(symbols_, event));
    return true;
  }

 private:
  const Routes& routes_;
  const SceneSymbols& symbols_;
  const size_t group_;
  Merge& merge_;
  EyeState eye_;
};

}  // namespace nephroid
