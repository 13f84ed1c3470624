// Where a light path starts: a light, a point and a direction, and what it carries from there
// (docs/estimators.md, [P1] and [P4]). It must not know routes, cameras or films.
#pragma once

#include <optional>

#include "core/sampler.h"
#include "photon/emission_guide.h"

namespace nephroid {

/// Random numbers that emit() uses, from the sampler's current dimension on: light 1, position 2,
/// direction 2.
inline constexpr int kEmissionDimensions = 5;

struct Emission {
  int light = 0;                   ///< index into Scene::lights
  Ray ray;                         ///< of unit direction, off the light already
  const Medium* medium = nullptr;  ///< around the ray's origin
  SampledSpectrum flux;            ///< of one light path: divide by the number emitted
  EmissionSample start;            ///< what the light said
  float pdf_start = 0;             ///< of the light and the start point, 1/area
  float weight = 1;                ///< density of the lights' own start over that of this one
};

/// The start of one light path, as the guide has it. Empty if the light gives nothing here.
std::optional<Emission> emit(const Scene& scene, const EmissionGuide& guide,
                             const SampledWavelengths& lambda, float time, PathSampler& sampler);

}  // namespace nephroid
