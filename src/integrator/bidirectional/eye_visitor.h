// The walk of a pair's eye side: its state, the lights that it hits, and next-event estimation. It
// must not know passes or the film's sums.
#pragma once

#include "integrator/bidirectional/connection_end.h"
#include "integrator/bidirectional/eye_weights.h"
#include "integrator/bidirectional/merge_roulette.h"
#include "integrator/bidirectional/path_pair_geometry.h"
#include "integrator/learning/guided_walk.h"
#include "transport/walk_symbols.h"

namespace nephroid {

class EyeVisitor {
 public:
  static constexpr bool kEndsAtBranches = false;

  EyeVisitor(const PairSettings& settings, const LightSubpath& path, const CameraPath& camera,
             PartSums& light, const EyePathExtras& extras)
      : settings_(settings),
        routes_(*settings.owned.routes),
        symbols_(*settings.owned.symbols),
        group_(settings.owned.group),
        path_(path),
        camera_(camera),
        light_(light),
        features_(extras.features),
        recorder_(extras.recorder),
        roulette_(extras.merged, extras.counts_merged,
                  settings.merging ? settings.merging->photons_for_one : 1),
        guided_(settings.radiance, extras.records),
        eye_(routes_.start()),
        sums_(settings.connects(), settings.merging ? settings.merging->rule : CasterRule()),
        root_(settings.has_trees() ? settings.tree : nullptr, extras.leaves) {}

  void escape(const Walk& walk) {
    if (root_.leaves_lights() || !makes(0, walk) || !routes_.ends(group_, eye_)) return;
    const Scene& scene = settings_.scene;
    for (const int i : scene.light_sampler->infinite_lights()) {
      const Part part = routes_.owner(eye_, symbols_.light(i));
      if (!light_.owns(part)) continue;
      const SampledSpectrum le =
          scene.lights[i]->radiance_at_infinity(walk.previous_p, walk.ray.d, walk.lambda);
      if (le.is_black()) continue;
      const double weight = weight_of_hit(walk, i, {}, i);
      meet(part, walk, walk.throughput * le * static_cast<float>(weight),
           end_at_infinity(scene, i, walk.ray.o, walk.ray.d));
    }
  }

  void emitter(const Walk& walk, const SurfaceInteraction& hit, const Light& light) {
    if (root_.leaves_lights()) return;
    const Part part = routes_.owner(eye_, symbols_.light(hit.area_light));
    if (!makes(0, walk) || !light_.owns(part)) return;
    const SampledSpectrum le = light.radiance(hit.p, hit.ng, hit.uv, hit.wo, walk.lambda);
    if (le.is_black()) return;
    const double weight = weight_of_hit(walk, hit.area_light, {hit.p, hit.ng}, hit);
    meet(part, walk, walk.throughput * le * static_cast<float>(weight),
         {hit.area_light, -1, hit.p});
  }

  void medium_emission(const Medium&, const SampledSpectrum&) {}

  ClassMask useful(const WalkVertex& v) const {
    return routes_.useful(group_, eye_, label_at(symbols_, v));
  }
  bool scatters_in(const Medium& medium) const { return !gathers() && may_scatter_in(medium); }
  bool may_scatter_in(const Medium& medium) const {
    return contains(routes_.useful(group_, eye_, symbols_.medium(medium.index())),
                    EventClass::kVolume);
  }
  bool looks_under_surfaces() const { return false; }

  /// Survival probability q of [W12].
  float survival(const WalkVertex& v) {
    return v.bsdf.finite_classes() == ClassMask::kNone ? 1.0f : roulette_.survival();
  }

  void vertex(const Walk& walk, const WalkVertex& v, PathSampler& sampler) {
    if (v.subsurface_exit) {
      sums_.come_out(subsurface_density(place_.ng, entry_wo_));
      roulette_.come_out();
      place_ = {v.surface.p, v.surface.ng};
    } else {
      arrive({v.surface.p, v.surface.ng});
      entry_wo_ = v.surface.wo;
    }
    surface_ = &v;
    if (features_) features_->record(walk, v);
    guided_.arrive(walk);
    const ClassMask among = v.useful_classes() & v.bsdf.finite_classes();
    if (among == ClassMask::kNone) return;
    const EyeEnd end{walk, &v, nullptr, among, Receiver::of(v.surface, walk.medium)};
    next_event(end, sampler);
    if (settings_.connects() && !settings_.merges_only) connect(end, sampler);
    if (settings_.merging && settings_.merging->grid && settings_.technique.merges())
      merge(walk, v, among, sampler);
  }

  void medium_vertex(const Walk& walk, const MediumVertex& v, PathSampler& sampler) {
    arrive({v.p, Vec3f(0, 0, 0)});
    surface_ = nullptr;
    medium_ = &v;
    const EyeEnd end{walk, nullptr, &v, ClassMask::kVolume, Receiver::of(v, walk.medium)};
    if (!v.lit_along) next_event(end, sampler);
    if (settings_.connects() && !settings_.merges_only) connect(end, sampler);
  }

  bool looks_along(const Medium& medium) const {
    return !settings_.merges_only &&
           routes_.ends(group_, routes_.next(eye_, symbol_in(symbols_, medium)));
  }
  bool gathers_in(const Medium& medium) const {
    return gathers() && !medium.is_purely_absorbing() && may_scatter_in(medium);
  }
  /// [V8] Merges the photons of a medium along the walk's next flight.
  void gather_along(const Walk& walk, const Medium& medium, float t_max, FlightRandom& random);
  // No MIS weight depends on where the walk itself collides ([V6]).
  void light_along(const Walk& walk, const FlightLight& found, PathSampler& sampler) {
    if (!makes(1, walk)) return;
    const EyePartialWeights sums = sums_;
    const Place place = place_;
    arrive({found.vertex.p, Vec3f(0, 0, 0)});
    add_direct(
        {walk, nullptr, &found.vertex, ClassMask::kVolume, Receiver::of(found.vertex, walk.medium)},
        found.direct, sampler);
    sums_ = sums;
    place_ = place;
  }

  bool branches(const Walk&) const { return root_.branches(); }
  // No other technique finds this light, so it needs no weight.
  void branch(const Walk& way, const WalkEvent& event, PathSampler& sampler) {
    const RecordedBranch recorded(recorder_ ? &recorder_->walk : nullptr, event);
    rays_ += root_.branch(way, routes_.next(eye_, symbol_of(symbols_, event)), sampler, light_,
                          recorder_);
  }

  /// MIS weights use the BSDF's density alone, as all techniques do ([Q5]).
  std::optional<BsdfSample> sample_direction(Walk& walk, const WalkVertex& v, float uc,
                                             const Vec2f& u, ClassMask among) const {
    return guided_.sample_direction(walk, v, uc, u, among);
  }

  bool scatter(const Walk& walk, const WalkEvent& event) {
    root_.scatter(walk, event.letter);
    roulette_.leave(event.letter, first_ && settings_.merges_all_light());
    EventDensity density;
    double merge = 0;
    if (surface_) {
      guided_.leave(walk, *surface_, event);
      density = density_of_walk(walk, *surface_, event, TransportMode::kRadiance,
                                surface_->useful_classes(), sums_.asks_back());
      merge = merge_weight();
    } else {
      const double p = medium_->phase.eval(medium_->wo, walk.ray.d);
      density = {p, p, true};
    }
    sums_.leave(density, merge, event.letter);
    if (merge > 0 && contains(ClassMask::kRough, event.letter) && settings_.merging->merges_once())
      may_merge_ = false;
    last_ = place_;
    first_ = first_ && !density.finite;
    all_specular_ = all_specular_ && event.letter == EventClass::kSpecular;
    eye_ = routes_.next(eye_, symbol_of(symbols_, event));
    return first_ || !roulette_.counts();
  }

  /// Call when the walk has ended.
  EyePathCounts finish() {
    guided_.finish();
    return {camera_.walk.rays + rays_, probes_, roulette_.merged()};
  }

 private:
  bool makes(int light_vertices, const Walk& walk) const {
    return !settings_.merges_only && settings_.technique.makes(light_vertices, walk.events + 2);
  }
  /// True if the walk does not scatter in media: photons find its indirect light there.
  bool gathers() const { return all_specular_ && settings_.gathers_in_media(); }
  /// [W7] `hit` as in direct_pdf_w(), the others as in light_start().
  double weight_of_hit(const Walk& walk, int light, const Place& from, const auto& hit) const {
    if (!settings_.technique.weighted || walk.events == 0) return 1;
    const SideEnd& end = sums_.end_to_light();
    const double direct = choice_over_real(settings_, walk.previous_p, walk.previous_ns, light) *
                          direct_pdf_w(settings_.scene, walk, hit);
    const LightStart start =
        light_start(settings_, light, from, last_, -walk.ray.d, direct, end.has_cuts_before());
    return nephroid::weight_of_hit(start, end.next({start.line.at_b, start.line.at_a}));
  }
  /// Adds light that the walk itself has come to.
  void meet(Part part, const Walk& walk, const SampledSpectrum& value, const PathEnd& end) {
    const SampledSpectrum whole = whole_spectrum(value, walk.lambda.left());
    add_whole(part, symbols_.lamp(end.light), Technique::kMeetLight, whole);
    if (recorder_) recorder_->meet({part, Technique::kMeetLight, whole}, end);
  }
  /// Adds light that event `i` of the vertex scatters from a light sample.
  void join(Part part, const EyeEnd& z, size_t i, const SampledSpectrum& value,
            const DirectSample& d) {
    const SampledSpectrum whole = whole_spectrum(value, z.walk.lambda.left());
    add_whole(part, symbols_.lamp(d.light), Technique::kSampleLight, whole);
    if (!recorder_) return;
    const WalkEvent last =
        z.medium ? event_in(z.medium->medium)
                 : event_at(*z.surface, z.class_of(i), z.surface->to_local(d.wi_world));
    recorder_->join({part, Technique::kSampleLight, whole}, last,
                    end_at_sample(settings_.scene, d, place_.p));
  }
  void add_whole(Part part, Lamp lamp, Technique technique, const SampledSpectrum& whole,
                 float bias = 0) {
    guided_.add(whole);
    light_.add(part, lamp, whole, technique);
    if (technique == Technique::kMerge) light_.add_merged(whole, whole * bias);
  }

  void arrive(const Place& place) {
    place_ = place;
    if (camera_.walk.events > 0)
      sums_.arrive(line_between(last_, place_));
    else
      sums_.arrive_first(cut_at_camera(settings_, camera_, place_));
  }

  /// m of [W8], for an event of a class that merges.
  double merge_weight() const {
    const bool merges = settings_.merging && may_merge_ && surface_->merges;
    return merges ? settings_.merging->weight_at(place_.p, first_) : 0;
  }

  /// Evaluates the events at an eye vertex towards the unit direction `w` of a light or a light
  /// vertex. `behind` is the smoothest caster from there to the light. False if none is of use.
  bool ends_at_eye(const EyeEnd& z, const Vec3f& w, Caster behind, ConnectionEnds& ends) const {
    if (z.medium) {
      ConnectionEnd& end = ends[0];
      const double p = z.medium->phase.eval(z.medium->wo, w);
      end = {SampledSpectrum(static_cast<float>(p)),
             {p, p, true},
             0,
             routes_.next(eye_, symbol_in(symbols_, z.medium->medium)),
             0,
             true};
      return true;
    }
    const WalkVertex& v = *z.surface;
    const Vec3f wi = v.to_local(w);
    bool any = false;
    for (size_t i = 0; i < ends.size(); ++i) {
      const EventClass c = kSurfaceClasses[i];
      if (!contains(z.among, c)) continue;
      const BsdfEval e = v.bsdf.eval(v.wo, wi, TransportMode::kRadiance, c, ClassMask::kAll);
      if (e.f.is_black()) continue;
      ConnectionEnd& end = ends[i];
      end.used = any = true;
      end.f = e.f * abs_cos_theta(wi);
      end.density = {e.pdf_w, 0, true};
      if (v.subsurface_exit)
        end.density.forward = subsurface_density(v.surface.ng, w);
      else if (sums_.at_cut(c, behind).before > 0)
        end.density.back = event_density(v.bsdf, wi, v.wo, TransportMode::kImportance, c);
      end.merge = sums_.merges(c, behind) ? merge_weight() : 0;
      end.eye = routes_.next(eye_, symbol_at(symbols_, v, c, wi));
    }
    return any;
  }

  void next_event(const EyeEnd& z, PathSampler& sampler) {
    if (!makes(1, z.walk)) return;
    const auto d = sample_direct(settings_.scene, z.receiver, z.walk.lambda, sampler);
    if (d) add_direct(z, *d, sampler);
  }
  void add_direct(const EyeEnd& z, const DirectSample& d, const PathSampler& sampler) {
    ConnectionEnds ends;
    if (!ends_at_eye(z, d.wi_world, Caster::kNone, ends)) return;
    SampledSpectrum arriving;
    LightStart start;
    bool traced = false;
    for (size_t i = 0; i < ends.size(); ++i) {
      const ConnectionEnd& end = ends[i];
      if (!end.used) continue;
      const Part part = routes_.owner(end.eye, symbols_.light(d.light));
      if (!light_.owns(part)) continue;
      if (!traced) {
        arriving = z.walk.throughput * d.radiance * shadow(d, z, sampler);
        if (arriving.is_black()) return;
        start = light_start(settings_, d, z.receiver, place_, others_cut(z, ends));
      }
      traced = true;
      double weight = 1;
      if (settings_.technique.weighted && !(z.medium && gathers()))
        weight = weight_of_direct(start, sums_.at_cut(z.class_of(i), Caster::kNone),
                                  end.density.forward, end.density.back, end.merge);
      join(part, z, i, arriving * end.f * static_cast<float>(weight), d);
    }
  }

  /// True if light paths could also have come here from the light, by one of the events.
  bool others_cut(const EyeEnd& z, const ConnectionEnds& ends) const {
    for (size_t i = 0; i < ends.size(); ++i)
      if (ends[i].used &&
          (ends[i].merge > 0 || !sums_.at_cut(z.class_of(i), Caster::kNone).empty()))
        return true;
    return false;
  }

  SampledSpectrum shadow(const DirectSample& d, const EyeEnd& z, const PathSampler& sampler) {
    ++rays_;
    if (!is_on_lamp(symbols_, z.surface, d.light)) light_.count_ray_to(symbols_.lamp(d.light));
    return attenuation_to_light(settings_.scene, d, z.walk.lambda, sampler);
  }

  /// Connects the vertex to those of the light path.
  void connect(const EyeEnd& z, const PathSampler& sampler);
  void connect_to(const EyeEnd& z, const LightVertex& y, const PathSampler& sampler);
  /// [W11], [W13] Merges the photons around the vertex.
  void merge(const Walk& walk, const WalkVertex& v, ClassMask among, const PathSampler& sampler);

  const PairSettings& settings_;
  const Routes& routes_;
  const SceneSymbols& symbols_;
  const size_t group_;
  const LightSubpath& path_;
  const CameraPath& camera_;
  PartSums& light_;
  Features* features_;
  PathRecorder* recorder_;
  MergeRoulette roulette_;
  GuidedWalk guided_;
  EyeState eye_;
  Place last_, place_;
  Vec3f entry_wo_{0, 0, 1};
  bool first_ = true;         ///< only delta lobes so far
  bool all_specular_ = true;  ///< only S so far, rough ones included
  bool may_merge_ = true;     ///< false behind the vertex of a path that merges once
  EyePartialWeights sums_;
  const WalkVertex* surface_ = nullptr;
  const MediumVertex* medium_ = nullptr;
  SpecularRoot root_;
  uint64_t rays_ = 0, probes_ = 0;
};

}  // namespace nephroid
