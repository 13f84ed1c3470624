// Direct light that a uniform medium scatters into a flight: found at a point sampled along the
// whole flight, whether or not the walk collides there ([V7] in docs/estimators.md). It must not
// know routes or films.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "transport/direct_light.h"

namespace nephroid {

/// A point on a flight that scatters the light of a light sample towards the flight's origin.
struct FlightLight {
  MediumVertex vertex;
  DirectSample direct;         ///< `radiance` has the point's density and the weight [V9], too
  SampledSpectrum throughput;  ///< the walk's throughput if it scatters at the point
  SampledSpectrum collision;   ///< r_u of a walk that collides at the point, up to a factor
};

/// True if direct light in this medium is sampled along flights.
inline bool samples_light_along(const Medium& medium, const SampledWavelengths& lambda) {
  return medium.uniform_extinction(lambda).has_value();
}

/// Light samples at one point of a flight: of next-event estimation, and of the phase function.
using FlightLights = std::array<std::optional<FlightLight>, 2>;

/// How the light of a point is found.
enum class FlightTechniques : uint8_t {
  kLight,          ///< next-event estimation alone, which needs no weight here
  kLightAndPhase,  ///< also a direction of the phase function; both have weights [V9]
};

/// Samples a point on the walk's next flight, up to `t_max`, which may be infinite, then a light
/// and a point on it. In a medium that varies in space the point is a collision, and the walk must
/// keep its wavelengths apart. `random` chooses the point and the direction of the phase function,
/// `u_light` and `u` the light. Empty where no light can arrive.
FlightLights sample_flight_light(const Scene& scene, const Medium& medium, const Walk& walk,
                                 float t_max, FlightRandom& random, FlightTechniques techniques,
                                 float u_light, const Vec2f& u);

}  // namespace nephroid
