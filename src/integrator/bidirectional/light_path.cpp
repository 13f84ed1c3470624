// The light side of a pair: its vertices, its photons and its connections to the camera.
#include <cmath>

#include "integrator/bidirectional/connection_end.h"
#include "integrator/bidirectional/path_pair_geometry.h"
#include "photon/light_walk.h"

namespace nephroid {

namespace {

// Follows a walk from a light with its partial MIS weights; stores vertices, photons and splats.
class LightVisitor : public LightWalkVisitor {
 public:
  LightVisitor(const PairSettings& settings, const Emission& emission, float u_time,
               LightSubpath* path, std::vector<CameraSplat>* seen, std::vector<Photon>* photons)
      : LightWalkVisitor(settings.owned, emission),
        settings_(settings),
        rule_(settings.merging ? settings.merging->rule : CasterRule()),
        emission_(emission),
        path_(path),
        seen_(seen),
        photons_(photons) {
    const Light& light = *settings.scene.lights[emission.light];
    start_.p = light.is_area() ? emission.start.p : emission.ray.o;
    if (light.is_area()) start_.ng = emission.start.ng;
    if (settings.view) camera_.emplace(settings.scene, *settings.view, u_time);
  }

  void vertex(const Walk& walk, const WalkVertex& v, PathSampler& sampler) {
    if (v.subsurface_exit)
      come_out(v);
    else
      arrive(walk, {v.surface.p, v.surface.ng}, v.surface.shading.z);
    if (!v.subsurface_exit) entry_wo_ = v.surface.wo;
    surface_ = &v;
    const ClassMask classes = v.useful_classes() & v.bsdf.finite_classes();
    if (photons_) deposit(walk, v);
    if (classes == ClassMask::kNone) return;
    if (seen_) connect_surface(walk, v, classes, sampler);
    if (path_) {
      LightVertex& y = store(walk, classes);
      y.surface = v.surface;
      y.material = &v.material;
      y.wo = v.wo;
      y.merges = v.merges;
      y.subsurface_exit = v.subsurface_exit;
    }
  }

  void medium_vertex(const Walk& walk, const MediumVertex& v, PathSampler& sampler) {
    arrive(walk, {v.p, Vec3f(0, 0, 0)}, Vec3f(0, 0, 0));
    surface_ = nullptr;
    medium_ = &v;
    if (photons_ && settings_.gathers_in_media()) deposit(walk, v);
    if (seen_) connect_medium(walk, v, sampler);
    if (!path_) return;
    LightVertex& y = store(walk, ClassMask::kVolume);
    y.in_medium = true;
    y.surface.p = v.p;
    y.surface.wo = v.wo;
    y.material = nullptr;
    y.phase = v.phase;
    y.medium_index = v.medium.index();
  }

  bool scatter(const Walk& walk, const WalkEvent& event) {
    end_.sums = sums_;
    if (surface_) {
      end_.event = density_of_walk(walk, *surface_, event, TransportMode::kImportance,
                                   surface_->useful_classes(), sums_.before > 0);
      // A photon's own vertex is the one where a path that merges once does.
      end_.merge = settings_.merging && settings_.merging->merges_once()
                       ? 0
                       : merge_weight(*surface_, event.letter, false);
    } else {
      const double p = medium_->phase.eval(medium_->wo, walk.ray.d);
      end_.event = {p, p, true};
      end_.merge = 0;
    }
    after_specular_ |= event.letter == EventClass::kSpecular;
    caster_ = rule_.with(event.letter, caster_);
    last_ = place_;
    is_first_ = false;
    state_ = routes_.light_next(state_, symbol_of(symbols_, event));
    return true;
  }

  uint64_t rays() const { return camera_ ? camera_->rays() : 0; }
  bool after_specular() const { return after_specular_; }

 private:
  void arrive(const Walk& walk, const Place& place, const Vec3f& ns) {
    place_ = place;
    merge_place_ = place.p;
    sums_ = is_first_ ? first_sums(walk, ns) : end_.next(line_between(last_, place_));
    if (!is_first_ && !settings_.connects()) sums_.here = 0;
  }

  PartialMisWeights first_sums(const Walk& walk, const Vec3f& ns) const {
    const Scene& scene = settings_.scene;
    const Light& light = *scene.lights[emission_.light];
    const double chosen = choice_in_weights(settings_, place_.p, ns, emission_.light);
    const Vec3f& w = walk.ray.d;
    const double direct =
        light.is_delta() ? chosen : chosen * light.pdf_towards(place_.p, -w, start_.p, start_.ng);
    return light_start(settings_, emission_.light, start_, place_, w, direct, true).first();
  }

  /// [W10] Moves the sums from the entry under the surface to the exit; both are one vertex.
  void come_out(const WalkVertex& v) {
    sums_.here += heuristic(subsurface_density(place_.ng, entry_wo_)) * sums_.before;
    sums_.before = 0;
    place_ = {v.surface.p, v.surface.ng};
  }

  /// m of [W8]. `first` is true only for connections to the camera: otherwise a connected eye
  /// vertex lies between the eye and this one.
  double merge_weight(const WalkVertex& v, EventClass c, bool first) const {
    return settings_.merging && v.merges && contains(rule_.receivers(caster_), c)
               ? settings_.merging->weight_at(merge_place_, first)
               : 0;
  }

  LightVertex& store(const Walk& walk, ClassMask classes) {
    LightVertex& y = path_->add();
    y.classes = classes;
    y.flux = emission_.flux * walk.throughput;
    y.lambda = walk.lambda;
    y.specular_alpha = walk.specular_alpha;
    y.state = state_;
    y.lamp = lamp_;
    y.events = walk.events;
    y.sums = sums_;
    const bool merges = settings_.merging && rule_.receivers(caster_) != ClassMask::kNone;
    y.merge = merges ? settings_.merging->weight_at(merge_place_, false) : 0;
    return y;
  }

  void deposit(const Walk& walk, const WalkVertex& v) {
    if (v.subsurface_exit || !may_be_met(v, [&](Label label) {
          return routes_.useful_from_light(group_, state_, label) & rule_.receivers(caster_);
        }))
      return;
    Photon photon = photon_at(walk, v, emission_.flux);
    photon.caster = caster_;
    photon.root_of_cut_here = static_cast<float>(std::sqrt(sums_.here));
    photon.root_of_cuts_before = static_cast<float>(std::sqrt(sums_.before));
    photons_->push_back(photon);
  }

  // Photons that come straight from a light are not merged in media.
  void deposit(const Walk& walk, const MediumVertex& v) {
    if (caster_ == Caster::kNone ||
        !contains(routes_.useful_from_light(group_, state_, symbols_.medium(v.medium.index())),
                  EventClass::kVolume))
      return;
    Photon photon = photon_at(walk, v, emission_.flux);
    photon.caster = caster_;
    photons_->push_back(photon);
  }

  bool makes_connection(const Walk& walk) const {
    return settings_.view && settings_.connects() && settings_.technique.makes(walk.events + 2, 1);
  }
  /// [W9] `density` is E_1, camera walks per area at the vertex; `back` is g of the event there.
  float weight_of_connection(double density, double back, double merge) const {
    if (!settings_.technique.weighted) return 1.0f;
    return static_cast<float>(
        1 / (1 + cuts_before(sums_, density, back, merge) / heuristic(settings_.light_paths)));
  }

  void connect_surface(const Walk& walk, const WalkVertex& v, ClassMask classes,
                       PathSampler& sampler) {
    if (!makes_connection(walk)) return;
    const auto part_of = [&](EventClass c, const Vec3f& wi) {
      const Part part =
          routes_.meet(routes_.next(routes_.start(), symbol_at(symbols_, v, c, wi)), state_);
      return routes_.owns(group_, part) ? part : kNoPart;
    };
    camera_->connect(walk, v, classes, sampler, part_of, [&](const CameraEvent& event) {
      const CameraConnection& line = event.seen.line;
      const double back =
          v.subsurface_exit || !(sums_.before > 0)
              ? 0.0
              : event_density(v.bsdf, event.wi, v.wo, TransportMode::kRadiance, event.letter);
      splat(event.seen, event.part, walk, event.f * event.through,
            event.cosine * weight_of_connection(static_cast<double>(line.film_density) *
                                                    abs_dot(line.wi, v.surface.ng),
                                                back, merge_weight(v, event.letter, true)));
    });
  }

  void connect_medium(const Walk& walk, const MediumVertex& v, PathSampler& sampler) {
    const Part part =
        routes_.meet(routes_.next(routes_.start(), symbol_in(symbols_, v.medium)), state_);
    if (!makes_connection(walk) || !routes_.owns(group_, part)) return;
    camera_->connect(walk, v, sampler,
                     [&](const LensConnection& seen, const SampledSpectrum& through, float phase) {
                       splat(seen, part, walk, through,
                             phase * weight_of_connection(seen.line.film_density, phase, 0));
                     });
  }

  void splat(const LensConnection& seen, Part part, const Walk& walk, const SampledSpectrum& share,
             float factor) {
    const SampledSpectrum value = emission_.flux * walk.throughput * share *
                                  (factor * seen.line.film_density * seen.line.weight);
    if (value.is_black()) return;
    seen_->push_back({seen, part, lamp_, whole_spectrum(value, walk.lambda.left())});
  }

  const PairSettings& settings_;
  const CasterRule rule_;
  const Emission& emission_;
  std::optional<CameraConnector> camera_;  ///< empty: no connections to the camera
  LightSubpath* path_;
  std::vector<CameraSplat>* seen_;
  std::vector<Photon>* photons_;
  Place start_, last_, place_;
  Vec3f merge_place_{0, 0, 0};  ///< place where the eye side would merge
  Vec3f entry_wo_{0, 0, 1};
  bool is_first_ = true;
  bool after_specular_ = false;  ///< the path has had an S event
  Caster caster_ = Caster::kNone;
  PartialMisWeights sums_;
  SideEnd end_;
  const WalkVertex* surface_ = nullptr;
  const MediumVertex* medium_ = nullptr;
};

/// Launches a light path with the sampler's numbers from `first_dimension` on, as in
/// launch_light_path.
template <class MakeVisitor, class Finish>
void launch(const PairSettings& settings, const SampledWavelengths& lambda, float u_time,
            PathSampler& sampler, int first_dimension, MakeVisitor&& make_visitor,
            Finish&& finish) {
  sampler.start_dimension(first_dimension);
  // A technique with s light vertices, the light itself included, needs no more of them.
  const int most = settings.technique.s < 0
                       ? settings.max_depth
                       : std::clamp(settings.technique.s - 1, 0, settings.max_depth);
  const LightPathLaunch launch{settings.scene, settings.guide, settings.specular_alpha, most};
  launch_light_path(launch, lambda, settings.scene.camera->motion_time(u_time), sampler,
                    first_dimension + kEmissionDimensions, make_visitor, finish);
}

}  // namespace

const Bsdf* LightVertex::bsdf() const {
  if (bsdf_ || !material) return bsdf_;
  arena_.clear();
  SampledWavelengths own = lambda;
  if (subsurface_exit) {
    const Bssrdf* bssrdf = material->make_bssrdf(surface, own, arena_);
    bsdf_ = bssrdf ? bssrdf->exit_bsdf(arena_) : nullptr;
  } else {
    bsdf_ = material->make_bsdf(surface, own, specular_alpha, arena_);
  }
  return bsdf_;
}

bool ends_at_light(const Routes& routes, const SceneSymbols& symbols, const LightVertex& y,
                   const Vec3f& w, ConnectionEnds& ends) {
  if (y.in_medium) {
    const double p = y.phase.eval(y.surface.wo, w);
    const Label label = symbols.medium(y.medium_index);
    ends[0] = {SampledSpectrum(static_cast<float>(p)),
               {p, p, true},
               0,
               0,
               routes.light_next(y.state, event_symbol(EventClass::kVolume, false, label)),
               true};
    return true;
  }
  const Bsdf* bsdf = y.bsdf();
  if (!bsdf) return false;
  const Vec3f wi = y.surface.shading.to_local(w);
  const float cosine = light_side_cosine(y.surface, y.wo, w, y.subsurface_exit);
  if (!std::isfinite(cosine)) return false;
  const bool transmits = y.subsurface_exit || y.wo.z * wi.z < 0.0f;
  bool any = false;
  for (size_t i = 0; i < ends.size(); ++i) {
    const EventClass c = kSurfaceClasses[i];
    if (!contains(y.classes, c)) continue;
    const BsdfEval e = bsdf->eval(y.wo, wi, TransportMode::kImportance, c, ClassMask::kAll);
    if (e.f.is_black()) continue;
    ConnectionEnd& end = ends[i];
    end.used = any = true;
    end.f = e.f * cosine;
    end.density = {e.pdf_w, 0, true};
    if (y.subsurface_exit)
      end.density.forward = subsurface_density(y.surface.ng, w);
    else if (y.sums.before > 0)
      end.density.back = event_density(*bsdf, wi, y.wo, TransportMode::kRadiance, c);
    end.merge = y.merges && contains(ClassMask::kRough, c) ? y.merge : 0;
    end.light = routes.light_next(y.state, event_symbol(y.merges ? c : EventClass::kHair, transmits,
                                                        symbols.material(y.material->index())));
  }
  return any;
}

LightVertex& LightSubpath::add() {
  if (size_ == vertices_.size()) vertices_.push_back(std::make_unique<LightVertex>());
  LightVertex& y = *vertices_[size_++];
  y.bsdf_ = nullptr;
  y.in_medium = y.subsurface_exit = false;
  y.merges = true;
  return y;
}

LightPathCounts trace_light_path(const PairSettings& settings, const SampledWavelengths& lambda,
                                 float u_time, PathSampler& sampler, LightSubpath* path,
                                 std::vector<CameraSplat>* seen, std::vector<Photon>* photons,
                                 int first_dimension) {
  if (path) path->clear();
  LightPathCounts counts;
  launch(
      settings, lambda, u_time, sampler, first_dimension,
      [&](const Emission& emission) {
        return LightVisitor(settings, emission, u_time, path, seen, photons);
      },
      [&](const LightVisitor& visitor, const Walk& walk) {
        counts = {walk.rays + visitor.rays(), visitor.after_specular()};
      });
  return counts;
}

LightPathRecord record_light_path(const PairSettings& settings, const SampledWavelengths& lambda,
                                  float u_time, PathSampler& sampler) {
  LightPathRecord record;
  launch(
      settings, lambda, u_time, sampler, 0,
      [&](const Emission& emission) {
        begin_record(settings.scene, emission, record);
        return RecordingVisitor(LightVisitor(settings, emission, u_time, nullptr, nullptr, nullptr),
                                record.walk);
      },
      [](const auto&, const Walk&) {});
  return record;
}

}  // namespace nephroid
