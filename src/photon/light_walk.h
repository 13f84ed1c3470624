// What all paths from the lights have in common: their random numbers, how one sets out and is
// walked, the photon that it leaves at a vertex, and a visitor that knows what its routes can use
// and passes by all else. It must not know films or what cameras see.
#pragma once

#include "photon/emission.h"
#include "photon/photon.h"
#include "transport/camera_path.h"
#include "transport/walk_symbols.h"

namespace nephroid {

/// Stratified dimensions of a light path that has a point of its own: points are made for each, so
/// later vertices are random.
inline constexpr int kLightPathPointDimensions = 48;

/// Random numbers of the start of a path with a moment of its own, from dimension 0 on: emit()'s,
/// wavelengths 1 and time 1.
inline constexpr int kLightPathStartDimensions = kEmissionDimensions + 2;

/// The light paths of all passes as one sequence of numbers. The seed of their random numbers
/// changes when the 32 bits of a Sobol' index are used up.
struct LightPathSequence {
  uint64_t seed = 0;
  int dimensions = kLightPathPointDimensions;  ///< stratified ones
  /// Sequences of one seed that differ in this are independent.
  std::optional<uint64_t> variant{};

  /// Calls f(sampler) with the random numbers of a path.
  template <class F>
  void at(uint64_t number, F&& f) const {
    const SobolPoint point(static_cast<uint32_t>(number), dimensions);
    uint64_t own_seed = hash_combine(seed, number >> 32);
    if (variant) own_seed = hash_combine(own_seed, *variant);
    PathSampler sampler(point, own_seed);
    f(sampler);
  }
};

/// What the light paths of a pass share.
struct LightPathLaunch {
  const Scene& scene;
  const EmissionGuide& guide = kUnguided;
  float specular_alpha = 0;
  int max_events = 0;
};

/// The wavelengths and the moment of a light path.
struct LightPathMoment {
  SampledWavelengths lambda;
  float u_time = 0;  ///< as cameras take it
};

/// The wavelengths of a pass for light path `number`, with a hero that has nothing to do with those
/// of other paths nor with where it starts.
inline SampledWavelengths with_own_hero(const SampledWavelengths& lambda, uint64_t seed,
                                        uint64_t number) {
  constexpr uint64_t kStream = 0x6865726f6c;  // "herol"
  return lambda.with_hero(static_cast<int>(hash_combine(seed, kStream, number) % kSpectrumSamples));
}

/// Draws them for a path that shares neither with any other.
inline LightPathMoment sample_moment(const Scene& scene, PathSampler& sampler) {
  sampler.start_dimension(kEmissionDimensions);
  LightPathMoment moment;
  moment.lambda = SampledWavelengths::sample_visible(wavelength_number(scene, sampler.get_1d()));
  moment.u_time = sampler.get_1d();
  sampler.start_dimension(0);
  return moment;
}

/// Emits a light path and walks it, its wavelengths right each by itself. Numbers of the emission
/// begin at the sampler's dimension, those of vertices at `first_vertex_dimension`.
/// make_visitor(emission) makes what looks at it; if that has `start(walk, emission, sampler)`, it
/// is called before the walk. finish(visitor, walk) is called behind it; not if no light is
/// emitted.
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

/// Carries the state of the light side of a group's paths along. A class that is made of it adds
/// `vertex`, and hides what it does otherwise.
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
  /// The photon that the path leaves at a vertex, of a path that was emitted with `flux`.
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
  /// True if an eye path may meet here a class among `classes_of(label)`. Where a mix chooses among
  /// materials, whoever looks here may see another one.
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
