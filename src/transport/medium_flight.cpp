#include "transport/medium_flight.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace nephroid {

namespace {

SampledSpectrum exponential(const SampledSpectrum& x) {
  return x.map([](float v) { return std::exp(v); });
}

// exp(-sigma d) where d may be infinite and sigma zero.
SampledSpectrum beer(const SampledSpectrum& sigma, float distance) {
  return sigma.map([&](float s) { return s > 0.0f ? std::exp(-s * distance) : 1.0f; });
}

SampledSpectrum positive_part(const SampledSpectrum& x) {
  return x.map([](float v) { return std::max(v, 0.0f); });
}

SampledSpectrum extinction(const MediumProperties& m) {
  return m.sigma_a + m.sigma_s;
}

// Samples the distances to tentative collisions, majorant by majorant. Optical depth left over at
// the end of a piece is used in the next one.
class Steps {
 public:
  Steps(MajorantIterator pieces, FlightRandom& random) : pieces_(pieces), random_(random) {}

  /// Moves to the next tentative collision, exponentially distributed with rate(sigma_maj). Calls
  /// `passed(sigma_maj, length)` for every piece of the way. False: the end was reached.
  template <class Rate, class Passed>
  bool next(Rate&& rate, Passed&& passed) {
    if (++collisions_ > kMaxCollisions) return false;
    float depth = -std::log(1.0f - random_.next());
    for (;;) {
      if (!piece_) {
        piece_ = pieces_.next();
        if (!piece_) return false;
        t_ = piece_->t_min;
      }
      const float r = rate(piece_->sigma_maj);
      const float rest = piece_->t_max - t_;
      if (r > 0.0f && depth < r * rest) {
        const float step = depth / r;
        passed(piece_->sigma_maj, step);
        t_ += step;
        return true;
      }
      passed(piece_->sigma_maj, rest);
      if (r > 0.0f) depth -= r * rest;
      piece_.reset();
    }
  }
  float t() const { return t_; }
  /// True if the flight was given up; its transmittance is then 0.
  bool given_up() const { return collisions_ > kMaxCollisions; }
  const SampledSpectrum& majorant() const { return piece_->sigma_maj; }

 private:
  MajorantIterator pieces_;
  FlightRandom& random_;
  std::optional<MajorantSegment> piece_;
  float t_ = 0;
  /// A bound for absurdly dense media.
  static constexpr int kMaxCollisions = 1 << 20;
  int collisions_ = 0;
};

// Russian roulette on rays that carry little. False if the ray ends.
bool survives(SampledSpectrum& through, float carried, FlightRandom& random) {
  constexpr float kThin = 0.05f, kSurvive = 0.25f;
  if (!(carried > 0.0f) || !through.is_finite()) return false;
  if (carried >= kThin) return true;
  if (random.next() >= kSurvive) return false;
  through /= kSurvive;
  return true;
}

/// Radiance that `distance` of a uniform medium emits along a ray; the distance may be infinite.
SampledSpectrum uniform_emission(const MediumProperties& m, float distance) {
  const SampledSpectrum sigma_t = extinction(m);
  SampledSpectrum emitted;
  for (int i = 0; i < kSpectrumSamples; ++i)
    if (sigma_t[i] > 0.0f)
      emitted.set(i, m.le[i] * (m.sigma_a[i] / sigma_t[i]) * -std::expm1(-sigma_t[i] * distance));
  return emitted;
}

/// Factor of the majorants with which emission along a ray is looked up about eight times even if
/// the medium is thin; 1 in dense media.
float emission_rate(MajorantIterator pieces) {
  constexpr float kLookups = 8.0f, kMost = 1e30f;
  float depth = 0;
  while (const auto piece = pieces.next()) {
    const float sigma = piece->sigma_maj.max_component();
    if (sigma > 0.0f) depth += sigma * (piece->t_max - piece->t_min);
    if (!(depth < kLookups)) return 1.0f;
  }
  return depth > 0.0f ? std::min(kLookups / depth, kMost) : 1.0f;
}

constexpr auto kHero = [](const SampledSpectrum& sigma) { return sigma[0]; };

/// Ratio tracking, with `factor` times the largest majorant of a piece for all wavelengths. Returns
/// the transmittance. Calls `met(t, properties, rate, before, after)` at each tentative collision,
/// with the transmittance on both sides of it, and once more with `after` 0 if it gives up.
template <class Met>
SampledSpectrum track_ratio(const Medium& medium, const Ray& ray, MajorantIterator pieces,
                            float factor, const SampledWavelengths& lambda, FlightRandom& random,
                            Met&& met) {
  const SampledSpectrum none(0.0f);
  SampledSpectrum through(1.0f);
  const auto rate_of = [factor](const SampledSpectrum& sigma) {
    return factor * sigma.max_component();
  };
  Steps steps(pieces, random);
  while (steps.next(rate_of, [](const SampledSpectrum&, float) {})) {
    const MediumProperties m = medium.at(ray.o + ray.d * steps.t(), lambda);
    const float rate = rate_of(steps.majorant());
    const SampledSpectrum before = through;
    through *= positive_part(SampledSpectrum(rate) - extinction(m)) * (1.0f / rate);
    const bool goes_on = survives(through, through.max_component(), random);
    met(steps.t(), m, rate, before, goes_on ? through : none);
    if (!goes_on) return none;
  }
  if (!steps.given_up()) return through;
  met(steps.t(), MediumProperties(), 1.0f, through, none);
  return none;
}

}  // namespace

SampledSpectrum attenuation(const Medium& medium, const Ray& ray, float t_max,
                            const SampledWavelengths& lambda, FlightRandom& random,
                            SampledSpectrum* emitted) {
  if (const auto sigma = medium.uniform_extinction(lambda)) {
    const SampledSpectrum through = beer(*sigma, t_max);
    if (emitted && medium.is_emissive())
      *emitted += uniform_emission(medium.at(ray.o, lambda), t_max);
    return through;
  }
  const MajorantIterator pieces = medium.majorants(ray, t_max, lambda);
  return track_ratio(medium, ray, pieces, emitted ? emission_rate(pieces) : 1.0f, lambda, random,
                     [emitted](float, const MediumProperties& m, float rate,
                               const SampledSpectrum& before, const SampledSpectrum&) {
                       if (emitted) *emitted += before * m.sigma_a * m.le * (1.0f / rate);
                     });
}

std::optional<Collision> fly(const Medium& medium, const Ray& ray, float t_max,
                             const SampledWavelengths& lambda, FlightRandom& random,
                             SampledSpectrum& throughput, SpectralDensity& density,
                             SampledSpectrum& emitted) {
  assert(lambda.hero() == lambda.lambda(0));
  density.plain = false;
  // Dropped wavelengths are cleared: they could overflow and end the walk.
  const auto keep_left = [&] {
    throughput = lambda.of_left(throughput);
    density.u = lambda.of_left(density.u);
    density.l = lambda.of_left(density.l);
  };
  // [V1]: T, relative to the hero, over the way since the last tentative collision.
  SampledSpectrum depth;
  const auto passed = [&](const SampledSpectrum& sigma, float step) {
    for (int i = 0; i < kSpectrumSamples; ++i)
      if (sigma[i] > 0.0f) depth.set(i, depth[i] + sigma[i] * step);
  };
  const auto relative = [&] {
    const SampledSpectrum t = exponential(SampledSpectrum(depth[0]) - depth);
    depth = SampledSpectrum(0.0f);
    return t;
  };
  const bool uniform = medium.uniform_extinction(lambda).has_value();
  if (medium.is_emissive()) {  // [V4]
    SpectralDensity here = density;
    here.take_means(lambda);
    SampledSpectrum glow;
    FlightRandom of_glow = random.fork();
    attenuation(medium, ray, t_max, lambda, of_glow, &glow);
    emitted += throughput * glow / here.u_mean;
  }
  Steps steps(medium.majorants(ray, t_max, lambda), random);
  while (steps.next(kHero, passed)) {
    const MediumProperties m = medium.at(ray.o + ray.d * steps.t(), lambda);
    const SampledSpectrum& majorant = steps.majorant();
    const SampledSpectrum t = relative();
    const SampledSpectrum sigma_t = extinction(m);
    const float p_real = std::min(sigma_t[0] / majorant[0], 1.0f);
    if (uniform || random.next() < p_real) {  // [V2]
      throughput *= t * m.sigma_s / sigma_t[0];
      density.u *= t * sigma_t / sigma_t[0];
      keep_left();
      if (!throughput.is_finite() || !density.u.is_finite()) throughput = SampledSpectrum(0.0f);
      return Collision{steps.t(), m.phase};
    }
    const SampledSpectrum sigma_n = positive_part(majorant - sigma_t);  // [V3]
    throughput *= t * sigma_n / sigma_n[0];
    density.u *= t * sigma_n / sigma_n[0];
    density.l *= t * majorant / sigma_n[0];
    keep_left();
    if (throughput.is_black() || !throughput.is_finite() || !density.u.is_finite()) {
      throughput = SampledSpectrum(0.0f);
      return std::nullopt;
    }
  }
  if (steps.given_up()) {
    throughput = SampledSpectrum(0.0f);
    return std::nullopt;
  }
  // A shadow ray crosses a uniform medium in closed form, others as the walk does.
  if (uniform) density.l *= std::exp(depth[0]);
  const SampledSpectrum t = relative();
  throughput *= t;
  density.u *= t;
  if (!uniform) density.l *= t;
  keep_left();
  if (!throughput.is_finite() || !density.u.is_finite()) throughput = SampledSpectrum(0.0f);
  return std::nullopt;
}

std::optional<Collision> fly_per_wavelength(const Medium& medium, const Ray& ray, float t_max,
                                            const SampledWavelengths& lambda, FlightRandom& random,
                                            SampledSpectrum& throughput) {
  const int left = lambda.left();
  const auto mean = [&](const SampledSpectrum& s) {
    return left != kAllWavelengths ? s[left] : s.average();
  };
  const auto rate_of = [&](const SampledSpectrum& s) {
    return left != kAllWavelengths ? s[left] : s.max_component();
  };
  const auto end = [&] {
    throughput = SampledSpectrum(0.0f);
    return std::nullopt;
  };
  const float at_start = mean(throughput);
  if (!(at_start > 0.0f)) return end();
  Steps steps(medium.majorants(ray, t_max, lambda), random);
  while (steps.next(rate_of, [](const SampledSpectrum&, float) {})) {  // [V6]
    const MediumProperties m = medium.at(ray.o + ray.d * steps.t(), lambda);
    const float rate = rate_of(steps.majorant());
    const SampledSpectrum real = throughput * m.sigma_s * (1.0f / rate);
    const SampledSpectrum null =
        throughput * positive_part(SampledSpectrum(rate) - extinction(m)) * (1.0f / rate);
    const float mean_real = mean(real), both = mean_real + mean(null);
    if (!(both > 0.0f)) return end();
    const float p_real = mean_real / both;
    if (random.next() < p_real) {
      throughput = real / p_real;
      if (!throughput.is_finite()) return end();
      return Collision{steps.t(), m.phase};
    }
    throughput = null / (1.0f - p_real);
    if (!survives(throughput, mean(throughput) / at_start, random)) return end();
  }
  if (steps.given_up()) return end();
  return std::nullopt;
}

FlightTransmittance::FlightTransmittance(const Medium& medium, const Ray& ray, float t_max,
                                         const SampledWavelengths& lambda, FlightRandom& random)
    : uniform_(medium.uniform_extinction(lambda)) {
  if (uniform_) return;
  track_ratio(medium, ray, medium.majorants(ray, t_max, lambda), 1.0f, lambda, random,
              [this](float t, const MediumProperties&, float, const SampledSpectrum&,
                     const SampledSpectrum& after) {
                steps_.push_back({t, after});
              });
}

SampledSpectrum FlightTransmittance::at(float t) const {
  if (uniform_) return beer(*uniform_, t);
  const auto after = std::partition_point(steps_.begin(), steps_.end(),
                                          [t](const Step& step) { return step.t <= t; });
  return after == steps_.begin() ? SampledSpectrum(1.0f) : std::prev(after)->through;
}

void cross(const Medium& medium, const Ray& ray, float t_max, const SampledWavelengths& lambda,
           FlightRandom& random, ShadowFlight& flight) {
  if (medium.is_purely_absorbing()) {
    flight.transmittance *= attenuation(medium, ray, t_max, lambda, random, nullptr);
    return;
  }
  flight.plain = false;
  if (const auto sigma = medium.uniform_extinction(lambda)) {
    const SampledSpectrum t = beer(*sigma, t_max);
    flight.transmittance *= t;
    flight.u *= t;
    return;
  }
  SampledSpectrum depth;
  const auto passed = [&](const SampledSpectrum& sigma, float step) {
    for (int i = 0; i < kSpectrumSamples; ++i)
      if (sigma[i] > 0.0f) depth.set(i, depth[i] + sigma[i] * step);
  };
  const auto multiply = [&](const SampledSpectrum& null_share, const SampledSpectrum& rate) {
    const SampledSpectrum t = exponential(SampledSpectrum(depth[0]) - depth);
    depth = SampledSpectrum(0.0f);
    flight.transmittance *= t * null_share;
    flight.u *= t * null_share;
    flight.l *= t * rate;
  };
  Steps steps(medium.majorants(ray, t_max, lambda), random);
  while (steps.next(kHero, passed)) {  // [V5]
    const MediumProperties m = medium.at(ray.o + ray.d * steps.t(), lambda);
    const SampledSpectrum majorant = steps.majorant();
    multiply(positive_part(majorant - extinction(m)) / majorant[0], majorant / majorant[0]);
    const float carried = flight.transmittance.max_component() / flight.l.average();
    if (!survives(flight.transmittance, carried, random)) {
      flight.transmittance = SampledSpectrum(0.0f);
      return;
    }
  }
  if (steps.given_up()) {
    flight.transmittance = SampledSpectrum(0.0f);
    return;
  }
  multiply(SampledSpectrum(1.0f), SampledSpectrum(1.0f));
}

}  // namespace nephroid
