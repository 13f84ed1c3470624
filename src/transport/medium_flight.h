// Flights through a medium: delta tracking with null collisions as weights, and spectral multiple
// importance sampling (docs/estimators.md, [V1] to [V6]). It must not know surfaces, routes or
// films.
// Papers: Miller, Georgiev & Jarosz 2019, Wilkie et al. 2014, pbrt-v4 chapters 11 and 14.
#pragma once

#include <optional>
#include <vector>

#include "core/sampler.h"
#include "scene/medium/medium.h"

namespace nephroid {

/// `u` in [0,1) moved by a distance around a circle of length 1, or mirrored: again in [0,1).
inline float turned(float u, float by) {
  return std::min(u + by - std::floor(u + by), kOneMinusEpsilon);
}
inline float mirrored(float u) {
  return std::min(1.0f - u, kOneMinusEpsilon);
}

/// Random numbers of one flight: the first is stratified, all others come from a hash.
class FlightRandom {
 public:
  FlightRandom() = default;
  FlightRandom(float first, uint64_t seed) : first_(first), state_(seed) {}
  float next() {
    if (first_ >= 0.0f) {
      const float u = first_;
      first_ = -1.0f;
      return u;
    }
    state_ += 0x9e3779b97f4a7c15ull;
    return bits_to_unit_float(static_cast<uint32_t>(mix_bits(state_) >> 32));
  }
  /// Other numbers, for something beside the flight: from a hash, but for the first one, if it is
  /// given. Two forks differ if next() was called between them more than once.
  FlightRandom fork(float first = -1.0f) const { return {first, hash_combine(state_, kFork)}; }

 private:
  static constexpr uint64_t kFork = 0x666f726b;  // "fork"
  float first_ = -1.0f;
  uint64_t state_ = 0;
};

/// Densities of a path's random choices per wavelength, over the density for the hero wavelength
/// with which they were made: r_u and r_l of [V1].
struct SpectralDensity {
  SampledSpectrum u{1.0f};  ///< r_u, the walk itself
  SampledSpectrum l{1.0f};  ///< r_l, with a shadow ray as the last flight
  float u_mean = 1, l_mean = 1;
  bool plain = true;  ///< no choice depended on the wavelength yet: all ones
  void take_means(const SampledWavelengths& lambda) {
    const int left = lambda.left();
    u_mean = left != kAllWavelengths ? u[left] : u.average();
    l_mean = left != kAllWavelengths ? l[left] : l.average();
  }
};

/// Transmittance of a medium from the origin of a ray of unit direction to t_max. It has a closed
/// form if the extinction is uniform; else ratio tracking uses one majorant for all wavelengths.
/// `emitted`, if given, receives the radiance that the piece emits towards the origin.
SampledSpectrum attenuation(const Medium& medium, const Ray& ray, float t_max,
                            const SampledWavelengths& lambda, FlightRandom& random,
                            SampledSpectrum* emitted);

/// A real collision that ended a flight.
struct Collision {
  float t = 0;
  HenyeyGreenstein phase;
};

/// A walk's flight through a medium that may scatter. Updates `throughput` and `density`. `emitted`
/// receives the medium's emission towards the origin, with throughput and spectral weights. Empty
/// if the flight reached t_max. A black throughput ends the walk.
std::optional<Collision> fly(const Medium& medium, const Ray& ray, float t_max,
                             const SampledWavelengths& lambda, FlightRandom& random,
                             SampledSpectrum& throughput, SpectralDensity& density,
                             SampledSpectrum& emitted);

/// [V6] The same for two walks that share their wavelengths and are multiplied, so that no choice
/// may depend on the hero. The throughput is unbiased at each wavelength by itself, without a
/// density. Emission of the medium is not seen.
std::optional<Collision> fly_per_wavelength(const Medium& medium, const Ray& ray, float t_max,
                                            const SampledWavelengths& lambda, FlightRandom& random,
                                            SampledSpectrum& throughput);

/// Transmittance from the origin of a ray of unit direction to each point before `t_max`, unbiased
/// at each wavelength by itself: in closed form if the extinction is uniform, else by one run of
/// ratio tracking, which all points share.
class FlightTransmittance {
 public:
  FlightTransmittance(const Medium& medium, const Ray& ray, float t_max,
                      const SampledWavelengths& lambda, FlightRandom& random);
  SampledSpectrum at(float t) const;

 private:
  struct Step {
    float t;
    SampledSpectrum through;  ///< from here on
  };
  std::optional<SampledSpectrum> uniform_;
  std::vector<Step> steps_;
};

/// The result of a shadow ray: its transmittance and both techniques' densities, over the density
/// with which it was sampled ([V5]).
struct ShadowFlight {
  SampledSpectrum transmittance{1.0f};
  SampledSpectrum u{1.0f};  ///< r_u, a walk along the same way
  SampledSpectrum l{1.0f};  ///< r_l, the shadow ray itself
  bool plain = true;        ///< u and l are ones
};

/// Multiplies `flight` by one more piece of the way.
void cross(const Medium& medium, const Ray& ray, float t_max, const SampledWavelengths& lambda,
           FlightRandom& random, ShadowFlight& flight);

}  // namespace nephroid
