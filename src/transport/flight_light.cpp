#include "transport/flight_light.h"

#include <cassert>
#include <cmath>

namespace nephroid {

namespace {

/// Distances at which a flight through a uniform medium collides, for a wavelength chosen among
/// those of the flight. Distances beyond t_max are left out.
class CollisionDistances {
 public:
  CollisionDistances(const SampledSpectrum& sigma_t, float t_max, int left)
      : sigma_t_(sigma_t), t_max_(t_max) {
    for (int i = 0; i < kSpectrumSamples; ++i) {
      if (left != kAllWavelengths && i != left) continue;
      // Without collisions an endless flight has no distances.
      if (sigma_t[i] > 0.0f || (t_max < kInfinity && sigma_t[i] == 0.0f)) chosen_[count_++] = i;
    }
  }
  bool empty() const { return count_ == 0 || !(t_max_ > 0.0f); }

  /// Mean optical thickness of the flight.
  float thickness() const {
    float sum = 0;
    for (int k = 0; k < count_; ++k) sum += sigma_t_[chosen_[k]];
    return sum * t_max_ / static_cast<float>(count_);
  }
  float sample(float u, float u_wavelength) const {
    const int k = std::min(static_cast<int>(u_wavelength * static_cast<float>(count_)), count_ - 1);
    const float sigma = sigma_t_[chosen_[k]];
    if (collided(sigma) == 0.0f) return u * t_max_;
    return std::min(-std::log1p(-u * collided(sigma)) / sigma, t_max_);
  }
  float pdf(float t) const {
    float sum = 0;
    for (int k = 0; k < count_; ++k) {
      const float sigma = sigma_t_[chosen_[k]];
      const float of_all = collided(sigma);
      sum += of_all == 0.0f ? 1.0f / t_max_ : sigma * std::exp(-sigma * t) / of_all;
    }
    return sum / static_cast<float>(count_);
  }

 private:
  /// Probability that a flight collides before t_max.
  float collided(float sigma) const { return -std::expm1(-sigma * t_max_); }

  const SampledSpectrum& sigma_t_;
  const float t_max_;
  int chosen_[kSpectrumSamples] = {};  ///< wavelengths that have distances
  int count_ = 0;
};

/// s of [V7], if a bounded light shines on the ray. In thin media bounded lights decide which
/// points are bright, alone if there are no others. Most of a thick flight is too deep to be seen.
float share_near_lights(float thickness, bool bounded_only) {
  const float thin = bounded_only ? 0.5f + 0.4f / (1.0f + 0.25f * sqr(thickness)) : 0.5f;
  return std::max(0.1f, thin / (1.0f + sqr(0.25f * thickness)));
}

/// The place of a light sample.
struct PointAndLight {
  float t = 0;
  LightChoice light;  ///< with its probability in next-event estimation at the point
  float density = 0;  ///< density of the point and the light, 1/length
};

std::optional<PointAndLight> sample_point(const LightSampler& lights, const Ray& ray, float t_max,
                                          const CollisionDistances& collisions,
                                          FlightRandom& random, float u_light) {
  float u = random.next();
  std::optional<LightAlong> near = lights.sample_along(ray, t_max, random.next());
  const float share =
      near ? share_near_lights(collisions.thickness(), lights.infinite_lights().empty()) : 0.0f;
  const Vec3f no_normal(0, 0, 0);
  PointAndLight s;
  if (u < share) {
    if (near->light < 0) return std::nullopt;
    u /= share;
    s.t = near->distances.sample(u);
    s.light = {near->light, lights.pmf(ray.o + ray.d * s.t, no_normal, near->light)};
  } else {
    u = std::min((u - share) / (1.0f - share), kOneMinusEpsilon);
    s.t = collisions.sample(u, random.next());
    const auto choice = lights.sample(ray.o + ray.d * s.t, no_normal, u_light);
    if (!choice) return std::nullopt;
    s.light = *choice;
    if (near && near->light != choice->light) near = lights.find_along(ray, t_max, choice->light);
  }
  s.density = (1.0f - share) * s.light.pdf_p * collisions.pdf(s.t);
  if (near) s.density += share * near->pdf(s.t);
  if (!(s.light.pdf_p > 0.0f) || !(s.density > 0.0f) || !std::isfinite(s.density))
    return std::nullopt;
  return s;
}

/// A point of the flight that scatters light of a light chosen for it.
struct FlightPoint {
  MediumVertex vertex;
  LightChoice light;
  float scale;                 ///< factor by which the light's radiance is multiplied
  SampledSpectrum throughput;  ///< as in FlightLight
  SampledSpectrum collision;   ///< as in FlightLight
};

MediumVertex vertex_at(const Medium& medium, const Walk& walk, float t, HenyeyGreenstein phase) {
  return {medium, walk.ray.o + walk.ray.d * t, -walk.ray.d, phase, walk.ray.time};
}

std::optional<FlightPoint> sample_collision(const Scene& scene, const Medium& medium,
                                            const Walk& walk, float t_max, FlightRandom& random,
                                            float u_light) {
  assert(walk.per_wavelength);
  SampledSpectrum throughput = walk.throughput;
  const std::optional<Collision> collision =
      fly_per_wavelength(medium, walk.ray, t_max, walk.lambda, random, throughput);
  if (!collision) return std::nullopt;
  const MediumVertex vertex = vertex_at(medium, walk, collision->t, collision->phase);
  const auto choice = scene.light_sampler->sample(vertex.p, Vec3f(0, 0, 0), u_light);
  if (!choice) return std::nullopt;
  return FlightPoint{vertex, *choice, 1.0f, throughput, SampledSpectrum(1.0f)};
}

std::optional<FlightPoint> sample_anywhere(const Scene& scene, const Medium& medium,
                                           const Walk& walk, float t_max, FlightRandom& random,
                                           float u_light) {
  const MediumProperties m = medium.at(walk.ray.o, walk.lambda);
  const SampledSpectrum sigma_t = m.sigma_a + m.sigma_s;
  const CollisionDistances collisions(sigma_t, t_max, walk.lambda.left());
  if (collisions.empty()) return std::nullopt;
  const std::optional<PointAndLight> s =
      sample_point(*scene.light_sampler, walk.ray, t_max, collisions, random, u_light);
  if (!s) return std::nullopt;
  const SampledSpectrum through = sigma_t.map([&](float sigma) { return std::exp(-sigma * s->t); });
  return FlightPoint{
      vertex_at(medium, walk, s->t, m.phase), s->light, s->light.pdf_p / s->density,
      walk.throughput * through * m.sigma_s,
      walk.per_wavelength ? SampledSpectrum(1.0f) : walk.density.u * through * sigma_t};
}

}  // namespace

FlightLights sample_flight_light(const Scene& scene, const Medium& medium, const Walk& walk,
                                 float t_max, FlightRandom& random, FlightTechniques techniques,
                                 float u_light, const Vec2f& u) {
  const std::optional<FlightPoint> at =
      samples_light_along(medium, walk.lambda)
          ? sample_anywhere(scene, medium, walk, t_max, random, u_light)
          : sample_collision(scene, medium, walk, t_max, random, u_light);
  FlightLights found;
  if (!at || at->throughput.is_black()) return found;
  const MediumVertex& vertex = at->vertex;
  const Receiver receiver = Receiver::of(vertex, &medium);
  const auto take = [&](std::optional<FlightLight>& place, DirectSample direct, float weight) {
    direct.radiance *= at->scale * weight;
    place.emplace(FlightLight{vertex, direct, at->throughput, at->collision});
  };
  const Light& light = *scene.lights[at->light.light];
  const bool both = techniques == FlightTechniques::kLightAndPhase && light.has_whole_surface();
  if (const auto direct = sample_direct(scene, receiver, at->light, u, walk.lambda)) {
    const float pdf_w = direct->pdf_w / at->light.pdf_p;
    take(found[0], *direct,
         both ? pdf_w / (pdf_w + vertex.phase.eval(vertex.wo, direct->wi_world)) : 1.0f);
  }
  if (!both) return found;
  const PhaseSample phase = vertex.phase.sample(vertex.wo, {random.next(), random.next()});
  if (!(phase.pdf_w > 0.0f)) return found;
  const auto seen = light.seen_along(vertex.p, phase.wi, vertex.time, walk.lambda);
  if (!seen) return found;
  const float pdf_w = at->light.pdf_p * (seen->pdf_w + phase.pdf_w);
  take(found[1], direct_sample(receiver, at->light.light, *seen, pdf_w), 1.0f);
  return found;
}

}  // namespace nephroid
