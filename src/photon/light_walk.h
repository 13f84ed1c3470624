// What walks from the lights have in common: how one sets out, and a visitor that knows what its
// routes can use and passes by all else. Who calls it: whatever traces paths from the lights.
// It must not know what walks leave behind, films or what cameras see.
#pragma once

#include "photon/emission.h"
#include "transport/camera_path.h"
#include "transport/walk_symbols.h"

namespace nephroid {

/// Stratified dimensions of a light path that has a point of its own: points are made for each, so
/// later vertices are random.
inline constexpr int kLightPathPointDimensions = 48;

/// Random numbers that start_light_path() uses, from dimension 0 on: emit()'s, wavelengths 1 and
/// time 1.
inline constexpr int kLightPathStartDimensions = kEmissionDimensions + 2;

/// The start of a light path whose wavelengths and moment are its own.
struct LightPathStart {
  SampledWavelengths lambda;
  float u_time = 0;  ///< of the moment, as cameras take it
  Emission emission;
};

/// Starts a light path at any of the lights. Empty as emit() is.
inline std::optional<LightPathStart> start_light_path(const Scene& scene, PathSampler& sampler) {
  sampler.start_dimension(kEmissionDimensions);
  const SampledWavelengths lambda =
      SampledWavelengths::sample_visible(wavelength_number(scene, sampler.get_1d()));
  const float u_time = sampler.get_1d();
  sampler.start_dimension(0);
  const auto emission = emit(scene, kUnguided, lambda, scene.camera->motion_time(u_time), sampler);
  if (!emission) return std::nullopt;
  return LightPathStart{lambda, u_time, *emission};
}

/// The walk of an emitted light path. Its vertices take their random numbers from
/// `first_dimension` on; its wavelengths are right each by itself.
inline Walk walk_from(const Emission& emission, const SampledWavelengths& lambda,
                      float specular_alpha, int first_dimension) {
  Walk walk;
  walk.ray = emission.ray;
  walk.medium = emission.medium;
  walk.specular_alpha = specular_alpha;
  walk.per_wavelength = true;
  walk.lambda = lambda;
  walk.first_dimension = first_dimension;
  walk.second_dimension = first_dimension + dimensions::kPerVertex;
  return walk;
}

/// Carries the state of the light side of a group's paths along. A class that is made of it adds
/// `vertex`, and hides what it does otherwise.
class LightWalkVisitor {
 public:
  LightWalkVisitor(const OwnedRoutes& owned, const Emission& emission)
      : routes_(*owned.routes),
        symbols_(*owned.symbols),
        group_(owned.group),
        state_(routes_.emitted(symbols_.light(emission.light))) {}

  void escape(const Walk&) {}
  void emitter(const Walk&, const SurfaceInteraction&, const Light&) {}
  void medium_emission(const Medium&, const SampledSpectrum&) {}
  void medium_vertex(const Walk&, const MediumVertex&, PathSampler&) {}

  /// Classes of events from which a word of the group can go on to the eye.
  ClassMask useful(const WalkVertex& v) const {
    return routes_.useful_from_light(group_, state_, label_at(symbols_, v));
  }
  bool scatters_in(const Medium& medium) const {
    return contains(routes_.useful_from_light(group_, state_, symbols_.medium(medium.index())),
                    EventClass::kVolume);
  }
  bool looks_under_surfaces() const { return false; }

  bool scatter(const Walk&, const WalkEvent& event) {
    state_ = routes_.light_next(state_, symbol_of(symbols_, event));
    return true;
  }

 protected:
  const Routes& routes_;
  const SceneSymbols& symbols_;
  const size_t group_;
  LightState state_;
};

}  // namespace nephroid
