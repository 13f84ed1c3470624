// Common parts of all light paths: random numbers, emission and walk, the photon stored at a
// vertex, and a visitor that follows the routes of a group. It must not know films or cameras.
#pragma once

#include "photon/emission.h"
#include "photon/photon.h"
#include "transport/camera_path.h"
#include "transport/walk_record.h"
#include "transport/walk_symbols.h"

namespace nephroid {

/// Stratified dimensions of a light path that has its own Sobol' point; later ones are random.
inline constexpr int kLightPathPointDimensions = 48;

/// Random numbers of the start of a path with its own wavelengths and time, from dimension 0 on:
/// emit()'s, wavelengths 1 and time 1.
inline constexpr int kLightPathStartDimensions = kEmissionDimensions + 2;

/// Numbers the light paths of all passes in one sequence. The seed changes when the 32 bits of a
/// Sobol' index are used up.
struct LightPathSequence {
  uint64_t seed = 0;
  int dimensions = kLightPathPointDimensions;  ///< number of stratified dimensions
  /// Sequences of one seed with different variants are independent.
  std::optional<uint64_t> variant{};

  /// Calls f(sampler) with the random numbers of path `number`.
  template <class F>
  void at(uint64_t number, F&& f) const {
    const SobolPoint point(static_cast<uint32_t>(number), dimensions);
    uint64_t own_seed = hash_combine(seed, number >> 32);
    if (variant) own_seed = hash_combine(own_seed, *variant);
    PathSampler sampler(point, own_seed);
    f(sampler);
  }
};

/// Settings that the light paths of a pass share.
struct LightPathLaunch {
  const Scene& scene;
  const EmissionGuide& guide = kUnguided;
  float specular_alpha = 0;
  int max_events = 0;
};

/// The wavelengths and the time of a light path.
struct LightPathMoment {
  SampledWavelengths lambda;
  float u_time = 0;  ///< in [0,1), as cameras take it
};

/// [P6] The wavelengths of a pass, with the hero of light path `number`: a hash, independent of the
/// other paths and of where the path starts.
inline SampledWavelengths with_own_hero(const SampledWavelengths& lambda, uint64_t seed,
                                        uint64_t number) {
  constexpr uint64_t kStream = 0x6865726f6c;  // "herol"
  return lambda.with_hero(static_cast<int>(hash_combine(seed, kStream, number) % kSpectrumSamples));
}

/// Samples wavelengths and time for a path that shares neither with other paths.
inline LightPathMoment sample_moment(const Scene& scene, PathSampler& sampler) {
  sampler.start_dimension(kEmissionDimensions);
  LightPathMoment moment;
  moment.lambda = SampledWavelengths::sample_visible(wavelength_number(scene, sampler.get_1d()));
  moment.u_time = sampler.get_1d();
  sampler.start_dimension(0);
  return moment;
}

/// Emits a light path and walks it; its estimate is right for each wavelength by itself. Emission
/// takes random numbers from the sampler's dimension on, vertices from `first_vertex_dimension` on.
/// make_visitor(emission) makes the visitor of the walk. The visitor's `start(walk, emission,
/// sampler)`, if it has one, is called before the walk, finish(visitor, walk) after it. Neither is
/// called if no light is emitted.
template <class MakeVisitor, class Finish>
void launch_light_path(const LightPathLaunch& launch, const SampledWavelengths& lambda, float time,
                       PathSampler& sampler, int first_vertex_dimension, MakeVisitor&& make_visitor,
                       Finish&& finish) {
  const std::optional<Emission> emission = emit(launch.scene, launch.guide, lambda, time, sampler);
  if (!emission) return;
  Walk walk;
  walk.ray = emission->ray;
  walk.medium = emission->medium;
  walk.specular_alpha = launch.specular_alpha;
  walk.per_wavelength = true;
  walk.lambda = lambda;
  walk.first_dimension = first_vertex_dimension;
  walk.second_dimension = first_vertex_dimension + dimensions::kPerVertex;
  auto visitor = make_visitor(*emission);
  if constexpr (requires { visitor.start(walk, *emission, sampler); })
    visitor.start(walk, *emission, sampler);
  random_walk(launch.scene, TransportMode::kImportance, launch.max_events, walk, sampler, visitor);
  finish(visitor, walk);
}

/// Begins the record of a light path at its start.
inline void begin_record(const Scene& scene, const Emission& emission, LightPathRecord& record) {
  record.light = emission.light;
  record.walk.begin(scene.lights[emission.light]->is_area() ? emission.start.p : emission.ray.o);
}

/// Tracks the light-side state of a group's paths. A derived class adds `vertex` and hides whatever
/// it does differently.
class LightWalkVisitor {
 public:
  LightWalkVisitor(const OwnedRoutes& owned, const Emission& emission)
      : routes_(*owned.routes),
        symbols_(*owned.symbols),
        group_(owned.group),
        lamp_(symbols_.lamp(emission.light)),
        state_(routes_.emitted(symbols_.light(emission.light))) {}

  void escape(const Walk&) {}
  void emitter(const Walk&, const SurfaceInteraction&, const Light&) {}
  void medium_emission(const Medium&, const SampledSpectrum&) {}
  void medium_vertex(const Walk&, const MediumVertex&, PathSampler&) {}

  /// Event classes after which a path of the group can still reach the eye.
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
  /// The photon that a path emitted with `flux` stores at a vertex.
  Photon photon_at(const Walk& walk, const WalkVertex& v, const SampledSpectrum& flux) const {
    Photon photon;
    photon.p = v.surface.p;
    photon.wi = PackedDirection(v.surface.wo);
    photon.ng = PackedDirection(v.surface.ng);
    photon.flux = PackedSpectrum(flux * walk.throughput / v.surface.coverage);
    photon.state = state_;
    photon.left = static_cast<int8_t>(v.left);
    photon.lamp = lamp_;
    photon.events = static_cast<uint16_t>(walk.events);
    return photon;
  }
  /// The same at a collision in a medium.
  Photon photon_at(const Walk& walk, const MediumVertex& v, const SampledSpectrum& flux) const {
    Photon photon;
    photon.p = v.p;
    photon.wi = PackedDirection(v.wo);
    photon.flux = PackedSpectrum(flux * walk.throughput);
    photon.state = state_;
    photon.left = static_cast<int8_t>(walk.lambda.left());
    photon.lamp = lamp_;
    photon.events = static_cast<uint16_t>(walk.events);
    photon.medium = static_cast<int16_t>(v.medium.index());
    return photon;
  }
  /// True if an eye path may have an event of a class in `classes_of(label)` here. At a mix of
  /// materials the eye path may choose another one, so all labels count.
  template <class ClassesOf>
  bool may_be_met(const WalkVertex& v, ClassesOf&& classes_of) const {
    ClassMask any = ClassMask::kNone;
    if (!v.mixed)
      any = classes_of(label_at(symbols_, v));
    else
      for (size_t label = 0; label <= routes_.labels().size(); ++label)
        any = any | classes_of(static_cast<Label>(label));
    return (v.possible & any) != ClassMask::kNone;
  }

  const Routes& routes_;
  const SceneSymbols& symbols_;
  const size_t group_;
  const Lamp lamp_;
  LightState state_;
};

}  // namespace nephroid
