// Densities and geometry that both sides of a pair need at their vertices: densities of events,
// factors of lines, and densities of a light's start. It must not know routes.
#pragma once

#include "integrator/bidirectional/eye_weights.h"
#include "integrator/bidirectional/path_pair.h"
#include "photon/merge.h"
#include "transport/direct_light.h"

namespace nephroid {

/// A point of a path; `ng` is null in a medium and for lights at a point.
struct Place {
  Vec3f p{0, 0, 0}, ng{0, 0, 0};
};

/// |cos| of a unit direction with the surface normal; 1 if there is no surface.
inline double cosine_at(const Place& at, const Vec3f& w) {
  return length_squared(at.ng) > 0 ? abs_dot(at.ng, w) : 1.0;
}

inline LineFactors line_between(const Place& a, const Place& b) {
  const Vec3f d = b.p - a.p;
  const double d2 = length_squared(d);
  if (!(d2 > 0)) return {};
  const Vec3f w = d / static_cast<float>(std::sqrt(d2));
  return {cosine_at(a, w) / d2, cosine_at(b, w) / d2};
}

/// Density of an event of class `c` from `wo` to `wi` (local), chosen among all classes.
inline double event_density(const Bsdf& bsdf, const Vec3f& wo, const Vec3f& wi, TransportMode mode,
                            EventClass c) {
  return bsdf.eval(wo, wi, mode, c, ClassMask::kAll).pdf_w;
}
/// Density of a direction at the entry or exit of a way under a surface ([W10]).
inline double subsurface_density(const Vec3f& ng, const Vec3f& w) {
  return abs_dot(ng, w) * kInvPi;
}

/// Densities of the event that a walk has just sampled at a surface, choosing `among` these
/// classes. Without `asks_back`, if sums do not need it, `back` is 0.
inline EventDensity density_of_walk(const Walk& walk, const WalkVertex& v, const WalkEvent& event,
                                    TransportMode mode, ClassMask among, bool asks_back) {
  if (v.subsurface_exit) return {subsurface_density(v.surface.ng, walk.ray.d), 0, true};
  if (walk.delta) return {};
  const Vec3f wi = v.to_local(walk.ray.d);
  // A walk that chose among all classes knows the density.
  const bool knows = (v.bsdf.classes() & among) == v.bsdf.classes();
  EventDensity d{knows ? double{walk.pdf_w} : event_density(v.bsdf, v.wo, wi, mode, event.letter),
                 0, true};
  if (!asks_back) return d;
  const TransportMode other =
      mode == TransportMode::kRadiance ? TransportMode::kImportance : TransportMode::kRadiance;
  d.back = event_density(v.bsdf, wi, v.wo, other, event.letter);
  return d;
}

/// M_1 of [W9]: light paths connected to the camera also find the first vertex of an eye path.
inline double cut_at_camera(const PairSettings& settings, const CameraPath& camera,
                            const Place& first) {
  if (!settings.view || !settings.connects()) return 0;
  const auto line = settings.scene.camera->connect(first.p, camera.u_lens, camera.u_time);
  if (!line) return 0;
  const double density = line->film_density * cosine_at(first, line->wi);
  return density > 0 ? heuristic(settings.light_paths / density) : 0;
}

/// The probability of choosing a light at `p` that weights use. It is not the real one where
/// photons that come straight from a light are merged: their weights take it at the photon, those
/// of next-event estimation at the vertex beside it, so it must have no jumps.
inline double choice_in_weights(const PairSettings& settings, const Vec3f& p, const Vec3f& ns,
                                int light) {
  const LightSampler& lights = *settings.scene.light_sampler;
  return settings.merges_direct_light() ? lights.plain_pmf(p, ns, light) : lights.pmf(p, ns, light);
}
/// That probability over the real one.
inline double choice_over_real(const PairSettings& settings, const Vec3f& p, const Vec3f& ns,
                               int light) {
  if (!settings.merges_direct_light()) return 1;
  const double real = settings.scene.light_sampler->pmf(p, ns, light);
  return real > 0 ? choice_in_weights(settings, p, ns, light) / real : 1;
}

/// Densities with which light number `light` starts a path to the vertex `x` in unit direction `w`.
/// `from` is the point on the light, unused for infinite lights. `direct_w` is the density of
/// next-event estimation at x per steradian; for lights that no walk can hit, the probability of
/// choosing the light ([W5]). Without `asks_onward`, if sums do not need it, `onward` is 0.
inline LightStart light_start(const PairSettings& settings, int light, const Place& from,
                              const Place& x, const Vec3f& w, double direct_w, bool asks_onward) {
  const Scene& scene = settings.scene;
  const Light& l = *scene.lights[light];
  const double chosen = scene.light_sampler->pmf_by_power(light);
  const EmissionDensity e = l.emission_pdf(from.ng, w);
  LightStart s;
  s.hit = !l.is_delta();
  if (l.is_infinite()) {
    s.line = {1, cosine_at(x, w)};
    s.start = chosen * e.pdf_w;
    if (asks_onward) s.onward = settings.guide.density(scene, light, x.p, w, e.pdf_a);
    s.direct = direct_w;
  } else {
    s.line = line_between(from, x);
    s.start = chosen * e.pdf_a;
    if (asks_onward) s.onward = settings.guide.density(scene, light, from.p, w, e.pdf_w);
    s.direct = l.is_delta() ? direct_w * e.pdf_a : direct_w * s.line.at_a;
  }
  return s;
}
/// The same for light found by next-event estimation at the vertex `x`, with the receiver `at`.
inline LightStart light_start(const PairSettings& settings, const DirectSample& d,
                              const Receiver& at, const Place& x, bool asks_onward) {
  const double direct = d.delta ? choice_in_weights(settings, at.p, at.ns, d.light)
                                : choice_over_real(settings, at.p, at.ns, d.light) * d.pdf_w;
  return light_start(settings, d.light, {d.p, d.ng}, x, -d.wi_world, direct, asks_onward);
}

/// [W11] Weight of merging an eye path with a photon; `sums` are those at its vertex `v`, `own` is
/// m of [W8] there.
inline double weight_of_merge(const EyePartialWeights& sums, const WalkVertex& v,
                              const Photon& photon, const MergeEvent& event, double own) {
  const double towards = v.subsurface_exit
                             ? subsurface_density(photon.ng.unpacked(), photon.wi.unpacked())
                             : double{event.bsdf.pdf_w};
  const double back =
      v.subsurface_exit || !sums.asks_back()
          ? 0.0
          : event_density(v.bsdf, event.wi, v.wo, TransportMode::kImportance, event.letter);
  return weight_of_merge(
      sums.at_cut(event.letter, photon.caster), back,
      {sqr(double{photon.root_of_cut_here}), sqr(double{photon.root_of_cuts_before})}, towards,
      own);
}

}  // namespace nephroid
