// The start of a light path: light, point, direction and flux (docs/estimators.md, [P1] and [P4]).
// It must not know routes, cameras or films.
#pragma once

#include <optional>

#include "core/sampler.h"
#include "photon/emission_guide.h"

namespace nephroid {

/// Random numbers of emit(), from the sampler's current dimension on: light 1, position 2,
/// direction 2.
inline constexpr int kEmissionDimensions = 5;

struct Emission {
  int light = 0;                   ///< index into Scene::lights
  Ray ray;                         ///< unit direction; the origin is offset from the light
  const Medium* medium = nullptr;  ///< medium around the ray's origin
  SampledSpectrum flux;            ///< flux of one light path: divide by the number emitted
  EmissionSample start;            ///< the light's own sample
  float pdf_start = 0;             ///< density of the light and the start point, 1/area
  float weight = 1;                ///< unguided density of this start over its guided density
};

/// Samples the start of one light path with the guide. Empty if the light emits nothing there.
std::optional<Emission> emit(const Scene& scene, const EmissionGuide& guide,
                             const SampledWavelengths& lambda, float time, PathSampler& sampler);

}  // namespace nephroid
