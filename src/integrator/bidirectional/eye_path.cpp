// The eye side of a pair: connections with its light path, merges with photons, and its walk.
#include "integrator/bidirectional/eye_visitor.h"
#include "photon/disc_area.h"
#include "photon/merge.h"

namespace nephroid {

void EyeVisitor::connect(const EyeEnd& z, const PathSampler& sampler) {
  for (size_t i = 0; i < path_.size(); ++i) {
    const LightVertex& y = path_[i];
    if (z.walk.events + y.events + 2 > settings_.max_depth) return;
    if (settings_.technique.makes(y.events + 2, z.walk.events + 2)) connect_to(z, y, sampler);
  }
}

void EyeVisitor::connect_to(const EyeEnd& z, const LightVertex& y, const PathSampler& sampler) {
  const Vec3f way = y.surface.p - place_.p;
  const float d2 = length_squared(way);
  if (!(d2 > 0.0f)) return;
  const Vec3f w = way / std::sqrt(d2);
  ConnectionEnds eye_ends, light_ends;
  // All light is merged, so any event is a caster.
  if (!ends_at_eye(z, w, Caster::kSpecular, eye_ends) ||
      !ends_at_light(routes_, symbols_, y, -w, light_ends))
    return;
  const Place at_y{y.surface.p, y.in_medium ? Vec3f(0, 0, 0) : y.surface.ng};
  const LineFactors line = line_between(place_, at_y);
  SampledSpectrum arriving;
  bool traced = false;
  for (const ConnectionEnd& a : eye_ends) {
    if (!a.used) continue;
    for (const ConnectionEnd& b : light_ends) {
      if (!b.used) continue;
      const Part part = routes_.meet(a.eye, b.light);
      if (!light_.owns(part)) continue;
      if (!traced) {
        ++rays_;
        arriving = z.walk.throughput * y.flux *
                   attenuation_between(settings_.scene, z, y, w, sampler) / d2;
      }
      traced = true;
      if (arriving.is_black()) return;
      double weight = 1;
      if (settings_.technique.weighted)
        weight =
            1 / (1 + cuts_before(y.sums, a.density.forward * line.at_b, b.density.back, b.merge) +
                 cuts_before(sums_.most(), b.density.forward * line.at_a, a.density.back, a.merge));
      add_whole(part, y.lamp, Technique::kConnect,
                whole_spectrum(arriving * a.f * b.f * static_cast<float>(weight),
                               left_of_both(z.walk.lambda.left(), y.lambda.left())));
    }
  }
}

void EyeVisitor::merge(const Walk& walk, const WalkVertex& v, ClassMask among,
                       const PathSampler& sampler) {
  const PairMerging& merging = *settings_.merging;
  const ClassMask classes = among & ClassMask::kRough;
  const float radius = merging.radius_at(place_.p);
  if (!may_merge_ || !v.merges || classes == ClassMask::kNone || !(radius > 0.0f)) return;
  const MergePoint at{v, eye_, classes, walk.events + 1, walk.throughput, walk.lambda.left()};
  // Made at the first photon: most vertices have none.
  std::optional<PhotonMerger> merger;
  DiscProbes disc;
  const double own = merging.weight_at(place_.p, first_);
  float scale = 1.0f / (static_cast<float>(merging.photons) * kPi * sqr(radius));
  merging.grid->query(place_.p, radius, [&](const Photon& photon, float d2) {
    if (are_apart(at.left, photon.left)) return;
    roulette_.merge();
    if (roulette_.counts()) return;
    if (!merger) {
      merger.emplace(settings_.owned, at, settings_.max_depth,
                     [&](EventSymbol event) { return routes_.next(eye_, event); });
      // Behind other rough events merges have little weight.
      if (first_ && merging.corrects_edges)
        disc =
            probe_disc(settings_.scene, v.surface, radius, sampler.stream(walk.vertex_dimension()));
      probes_ += disc.rays;
      scale *= disc.inverse_cover;
    }
    merger->each_event(photon, [&](const MergeEvent& event) {
      if (!sums_.merges(event.letter, photon.caster)) return;
      const double weight =
          settings_.technique.weighted ? weight_of_merge(sums_, v, photon, event, own) : 1;
      const SampledSpectrum whole =
          merged_spectrum(walk.throughput * event.bsdf.f * photon.flux.unpacked() *
                              (event.cosine * scale * static_cast<float>(weight)),
                          at.left, photon.left);
      add_whole(event.part, photon.lamp, Technique::kMerge, whole,
                bias_factor(d2, radius) + disc.bias_offset);
      if (recorder_)
        recorder_->merge({event.part, Technique::kMerge, whole},
                         event_at(v, event.letter, event.wi), photon);
    });
  });
}

void EyeVisitor::gather_along(const Walk& walk, const Medium& medium, float t_max,
                              FlightRandom& random) {
  const PairMerging& merging = *settings_.merging;
  if (!merging.media || roulette_.counts()) return;
  const EyeState eye = routes_.next(eye_, symbol_in(symbols_, medium));
  const int left = walk.lambda.left();
  // Made at the first photon: most flights have none. The phase function is the same everywhere.
  std::optional<FlightTransmittance> through;
  HenyeyGreenstein phase;
  merging.media->query(walk.ray, t_max, [&](const Photon& photon, float t, float d2, float radius) {
    if (photon.medium != medium.index() || are_apart(left, photon.left) ||
        photon.events + walk.events + 1 > settings_.max_depth)
      return;
    roulette_.count_in_medium();
    const Part part = routes_.meet(eye, photon.state);
    if (!light_.owns(part)) return;
    if (!through) {
      through.emplace(medium, walk.ray, t_max, walk.lambda, random);
      phase = medium.at(photon.p, walk.lambda).phase;
    }
    const float scale = phase.eval(-walk.ray.d, photon.wi.unpacked()) /
                        (static_cast<float>(merging.photons) * kPi * sqr(radius));
    const SampledSpectrum whole = merged_spectrum(
        walk.throughput * through->at(t) * photon.flux.unpacked() * scale, left, photon.left);
    add_whole(part, photon.lamp, Technique::kMerge, whole, bias_factor(d2, radius));
    if (recorder_) {
      const RecordedDetour recorded(recorder_->walk, photon.p);
      recorder_->merge({part, Technique::kMerge, whole}, event_in(medium), photon);
    }
  });
}

EyePathCounts trace_eye_path(const PairSettings& settings, const LightSubpath& path,
                             CameraPath& camera, PathSampler& sampler, PartSums& light,
                             const EyePathExtras& extras) {
  if (!(camera.camera_weight > 0)) return {};
  camera.walk.specular_alpha = settings.specular_alpha;
  camera.walk.per_wavelength = true;
  // A technique with t eye vertices, the lens included, needs no more of them, and no event where
  // the path hits a light.
  const TechniqueChoice& one = settings.technique;
  const int most = one.t < 0 ? settings.max_depth
                             : std::clamp(one.t - (one.s == 0 ? 2 : 1), 0, settings.max_depth);
  const auto run = [&](auto&& visitor) {
    random_walk(settings.scene, TransportMode::kRadiance, most, camera.walk, sampler, visitor);
    return visitor.finish();
  };
  EyeVisitor visitor(settings, path, camera, light, extras);
  if (extras.recorder) return run(RecordingVisitor(std::move(visitor), extras.recorder->walk));
  return run(visitor);
}

}  // namespace nephroid
