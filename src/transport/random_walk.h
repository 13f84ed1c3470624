// The random walk through a scene, from the camera or from a light. It finds surfaces, makes BSDFs,
// crosses media, handles straight-through events, plays Russian roulette and samples directions. A
// visitor uses its vertices. It must not know routes or films.
#pragma once

#include <cassert>

#include "transport/flight_light.h"
#include "transport/subsurface_walk.h"
#include "transport/walk.h"

namespace nephroid {

/// Runs the walk until it escapes, ends or has `max_events` events. The visitor has
///   ClassMask useful(const WalkVertex&)     letters that its path may have here; called once per
///                                           vertex, for WalkVertex::letters
///   bool scatters_in(const Medium&)         true if its path may have a V here
///   bool looks_under_surfaces()             true to follow subsurface light to its exit even if D
///                                           is not among the letters
///   void escape(const Walk&)                the ray left the scene
///   void emitter(const Walk&, const SurfaceInteraction&, const Light&)  the walk hit a light
///   void medium_emission(const Medium&, const SampledSpectrum&)  emission of a medium, fully
///                                           weighed, at the walk's first wavelengths
///   void vertex(const Walk&, const WalkVertex&, PathSampler&)           a surface
///   void medium_vertex(const Walk&, const MediumVertex&, PathSampler&)  a collision in a medium
///   bool scatter(const Walk&, const WalkEvent&)  an event was sampled; false: stop
/// and may have
///   std::optional<BsdfSample> sample_direction(Walk&, const WalkVertex&, float uc,
///       const Vec2f& u, ClassMask among)    replaces Bsdf::sample. If its pdf_w is not the density
///                                           it samples with, it divides the throughput by the
///                                           ratio; eta_scale hides that from roulette
///   bool branches(const Walk&)              true to follow both ways of a smooth boundary
///   void branch(const Walk&, const WalkEvent&, PathSampler&)  called for both, before the walk
///                                           goes on with one of them; not on curves
///   static constexpr bool kEndsAtBranches   true: the walk itself ends there
///   float survival(const WalkVertex&)       survival probability here, asked before `vertex`;
///                                           1: no roulette
///   bool looks_along(const Medium&)         true if its path may end in a light behind a V here.
///                                           Then light_along() takes the place of next-event
///                                           estimation where medium_vertex() is lit_along
///   bool gathers_in(const Medium&)          true if the visitor gathers photons along the flight,
///                                           which does not scatter then. Direct light comes to
///                                           light_along(), in any medium
///   void gather_along(const Walk&, const Medium&, float t_max, FlightRandom&)
///   void light_along(const Walk&, const FlightLight&, PathSampler&)
///                                           direct light of a flight. The walk's throughput is
///                                           that at the point, its density that before the flight
/// `mode` is the quantity that the throughput carries. In kImportance it includes the correction
/// for shading normals (Veach 1997, section 5.3).
template <class Visitor>
class RandomWalk {
 public:
  RandomWalk(const Scene& scene, TransportMode mode, int max_events, Walk& walk,
             PathSampler& sampler, Visitor& visitor)
      : scene_(scene),
        mode_(mode),
        max_events_(max_events),
        walk_(walk),
        sampler_(sampler),
        visitor_(visitor) {}

  void run() {
    while (step()) {
    }
  }

 private:
  /// One flight and the vertex at its end. False: the walk is over.
  bool step() {
    // Dropped wavelengths are cleared: media no longer choose by them, and they could overflow.
    if (walk_.per_wavelength) walk_.throughput = walk_.lambda.of_left(walk_.throughput);
    ++walk_.rays;
    const bool found = scene_.intersect(walk_.ray, hit_);
    if (walk_.medium) {
      const std::optional<Collision> collision = cross_medium(found ? hit_.distance : kInfinity);
      if (walk_.throughput.is_black()) return false;
      if (collision) return scatter_in_medium(*collision);
    }
    if (!found) {
      visitor_.escape(walk_);
      return false;
    }
    walk_.length += hit_.distance;
    return meet_surface();
  }

  std::optional<Collision> cross_medium(float distance) {
    const Medium& medium = *walk_.medium;
    // One sequence of random numbers from vertex to vertex, through any number of media.
    if (flight_vertex_ != walk_.vertices) {
      flight_vertex_ = walk_.vertices;
      sampler_.start_dimension(walk_.vertex_dimension() + dimensions::kFlight);
      const uint64_t seed = sampler_.stream_seed();
      const float u = sampler_.get_1d();
      flight_random_ = FlightRandom(u, seed);
      constexpr uint64_t kLights = 0x6c69676874;  // "light"
      light_random_ = FlightRandom(mirrored(u), hash_combine(seed, kLights));
    }
    if constexpr (requires { visitor_.gathers_in(medium); })
      if (walk_.events < max_events_ && visitor_.gathers_in(medium)) {
        if (visitor_.looks_along(medium)) light_along(medium, distance, kLightAndPhase, 4);
        FlightRandom random = flight_random_.fork();
        visitor_.gather_along(walk_, medium, distance, random);
      }
    SampledSpectrum emitted;
    const bool glows = medium.is_emissive() && !walk_.per_wavelength;
    if (medium.is_purely_absorbing() || !visitor_.scatters_in(medium)) {
      const SampledSpectrum through = attenuation(medium, walk_.ray, distance, walk_.lambda,
                                                  flight_random_, glows ? &emitted : nullptr);
      if (glows)
        visitor_.medium_emission(
            medium,
            whole_spectrum(walk_.throughput * emitted / walk_.density.u_mean, walk_.lambda.left()));
      walk_.throughput *= through;
      return std::nullopt;
    }
    if (walk_.events < max_events_ && is_lit_along(medium))
      light_along(medium, distance, kLight, 1);
    if (walk_.per_wavelength)
      return fly_per_wavelength(medium, walk_.ray, distance, walk_.lambda, flight_random_,
                                walk_.throughput);
    const std::optional<Collision> collision =
        fly(medium, walk_.ray, distance, walk_.lambda, flight_random_, walk_.throughput,
            walk_.density, emitted);
    walk_.density.take_means(walk_.lambda);
    if (glows) visitor_.medium_emission(medium, whole_spectrum(emitted, walk_.lambda.left()));
    return collision;
  }

  /// True if the visitor takes direct light along flights through the medium.
  bool is_lit_along(const Medium& medium) {
    if constexpr (requires { visitor_.looks_along(medium); })
      return samples_light_along(medium, walk_.lambda) && visitor_.looks_along(medium);
    return false;
  }

  using enum FlightTechniques;
  /// [V7] Direct light that the medium scatters into the flight, at so many points.
  void light_along(const Medium& medium, float distance, FlightTechniques how, int points) {
    if constexpr (requires { visitor_.looks_along(medium); }) {
      // Mirrored, as the vertex at the end of the flight uses the same numbers.
      const int first = walk_.vertex_dimension() + dimensions::kLight;
      sampler_.start_dimension(first);
      const float u_light = mirrored(sampler_.get_1d());
      const Vec2f u = sampler_.get_2d();
      const float u_point = light_random_.next();
      for (int k = 0; k < points; ++k) {
        const auto n = static_cast<float>(k);
        FlightRandom random = light_random_.fork((n + u_point) / static_cast<float>(points));
        light_random_.next();
        // An additive recurrence spreads the points over all lights (R3 of Roberts 2018).
        const FlightLights lights = sample_flight_light(
            scene_, medium, walk_, distance, random, how, turned(u_light, n * 0.8191725f),
            {turned(mirrored(u.x), n * 0.6710436f), turned(mirrored(u.y), n * 0.5497005f)});
        sampler_.start_dimension(first + k);  // other random numbers for the shadow rays of a point
        for (const std::optional<FlightLight>& light : lights) {
          if (!light) continue;
          Walk there = walk_;
          there.throughput = light->throughput / static_cast<float>(points);
          visitor_.light_along(there, *light, sampler_);
        }
      }
    }
  }

  bool scatter_in_medium(const Collision& collision) {
    if (walk_.events >= max_events_) return false;
    walk_.length += collision.t;
    const MediumVertex vertex{*walk_.medium,  walk_.ray.o + walk_.ray.d * collision.t,
                              -walk_.ray.d,   collision.phase,
                              walk_.ray.time, is_lit_along(*walk_.medium)};
    const int dimension = walk_.vertex_dimension();
    sampler_.start_dimension(dimension + dimensions::kLight);
    visitor_.medium_vertex(walk_, vertex, sampler_);
    sampler_.start_dimension(dimension + dimensions::kBsdf + 1);  // the direction's pair
    const PhaseSample s = vertex.phase.sample(vertex.wo, sampler_.get_2d());
    if (!(s.pdf_w > 0.0f)) return false;
    walk_.delta = false;
    walk_.pdf_w = s.pdf_w;
    walk_.previous_p = vertex.p;
    walk_.previous_ns = Vec3f(0, 0, 0);
    walk_.ray.o = vertex.p;
    walk_.ray.d = s.wi;
    WalkEvent event;
    event.letter = EventClass::kVolume;
    event.medium = walk_.medium->index();
    return end_of_event(event, dimension);
  }

  bool meet_surface() {
    const Material& surface = *scene_.materials[hit_.material];
    const Material* material = surface.resolve(hit_);
    hit_.coverage *= surface.presence(hit_);
    // An area light emits fully, also where a mix shows no surface.
    if (const Light* light = scene_.area_light(hit_)) visitor_.emitter(walk_, hit_, *light);
    if (material->is_interface()) return go_straight_through();
    // A walk without an event left may still go straight through.
    const bool spent = walk_.events >= max_events_;
    if (spent && !material->transmits_straight()) return false;
    if (material->has_bump()) material->bump(hit_);
    arena_.clear();
    const int left = walk_.lambda.left();
    const Bsdf* bsdf = material->make_bsdf(hit_, walk_.lambda, walk_.specular_alpha, arena_);
    if (!bsdf) return false;
    if (walk_.lambda.secondary_terminated()) walk_.density.take_means(walk_.lambda);
    const bool mergeable = hit_.record->merges_photons;
    WalkVertex vertex{hit_,
                      *material,
                      *bsdf,
                      hit_.shading.to_local(hit_.wo),
                      mergeable ? surface.merging_classes() : ClassMask::kNone,
                      material != &surface,
                      mergeable && material->merges_photons()};
    vertex.left = left;
    return scatter_at_surface(vertex, spent);
  }

  bool scatter_at_surface(WalkVertex vertex, bool spent) {
    const Material& material = vertex.material;
    const int dimension = walk_.vertex_dimension();
    sampler_.start_dimension(dimension + dimensions::kLight);
    if (!spent) {
      if (!survives(vertex)) return false;
      vertex.letters = visitor_.useful(vertex);
      visitor_.vertex(walk_, vertex, sampler_);
    }
    const ClassMask among = vertex.useful_classes();
    const bool looks_under = !spent && !vertex.subsurface_exit && material.has_bssrdf() &&
                             visitor_.looks_under_surfaces();
    if (among == ClassMask::kNone && !looks_under && !material.transmits_straight()) return false;
    if constexpr (requires { visitor_.branches(walk_); })
      if (contains(among, EventClass::kSpecular) && visitor_.branches(walk_) && branch(vertex) &&
          Visitor::kEndsAtBranches)
        return false;

    sampler_.start_dimension(dimension + dimensions::kBsdf);
    const float uc = sampler_.get_1d();
    const Vec2f u = sampler_.get_2d();
    const std::optional<BsdfSample> s =
        sample_direction(vertex, uc, u, looks_under ? among | ClassMask::kDiffuse : among);
    if (!s || !(s->pdf_w > 0.0f)) return false;
    SampledSpectrum weight = s->f * (abs_cos_theta(s->wi) / s->pdf_w);
    if (s->straight_through) {
      ++walk_.vertices;
      walk_.throughput *= weight;
      return !walk_.throughput.is_black() && go_straight_through();
    }
    const Vec3f wi = hit_.shading.to_world(s->wi);
    if (mode_ == TransportMode::kImportance) {
      const float in =
          vertex.subsurface_exit ? 1.0f : abs_cos_theta(vertex.wo) / abs_dot(hit_.wo, hit_.ng);
      const float out = s->subsurface ? 1.0f : abs_dot(wi, hit_.ng) / abs_cos_theta(s->wi);
      if (!std::isfinite(in * out)) return false;
      weight *= in * out;
    }
    walk_.throughput *= weight;
    if (walk_.throughput.is_black()) return false;
    if (s->subsurface) return come_out_again(material, vertex.merges);
    if (!contains(among, s->event)) return false;
    return end_of_event(leave(walk_, vertex, *s, wi), dimension);
  }

  /// Russian roulette of the visitor, if it has any.
  bool survives(const WalkVertex& vertex) {
    if constexpr (requires { visitor_.survival(vertex); }) {
      const float survival = visitor_.survival(vertex);
      if (survival >= 1.0f) return true;
      constexpr uint64_t kStream = 0x73757276;  // "surv"
      const uint64_t bits = hash_combine(sampler_.stream_seed(), kStream);
      if (!(bits_to_unit_float(static_cast<uint32_t>(bits >> 32)) < survival)) return false;
      walk_.throughput /= survival;
      walk_.eta_scale *= survival;
    }
    return true;
  }

  /// Sends a walk off along a sample with the world direction `wi`.
  WalkEvent leave(Walk& walk, const WalkVertex& vertex, const BsdfSample& s,
                  const Vec3f& wi) const {
    if (s.transmitted && mode_ == TransportMode::kRadiance) walk.eta_scale *= sqr(s.eta);
    walk.delta = s.delta;
    walk.pdf_w = s.pdf_w;
    walk.previous_p = hit_.p;
    walk.previous_ns = hit_.shading.z;
    walk.ray.o = hit_.spawn_origin(wi);
    walk.ray.d = wi;
    walk.medium = medium_towards(hit_, wi, walk.medium);
    WalkEvent event;
    event.letter = vertex.letter(s.event);
    event.transmitted = vertex.subsurface_exit || s.transmitted;
    event.material = vertex.material.index();
    return event;
  }

  /// Gives the visitor both ways of a smooth boundary, each with its full share of the light. False
  /// if there are not two.
  bool branch(const WalkVertex& vertex) {
    assert(mode_ == TransportMode::kRadiance);
    if (vertex.letter(EventClass::kSpecular) != EventClass::kSpecular) return false;
    const auto both = vertex.bsdf.delta_pair(vertex.wo, mode_);
    if (!both) return false;
    for (const BsdfSample& s : *both) {
      Walk way = walk_;
      way.rays = 0;
      way.throughput *= s.f * abs_cos_theta(s.wi);
      const WalkEvent event = leave(way, vertex, s, hit_.shading.to_world(s.wi));
      count_event(way);
      visitor_.branch(way, event, sampler_);
    }
    return true;
  }

  /// Samples by the visitor's sample_direction if it has one, else by the BSDF.
  std::optional<BsdfSample> sample_direction(const WalkVertex& vertex, float uc, const Vec2f& u,
                                             ClassMask among) {
    if constexpr (requires { visitor_.sample_direction(walk_, vertex, uc, u, among); })
      return visitor_.sample_direction(walk_, vertex, uc, u, among);
    else
      return vertex.bsdf.sample(vertex.wo, uc, u, mode_, among);
  }

  /// The exit of a subsurface event at another point: a new vertex, but the same event.
  bool come_out_again(const Material& material, bool entry_merges) {
    const Bssrdf* bssrdf = material.make_bssrdf(hit_, walk_.lambda, arena_);
    if (!bssrdf) return false;
    ++walk_.vertices;
    sampler_.start_dimension(walk_.vertex_dimension());
    const float u_axis = sampler_.get_1d();
    const Vec2f u_probe = sampler_.get_2d();
    const float u_choice = sampler_.get_1d();
    const std::optional<SubsurfaceExit> exit =
        find_subsurface_exit(scene_, hit_, material, *bssrdf, u_axis, u_probe, u_choice);
    if (!exit) return false;
    ++walk_.vertices;
    walk_.rays += exit->rays;
    walk_.length += exit->surface.distance;
    walk_.throughput *= exit->weight;
    hit_ = exit->surface;
    walk_.medium = medium_beyond(hit_, hit_.shading.z, walk_.medium);
    const Bsdf* bsdf = bssrdf->exit_bsdf(arena_);
    if (!bsdf) return false;
    // Both sides of a path must see the same letter: H if either end lies on a curve.
    const bool merges = entry_merges && hit_.record->merges_photons;
    return scatter_at_surface(
        {hit_, material, *bsdf, Vec3f(0, 0, 1), ClassMask::kNone, false, merges, true}, false);
  }

  /// Straight-through event: goes on behind the surface.
  bool go_straight_through() {
    if (++walk_.straight_events > kMaxStraightEvents) return false;
    walk_.ray.o = hit_.spawn_origin(walk_.ray.d);
    walk_.medium = medium_towards(hit_, walk_.ray.d, walk_.medium);
    return true;
  }

  static void count_event(Walk& walk) {
    ++walk.events;
    ++walk.vertices;
    walk.ray.t_max = kInfinity;
    if (walk.density.plain) return;
    walk.density.l = walk.density.u;
    walk.density.l_mean = walk.density.u_mean;
  }

  /// Counts the event, asks the visitor and plays roulette on Walk::carried().
  bool end_of_event(const WalkEvent& event, int dimension) {
    count_event(walk_);
    if (!visitor_.scatter(walk_, event)) return false;
    const float carried = walk_.carried();
    if (carried < walk_.roulette_threshold) {
      sampler_.start_dimension(dimension + dimensions::kRoulette);
      const float survival = carried / walk_.roulette_threshold;
      if (!(sampler_.get_1d() < survival)) return false;
      walk_.throughput /= survival;
    }
    return true;
  }

  const Scene& scene_;
  const TransportMode mode_;
  const int max_events_;
  Walk& walk_;
  PathSampler& sampler_;
  Visitor& visitor_;
  SurfaceInteraction hit_;
  BsdfArena arena_;
  FlightRandom flight_random_, light_random_;
  int flight_vertex_ = -1;
};

template <class Visitor>
void random_walk(const Scene& scene, TransportMode mode, int max_events, Walk& walk,
                 PathSampler& sampler, Visitor& visitor) {
  RandomWalk<Visitor>(scene, mode, max_events, walk, sampler, visitor).run();
}

}  // namespace nephroid
