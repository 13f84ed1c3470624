// Path tracing at each vertex of a camera walk: lights hit, next-event estimation, and multiple
// importance sampling of the two (docs/estimators.md, section 2). It must not know films or where
// the path's random numbers come from.
#pragma once

#include <array>

#include "core/warps.h"
#include "film/part_sums.h"
#include "integrator/estimator/features.h"
#include "integrator/path/specular_tree.h"
#include "photon/path_recorder.h"
#include "transport/direct_light.h"
#include "transport/walk_symbols.h"

namespace nephroid {

/// Collects the light of one camera path. `Self`, the derived class, may hide
///   float share() const                  factor for lights that the walk hits
///   float share_after(EventClass) const  the same behind an event of this class at this vertex
///   float density(const WalkVertex&, const Vec3f& wi, EventClass, ClassMask among, float) const
///                                        P_c p_c of the walk towards wi; last: that of the BSDF
template <class Self>
class PathVisitorOf {
 public:
  static constexpr bool kEndsAtBranches = false;

  /// With `blind`, walks ignore which events are useful to the routes, so all routes see the same
  /// paths. Null `features`: none are recorded. Null `tree`: none is grown. Null `recorder`: paths
  /// are not recorded.
  PathVisitorOf(const Scene& scene, const OwnedRoutes& owned, bool blind, PartSums& light,
                Features* features, const SpecularTree* tree = nullptr,
                PathRecorder* recorder = nullptr)
      : scene_(scene),
        routes_(*owned.routes),
        symbols_(*owned.symbols),
        group_(owned.group),
        blind_(blind),
        light_(light),
        features_(features),
        recorder_(recorder),
        eye_(routes_.start()),
        root_(tree, SpecularRoot::Leaves::kBranches) {}

  float share() const { return 1.0f; }
  float share_after(EventClass) const { return 1.0f; }
  float density(const WalkVertex&, const Vec3f&, EventClass, ClassMask, float bsdf_pdf_w) const {
    return bsdf_pdf_w;
  }

  void escape(const Walk& walk) {
    if (root_.leaves_lights() || !routes_.ends(group_, eye_)) return;
    for (const int i : scene_.light_sampler->infinite_lights()) {
      const Part part = routes_.owner(eye_, symbols_.light(i));
      if (!light_.owns(part)) continue;
      const Light& light = *scene_.lights[i];
      const SampledSpectrum le =
          light.radiance_at_infinity(walk.previous_p, walk.ray.d, walk.lambda);
      if (le.is_black()) continue;
      meet(walk, part,
           walk.throughput * le *
               (walk.delta ? 1.0f / walk.density.u_mean
                           : weight_of_hit(walk, direct_pdf_w(scene_, walk, i))) *
               self().share(),
           end_at_infinity(scene_, i, walk.ray.o, walk.ray.d));
    }
  }

  void emitter(const Walk& walk, const SurfaceInteraction& hit, const Light& light) {
    if (root_.leaves_lights()) return;
    const Part part = routes_.owner(eye_, symbols_.light(hit.area_light));
    if (!light_.owns(part)) return;
    const SampledSpectrum le = light.radiance(hit.p, hit.ng, hit.uv, hit.wo, walk.lambda);
    if (le.is_black()) return;
    meet(walk, part,
         walk.throughput * le *
             (walk.delta ? 1.0f / walk.density.u_mean
                         : weight_of_hit(walk, direct_pdf_w(scene_, walk, hit))) *
             self().share(),
         {hit.area_light, -1, hit.p});
  }

  void medium_emission(const Medium& medium, const SampledSpectrum& radiance) {
    const Part part = routes_.owner(eye_, symbols_.glow(medium.index()));
    if (!light_.owns(part)) return;
    light_.add(part, symbols_.lamp_of_medium(medium.index()), radiance);
    if (recorder_ != nullptr)
      recorder_->meet({part, Technique::kMeetLight, radiance},
                      {.medium = medium.index(), .has_place = false});
  }

  ClassMask useful(const WalkVertex& v) const {
    return blind_ ? ClassMask::kEvery : routes_.useful(group_, eye_, label_at(symbols_, v));
  }
  bool scatters_in(const Medium& medium) const {
    return blind_ || contains(routes_.useful(group_, eye_, symbols_.medium(medium.index())),
                              EventClass::kVolume);
  }
  bool looks_under_surfaces() const { return false; }

  void vertex(const Walk& walk, const WalkVertex& v, PathSampler& sampler) {
    if (features_ != nullptr) features_->record(walk, v);
    const ClassMask among = v.useful_classes();
    const ClassMask finite = v.bsdf.finite_classes() & among;
    if (may_end_after_any(v, finite)) next_event(walk, v, finite, among, sampler);
  }

  void medium_vertex(const Walk& walk, const MediumVertex& v, PathSampler& sampler) {
    if (v.lit_along || !looks_along(v.medium)) return;
    const auto d = sample_direct(scene_, Receiver::of(v, walk.medium), walk.lambda, sampler);
    if (d) next_event(walk, v, *d, walk.density.u, sampler);
  }
  bool looks_along(const Medium& medium) const {
    return routes_.ends(group_, routes_.next(eye_, symbol_in(symbols_, medium)));
  }
  void light_along(const Walk& walk, const FlightLight& found, PathSampler& sampler) {
    next_event(walk, found.vertex, found.direct, found.collision, sampler);
  }

  bool branches(const Walk&) const { return root_.branches(); }
  void branch(const Walk& way, const WalkEvent& event, PathSampler& sampler) {
    const RecordedBranch recorded(recorder_ != nullptr ? &recorder_->walk : nullptr, event);
    tree_rays_ += root_.branch(way, routes_.next(eye_, symbol_of(symbols_, event)), sampler, light_,
                               recorder_);
  }

  bool scatter(const Walk& walk, const WalkEvent& event) {
    root_.scatter(walk, event.letter);
    eye_ = routes_.next(eye_, symbol_of(symbols_, event));
    return true;
  }

  /// Rays that the walk itself does not count.
  uint64_t more_rays() const { return shadow_rays_ + tree_rays_; }

 protected:
  /// Adds light that the walk itself has come to.
  void meet(const Walk& walk, Part part, const SampledSpectrum& value, const PathEnd& end) {
    const SampledSpectrum whole = whole_spectrum(value, walk.lambda.left());
    light_.add(part, symbols_.lamp(end.light), whole);
    if (recorder_ != nullptr) recorder_->meet({part, Technique::kMeetLight, whole}, end);
  }
  /// Adds light that the event `last` at `p` scatters from a light sample.
  void join(const Walk& walk, Part part, const SampledSpectrum& value, const WalkEvent& last,
            const DirectSample& d, const Vec3f& p) {
    const SampledSpectrum whole = whole_spectrum(value, walk.lambda.left());
    light_.add(part, symbols_.lamp(d.light), whole);
    if (recorder_ != nullptr)
      recorder_->join({part, Technique::kSampleLight, whole}, last, end_at_sample(scene_, d, p));
  }

  const Scene& scene_;
  const Routes& routes_;
  const SceneSymbols& symbols_;
  const size_t group_;
  const bool blind_;
  PartSums& light_;
  Features* const features_;
  PathRecorder* const recorder_;
  EyeState eye_;
  uint64_t shadow_rays_ = 0;

 private:
  const Self& self() const { return static_cast<const Self&>(*this); }

  /// True if the group may own a light right behind an event of one of the classes.
  bool may_end_after_any(const WalkVertex& v, ClassMask finite) const {
    const Label label = label_at(symbols_, v);
    for (const EventClass c : kSurfaceClasses) {
      if (!contains(finite, c)) continue;
      for (const bool transmitted : {false, true})
        if (routes_.ends(group_, routes_.next(eye_, event_symbol(v.letter(c), transmitted, label))))
          return true;
    }
    return false;
  }

  // A walk whose choices do not depend on the hero wavelength needs a shadow ray of the same kind.
  // `from`: where it starts on a surface.
  ShadowFlight shadow_of(const Walk& walk, const WalkVertex* from, const DirectSample& direct,
                         const PathSampler& sampler) {
    ++shadow_rays_;
    if (!is_on_lamp(symbols_, from, direct.light)) light_.count_ray_to(symbols_.lamp(direct.light));
    if (!walk.per_wavelength) return trace_shadow(scene_, direct, walk.lambda, sampler);
    ShadowFlight flight;
    flight.transmittance = attenuation_to_light(scene_, direct, walk.lambda, sampler);
    return flight;
  }

  // MIS weights of the two techniques, the spectral average included ([D3], [V5]).
  static float weight_of_hit(const Walk& walk, float direct_pdf) {
    const SpectralDensity& d = walk.density;
    return power_heuristic(walk.pdf_w * d.u_mean, direct_pdf * d.l_mean) / d.u_mean;
  }
  static float weight_of_direct(const Walk& walk, const DirectSample& direct,
                                const ShadowFlight& shadow, float walk_pdf) {
    if (walk.density.plain && shadow.plain)
      return direct.delta ? 1.0f : power_heuristic(direct.pdf_w, walk_pdf);
    return weight_of_direct(walk, direct, shadow, walk_pdf, walk.density.u);
  }
  // `u_here` is r_u of a walk's event where the light was sampled, up to a factor; the walk's own
  // density is that of the way there.
  static float weight_of_direct(const Walk& walk, const DirectSample& direct,
                                const ShadowFlight& shadow, float walk_pdf,
                                const SampledSpectrum& u_here) {
    const auto mean = [&](const SampledSpectrum& r) {
      const int left = walk.lambda.left();
      return left != kAllWavelengths ? r[left] : r.average();
    };
    const float sampled = mean(walk.density.u * shadow.l);
    if (direct.delta) return 1.0f / sampled;
    return power_heuristic(direct.pdf_w * mean(u_here * shadow.l),
                           walk_pdf * mean(u_here * shadow.u)) /
           sampled;
  }

  void next_event(const Walk& walk, const MediumVertex& v, const DirectSample& d,
                  const SampledSpectrum& u_here, const PathSampler& sampler) {
    const EyeState eye = routes_.next(eye_, symbol_in(symbols_, v.medium));
    const Part part = routes_.owner(eye, symbols_.light(d.light));
    if (!light_.owns(part)) return;
    const ShadowFlight shadow = shadow_of(walk, nullptr, d, sampler);
    if (shadow.transmittance.is_black()) return;
    const float phase = v.phase.eval(v.wo, d.wi_world);
    join(walk, part,
         walk.throughput * d.radiance * shadow.transmittance *
             (phase * weight_of_direct(walk, d, shadow, phase, u_here)) *
             self().share_after(EventClass::kVolume),
         event_in(v.medium), d, v.p);
  }

  void next_event(const Walk& walk, const WalkVertex& v, ClassMask finite, ClassMask among,
                  PathSampler& sampler) {
    const auto d =
        sample_direct(scene_, Receiver::of(v.surface, walk.medium), walk.lambda, sampler);
    if (!d) return;
    const Vec3f wi = v.to_local(d->wi_world);
    const LightSymbol light = symbols_.light(d->light);
    std::array<BsdfEval, std::size(kSurfaceClasses)> evals;
    std::array<Part, std::size(kSurfaceClasses)> parts;
    bool any = false;
    for (size_t i = 0; i < evals.size(); ++i) {
      const EventClass c = kSurfaceClasses[i];
      if (!contains(finite, c)) continue;
      parts[i] = routes_.owner(routes_.next(eye_, symbol_at(symbols_, v, c, wi)), light);
      if (!light_.owns(parts[i])) continue;
      evals[i] = v.bsdf.eval(v.wo, wi, TransportMode::kRadiance, c, among);
      any |= !evals[i].f.is_black();
    }
    if (!any) return;
    const ShadowFlight shadow = shadow_of(walk, &v, *d, sampler);
    if (shadow.transmittance.is_black()) return;
    const SampledSpectrum arriving =
        walk.throughput * d->radiance * shadow.transmittance * abs_cos_theta(wi);
    for (size_t i = 0; i < evals.size(); ++i) {
      if (evals[i].f.is_black()) continue;
      const EventClass c = kSurfaceClasses[i];
      const float walk_pdf = self().density(v, wi, c, among, evals[i].pdf_w);
      join(walk, parts[i],
           arriving * evals[i].f *
               (weight_of_direct(walk, *d, shadow, walk_pdf) * self().share_after(c)),
           event_at(v, c, wi), *d, v.surface.p);
    }
  }

  SpecularRoot root_;
  uint64_t tree_rays_ = 0;
};

/// Plain path tracing.
class PathVisitor : public PathVisitorOf<PathVisitor> {
 public:
  using PathVisitorOf::PathVisitorOf;
};

}  // namespace nephroid
