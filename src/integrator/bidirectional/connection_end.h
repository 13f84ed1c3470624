// What a vertex of one side scatters towards the other, event class by event class, with what the
// weight of the connection needs. It must not know films.
#pragma once

#include <array>

#include "integrator/bidirectional/path_pair.h"
#include "transport/direct_light.h"

namespace nephroid {

/// One event of a word.
struct Arm {
  SampledSpectrum f;  ///< the cosine included
  EventDensity density;
  double merge = 0;
  EyeState eye = 0;      ///< behind the event, of eye sides
  LightState light = 0;  ///< behind the event, of light sides
  bool used = false;
};
using Arms = std::array<Arm, std::size(kSurfaceClasses)>;

/// A vertex of the eye side where it may be connected, of either kind.
struct EyeEnd {
  const Walk& walk;
  const WalkVertex* surface = nullptr;
  const MediumVertex* medium = nullptr;
  ClassMask among = ClassMask::kNone;  ///< finite classes of use; of a surface
  Receiver receiver;
  /// Class of the event of arm `i`.
  EventClass class_of(size_t i) const { return medium ? EventClass::kVolume : kSurfaceClasses[i]; }
};

/// What gets along the line between the two, `w` from the eye's to the light's.
inline SampledSpectrum attenuation_between(const Scene& scene, const EyeEnd& z,
                                           const LightVertex& y, const Vec3f& w,
                                           const PathSampler& sampler) {
  return attenuation_between(
      scene, z.surface ? z.surface->surface.spawn_origin(w) : z.medium->p,
      y.in_medium ? y.surface.p : y.surface.spawn_origin(-w), z.walk.ray.time,
      z.surface ? medium_towards(z.surface->surface, w, z.walk.medium) : z.walk.medium,
      z.walk.lambda, sampler);
}

/// The events at a light vertex towards the unit direction `w`; false if there is none.
bool arms_of_light(const Routes& routes, const SceneSymbols& symbols, const LightVertex& y,
                   const Vec3f& w, Arms& arms);

}  // namespace nephroid
