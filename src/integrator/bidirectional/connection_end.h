// BSDF evaluation at the two ends of a connection, per event class, with the terms of its MIS
// weight. It must not know films.
#pragma once

#include <array>

#include "integrator/bidirectional/path_pair.h"
#include "transport/direct_light.h"

namespace nephroid {

/// The event of one class at a connection end.
struct ConnectionEnd {
  SampledSpectrum f;  ///< BSDF or phase function times the cosine
  EventDensity density;
  double merge = 0;      ///< m of [W8]
  EyeState eye = 0;      ///< eye side: state behind the event
  LightState light = 0;  ///< light side: state behind the event
  bool used = false;
};
using ConnectionEnds = std::array<ConnectionEnd, std::size(kSurfaceClasses)>;

/// The eye's end of a connection, on a surface or in a medium.
struct EyeEnd {
  const Walk& walk;
  const WalkVertex* surface = nullptr;
  const MediumVertex* medium = nullptr;
  ClassMask among = ClassMask::kNone;  ///< on a surface: finite classes of use
  Receiver receiver;
  /// Event class of ConnectionEnds[i].
  EventClass class_of(size_t i) const { return medium ? EventClass::kVolume : kSurfaceClasses[i]; }
};

/// Transmittance between the two ends; `w` is the unit direction from the eye's to the light's.
inline SampledSpectrum attenuation_between(const Scene& scene, const EyeEnd& z,
                                           const LightVertex& y, const Vec3f& w,
                                           const PathSampler& sampler) {
  return attenuation_between(
      scene, z.surface ? z.surface->surface.spawn_origin(w) : z.medium->p,
      y.in_medium ? y.surface.p : y.surface.spawn_origin(-w), z.walk.ray.time,
      z.surface ? medium_towards(z.surface->surface, w, z.walk.medium) : z.walk.medium,
      z.walk.lambda, sampler);
}

/// Evaluates the events at a light vertex towards the unit direction `w`. False if there is none.
bool ends_at_light(const Routes& routes, const SceneSymbols& symbols, const LightVertex& y,
                   const Vec3f& w, ConnectionEnds& ends);

}  // namespace nephroid
