// How light crosses a medium between two surfaces: collisions sampled against a majorant (delta
// tracking), null collisions kept as weights, and the spectral multiple importance sampling that
// makes a path sampled for one wavelength count for all (Miller, Georgiev & Jarosz 2019; Wilkie et
// al. 2014; pbrt-v4 chapters 11 and 14; docs/estimators.md, [V1] to [V6]). It must not know
// surfaces, routes or films.
#pragma once

#include <optional>

#include "core/sampler.h"
#include "scene/medium/medium.h"

namespace nephroid {

/// Random numbers of one flight: the first is stratified, the others, as many as it takes, come
/// from a hash.
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

 private:
  float first_ = -1.0f;
  uint64_t state_ = 0;
};

/// The random choices of a path so far, as densities per wavelength over the density with which
/// they were made (for the hero wavelength). All ones where no choice depended on the wavelength.
struct SpectralDensity {
  SampledSpectrum u{1.0f};  ///< of the walk itself
  SampledSpectrum l{1.0f};  ///< had the last flight been a shadow ray
  float u_mean = 1, l_mean = 1;
  bool plain = true;  ///< no choice depended on the wavelength yet: all ones
  void take_means(const SampledWavelengths& lambda) {
    const int left = lambda.left();
    u_mean = left != kAllWavelengths ? u[left] : u.average();
    l_mean = left != kAllWavelengths ? l[left] : l.average();
  }
};

/// Share of light that gets through a medium from the origin of a ray of unit direction to t_max,
/// without scattering: in closed form where the extinction is uniform, else an unbiased estimate
/// by ratio tracking with one majorant for all wavelengths. `emitted`, if given, receives the
/// radiance that the piece sends back to the origin.
SampledSpectrum attenuation(const Medium& medium, const Ray& ray, float t_max,
                            const SampledWavelengths& lambda, FlightRandom& random,
                            SampledSpectrum* emitted);

/// Where a flight that may scatter ended.
struct Collision {
  float t = 0;
  HenyeyGreenstein phase;
};

/// A flight of a walk through a medium that may scatter. `throughput` and `density` are brought up
/// to date; `emitted` receives what the medium emits towards the origin on the way, the throughput
/// and the spectral weights included. Empty: the flight reached t_max. A throughput that is black
/// ends the walk.
std::optional<Collision> fly(const Medium& medium, const Ray& ray, float t_max,
                             const SampledWavelengths& lambda, FlightRandom& random,
                             SampledSpectrum& throughput, SpectralDensity& density,
                             SampledSpectrum& emitted);

/// The same for walks whose choices must not depend on which wavelength is the hero, because two of
/// them meet that share their wavelengths: each wavelength's throughput is an unbiased estimate by
/// itself, no density goes with it [V6]. Nothing of what the medium emits is seen.
std::optional<Collision> fly_per_wavelength(const Medium& medium, const Ray& ray, float t_max,
                                            const SampledWavelengths& lambda, FlightRandom& random,
                                            SampledSpectrum& throughput);

/// What a shadow ray finds in a medium: the share that gets through and how likely that is for
/// either technique, relative to the density with which it was sampled.
struct ShadowFlight {
  SampledSpectrum transmittance{1.0f};
  SampledSpectrum u{1.0f};  ///< had a walk gone this way
  SampledSpectrum l{1.0f};  ///< of the shadow ray itself
  bool plain = true;        ///< u and l are ones
};

/// Multiplies one more piece onto `flight`.
void cross(const Medium& medium, const Ray& ray, float t_max, const SampledWavelengths& lambda,
           FlightRandom& random, ShadowFlight& flight);

}  // namespace nephroid
