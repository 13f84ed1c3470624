// The one random walk through a scene, from the camera or from a light. It finds surfaces, makes
// their BSDFs, goes straight through what is not there, plays Russian roulette and samples
// directions; what a vertex is for is the visitor's business. Who calls it: integrators and the
// photon tracer. It must not know routes or films.
#pragma once

#include "core/sampler.h"
#include "scene/scene.h"

namespace nephroid {

/// Where each decision of a path finds its random numbers. Every vertex has the same set, so that
/// its numbers do not depend on what earlier vertices used.
namespace dimensions {
inline constexpr int kFilm = 0;         // 2
inline constexpr int kWavelength = 2;   // 1
inline constexpr int kFirstVertex = 3;  // of camera walks
inline constexpr int kLens = 11;        // 2
inline constexpr int kTime = 13;        // 1
inline constexpr int kSecondVertex = 14;
// within a vertex
inline constexpr int kLight = 0;     // 3
inline constexpr int kBsdf = 3;      // 3
inline constexpr int kRoulette = 6;  // 1
inline constexpr int kPerVertex = 8;
}  // namespace dimensions

/// A walk between two vertices.
struct Walk {
  Ray ray;
  SampledSpectrum throughput{1.0f};
  SampledWavelengths lambda;
  int vertices = 0;     ///< surfaces at which something was decided
  int events = 0;       ///< scattering events so far
  float length = 0;     ///< path length from the start
  float eta_scale = 1;  ///< product of eta^2 over refractions, which roulette leaves out
  // The last scattering event; before the first one the values of the start.
  bool delta = true;  ///< a delta lobe or the camera: no other technique could make this ray
  float pdf_w = 0;    ///< P_c p_c of the direction
  Vec3f previous_p, previous_ns;  ///< vertex that the ray left and its shading normal
  uint64_t rays = 0;              ///< closest-hit queries
  int first_dimension = dimensions::kFirstVertex;    ///< random numbers of the first vertex
  int second_dimension = dimensions::kSecondVertex;  ///< of the second; later ones follow
  int vertex_dimension() const {
    return vertices == 0 ? first_dimension
                         : second_dimension + (vertices - 1) * dimensions::kPerVertex;
  }
  int passages = 0;  ///< straight passages since the start (bounds the walk)
};

/// A surface vertex that a visitor sees.
struct WalkVertex {
  const SurfaceInteraction& surface;
  const Bsdf& bsdf;
  Vec3f wo;  ///< local
  /// Classes that the surface may have here in any of the guises that a `mix` chooses from at
  /// random. What is stored for others to meet depends on this and not on the guise that this walk
  /// happened to see.
  ClassMask possible;

  Vec3f to_local(const Vec3f& w) const { return surface.shading.to_local(w); }
};

/// Runs the walk until it leaves, ends or has `max_events` events. The visitor has
///   void escape(const Walk&)                         the ray left the scene
///   void emitter(const Walk&, const SurfaceInteraction&, const Light&)  it met a light
///   ClassMask vertex(const Walk&, const WalkVertex&, PathSampler&)
///                                  a surface; returns the classes in which to go on (kNone: stop)
///   bool scatter(const Walk&, const BsdfSample&)     an event was sampled; false: stop
/// `mode` tells which quantity the throughput carries. In kImportance it includes the correction
/// for shading normals (Veach 1997, section 5.3).
template <class Visitor>
void random_walk(const Scene& scene, TransportMode mode, int max_events, Walk& walk,
                 PathSampler& sampler, Visitor& visitor) {
  BsdfArena arena;
  SurfaceInteraction hit;
  for (;;) {
    ++walk.rays;
    if (!scene.intersect(walk.ray, hit)) {
      visitor.escape(walk);
      return;
    }
    walk.length += hit.distance;
    const Material& surface = *scene.materials[static_cast<size_t>(hit.material)];
    const Material* material = surface.resolve(hit);
    hit.coverage *= surface.presence(hit);
    if (material->is_interface()) {
      if (++walk.passages > kMaxPassages) return;
      walk.ray.o = hit.spawn_origin(walk.ray.d);
      continue;
    }
    if (const Light* light = scene.area_light(hit)) visitor.emitter(walk, hit, *light);
    // Without an event left, the walk may still go straight through what adds none.
    const bool spent = walk.events >= max_events;
    if (spent && !material->passes_straight()) return;
    if (material->has_bump()) material->bump(hit);
    arena.clear();
    const Bsdf* bsdf = material->make_bsdf(hit, walk.lambda, arena);
    if (!bsdf) return;
    const WalkVertex vertex{hit, *bsdf, hit.shading.to_local(hit.wo), surface.possible_classes()};
    const int dimension = walk.vertex_dimension();
    sampler.start_dimension(dimension + dimensions::kLight);
    const ClassMask among = spent ? ClassMask::kNone : visitor.vertex(walk, vertex, sampler);
    if (among == ClassMask::kNone && !material->passes_straight()) return;

    sampler.start_dimension(dimension + dimensions::kBsdf);
    const float uc = sampler.get_1d();
    const Vec2f u = sampler.get_2d();
    const std::optional<BsdfSample> s = bsdf->sample(vertex.wo, uc, u, mode, among);
    if (!s || !(s->pdf_w > 0.0f)) return;
    const Vec3f wi = hit.shading.to_world(s->wi);
    SampledSpectrum weight = s->f * (abs_cos_theta(s->wi) / s->pdf_w);
    if (s->straight_through) {
      if (++walk.passages > kMaxPassages) return;
      ++walk.vertices;
      walk.throughput *= weight;
      if (walk.throughput.is_black()) return;
      walk.ray.o = hit.spawn_origin(walk.ray.d);
      continue;
    }
    if (among == ClassMask::kNone) return;
    if (mode == TransportMode::kImportance) {
      const float down = abs_dot(hit.wo, hit.ng) * abs_cos_theta(s->wi);
      if (!(down > 0.0f)) return;
      weight *= abs_cos_theta(vertex.wo) * abs_dot(wi, hit.ng) / down;
    }
    walk.throughput *= weight;
    if (walk.throughput.is_black()) return;
    ++walk.events;
    ++walk.vertices;
    if (s->transmitted && mode == TransportMode::kRadiance) walk.eta_scale *= sqr(s->eta);
    walk.delta = s->delta;
    walk.pdf_w = s->pdf_w;
    walk.previous_p = hit.p;
    walk.previous_ns = hit.shading.z;
    if (!visitor.scatter(walk, *s)) return;

    // Roulette on what the walk still carries; the change of radiance inside glass is no loss.
    const float carried = walk.throughput.max_component() * walk.eta_scale;
    if (carried < 1.0f) {
      sampler.start_dimension(dimension + dimensions::kRoulette);
      if (!(sampler.get_1d() < carried)) return;
      walk.throughput /= carried;
    }
    walk.ray.o = hit.spawn_origin(wi);
    walk.ray.d = wi;
    walk.ray.t_max = kInfinity;
  }
}

}  // namespace nephroid
