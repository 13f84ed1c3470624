#include "photon/photon_tracer.h"

#include <algorithm>

#include "core/parallel.h"
#include "photon/light_walk.h"
#include "transport/guided_direction.h"

namespace nephroid {

namespace {

constexpr uint64_t kStream = 0x70686f746f6e;  // "photon"

class PhotonVisitor : public LightWalkVisitor {
 public:
  PhotonVisitor(const OwnedRoutes& owned, const CasterGuide& casters, const Emission& emission,
                std::vector<Photon>& out)
      : LightWalkVisitor(owned, emission), casters_(casters), flux_(emission.flux), out_(out) {
    start_.light = emission.light;
    start_.weight = emission.weight;
  }

  void medium_vertex(const Walk&, const MediumVertex& v, PathSampler&) {
    if (!is_met_) meet(v.p);
  }

  ClassMask useful(const WalkVertex& v) const {
    return routes_.useful_before_deposit(group_, state_, label_at(symbols_, v));
  }
  bool scatters_in(const Medium& medium) const {
    return contains(routes_.useful_before_deposit(group_, state_, symbols_.medium(medium.index())),
                    EventClass::kVolume);
  }

  void vertex(const Walk& walk, const WalkVertex& v, PathSampler&) {
    if (walk.events == 0 && !is_met_) meet(v.surface.p);
    here_ = v.surface.p;
    if (!may_be_met(v, [&](Label label) { return routes_.deposits(group_, state_, label); }))
      return;
    out_.push_back(photon_at(walk, v, flux_));
    ++stored_;
  }

  /// A guided direction carries less because it is chosen more often; roulette must not undo that.
  std::optional<BsdfSample> sample_direction(Walk& walk, const WalkVertex& v, float uc,
                                             const Vec2f& u, ClassMask among) const {
    CasterCones cones;
    if (!casters_.empty() && guided_classes(v.bsdf, among) != ClassMask::kNone &&
        leaves_for_specular(v))
      cones = casters_.at(v, among);
    if (cones.empty()) return v.bsdf.sample(v.wo, uc, u, TransportMode::kImportance, among);
    float gain = 1;
    const auto s =
        GuidedDirection(v.bsdf, v.surface.shading, v.wo, TransportMode::kImportance, among, cones)
            .sample(uc, u, gain);
    if (s) walk.eta_scale *= gain;
    return s;
  }

  bool scatter(const Walk& walk, const WalkEvent& event) {
    if (event.letter == EventClass::kSpecular) {
      specular_ = true;
      if (needs_specular_ && !caster_) caster_ = Caster{here_, out_.size()};
    }
    const bool go_on = LightWalkVisitor::scatter(walk, event);
    needs_specular_ =
        contains(ClassMask::kRough, event.letter) && routes_.needs_specular(group_, state_);
    return go_on;
  }

  bool useful() const { return stored_ > 0; }
  bool specular() const { return specular_; }
  /// The path's start; valid for a useful path.
  const UsefulStart& start() const { return start_; }
  /// Where the path met an S that it needed behind a rough vertex, and its first photon after that.
  struct Caster {
    Vec3f p;
    size_t first_photon = 0;
  };
  const std::optional<Caster>& caster() const { return caster_; }

 private:
  void meet(const Vec3f& p) {
    start_.first_hit = p;
    is_met_ = true;
  }
  /// True if light that leaves `v` by a D or G is useful only if it meets an S.
  bool leaves_for_specular(const WalkVertex& v) const {
    for (const EventClass c : {EventClass::kDiffuse, EventClass::kGlossy})
      for (const bool transmitted : {false, true})
        if (!routes_.needs_specular(
                group_,
                routes_.light_next(state_, event_symbol(c, transmitted, label_at(symbols_, v)))))
          return false;
    return true;
  }
  const CasterGuide& casters_;
  const SampledSpectrum flux_;
  std::vector<Photon>& out_;
  int stored_ = 0;
  bool specular_ = false, needs_specular_ = false, is_met_ = false;
  UsefulStart start_;
  Vec3f here_{0, 0, 0};
  std::optional<Caster> caster_;
};

/// The outcome of one light path.
struct Outcome {
  bool useful = false, specular = false;
  uint64_t rays = 0;
  UsefulStart start;
  std::optional<PhotonVisitor::Caster> caster;
};

/// Launches light path `j` of the pass, as in launch_light_path.
template <class MakeVisitor, class Finish>
void launch(const Scene& scene, const PhotonTraceSettings& settings, int64_t j,
            MakeVisitor&& make_visitor, Finish&& finish) {
  const LightPathSequence sequence{hash_combine(settings.key.seed, kStream)};
  const uint64_t number = uint64_t{settings.key.pass} * settings.photons_per_pass + j;
  const LightPathLaunch launch{scene, settings.guide->starts, settings.specular_alpha,
                               settings.max_events};
  sequence.at(number, [&](PathSampler& sampler) {
    launch_light_path(launch, with_own_hero(settings.lambda, settings.key.seed, number),
                      settings.time, sampler, kEmissionDimensions, make_visitor, finish);
  });
}

/// Traces light path `j` of the pass and adds its photons to `photons`.
Outcome trace_photon(const Scene& scene, const OwnedRoutes& owned,
                     const PhotonTraceSettings& settings, int64_t j, std::vector<Photon>& photons) {
  Outcome outcome;
  launch(
      scene, settings, j,
      [&](const Emission& emission) {
        return PhotonVisitor(owned, settings.guide->casters, emission, photons);
      },
      [&](const PhotonVisitor& visitor, const Walk& walk) {
        outcome = {visitor.useful(), visitor.specular(), walk.rays, visitor.start(),
                   visitor.caster()};
      });
  return outcome;
}

}  // namespace

PhotonTrace trace_photons(const Scene& scene, const OwnedRoutes& owned,
                          const PhotonTraceSettings& settings, int64_t begin, int64_t end) {
  struct Chunk {
    std::vector<Photon> photons;
    uint64_t useful = 0, specular = 0, rays = 0;
  };
  std::vector<Chunk> chunks = chunk_results<Chunk>(
      *settings.control, end - begin, kPhotonChunk, [&](Chunk& chunk, int64_t b, int64_t e) {
        for (int64_t j = begin + b; j < begin + e; ++j) {
          const Outcome outcome = trace_photon(scene, owned, settings, j, chunk.photons);
          chunk.useful += outcome.useful;
          chunk.specular += outcome.specular;
          chunk.rays += outcome.rays;
        }
      });
  PhotonTrace trace;
  trace.paths = end - begin;
  size_t total = 0;
  for (const Chunk& chunk : chunks) total += chunk.photons.size();
  trace.photons.reserve(total);
  for (const Chunk& chunk : chunks) {
    trace.photons.insert(trace.photons.end(), chunk.photons.begin(), chunk.photons.end());
    trace.useful_paths += chunk.useful;
    trace.specular_paths += chunk.specular;
    trace.rays += chunk.rays;
  }
  return trace;
}

void trace_photons_of_path(const Scene& scene, const OwnedRoutes& owned,
                           const PhotonTraceSettings& settings, int64_t j,
                           std::vector<Photon>& photons) {
  trace_photon(scene, owned, settings, j, photons);
}

LightPathRecord record_photon_path(const Scene& scene, const OwnedRoutes& owned,
                                   const PhotonTraceSettings& settings, int64_t j) {
  LightPathRecord record;
  std::vector<Photon> photons;
  launch(
      scene, settings, j,
      [&](const Emission& emission) {
        begin_record(scene, emission, record);
        return RecordingVisitor(PhotonVisitor(owned, settings.guide->casters, emission, photons),
                                record.walk);
      },
      [](const auto&, const Walk&) {});
  return record;
}

UsefulStarts trace_useful_starts(const Scene& scene, const OwnedRoutes& owned,
                                 const PhotonTraceSettings& settings, int64_t begin, int64_t end,
                                 const std::function<bool(const Photon&)>& is_useful) {
  const auto trace_chunk = [&](UsefulStarts& chunk, int64_t b, int64_t e) {
    std::vector<Photon> photons;
    for (int64_t j = begin + b; j < begin + e; ++j) {
      photons.clear();
      const Outcome outcome = trace_photon(scene, owned, settings, j, photons);
      chunk.rays += outcome.rays;
      if (std::none_of(photons.begin(), photons.end(), is_useful)) continue;
      chunk.starts.push_back(outcome.start);
      if (!outcome.caster ||
          std::none_of(photons.begin() + outcome.caster->first_photon, photons.end(), is_useful))
        continue;
      chunk.casters.push_back(outcome.start);
      chunk.casters.back().first_hit = outcome.caster->p;
    }
  };
  UsefulStarts all;
  ordered_reduce<UsefulStarts>(
      *settings.control, end - begin, kPhotonChunk, trace_chunk, [&](UsefulStarts&& chunk) {
        all.starts.insert(all.starts.end(), chunk.starts.begin(), chunk.starts.end());
        all.casters.insert(all.casters.end(), chunk.casters.begin(), chunk.casters.end());
        all.rays += chunk.rays;
      });
  return all;
}

namespace {

/// Appends a trace to another.
void append(PhotonTrace&& more, PhotonTrace& to) {
  if (to.photons.empty())
    to.photons = std::move(more.photons);
  else
    to.photons.insert(to.photons.end(), more.photons.begin(), more.photons.end());
  to.paths += more.paths;
  to.useful_paths += more.useful_paths;
  to.specular_paths += more.specular_paths;
  to.rays += more.rays;
}

bool is_full(const PhotonTrace& trace, int64_t limit) {
  return static_cast<int64_t>(trace.photons.size()) >= limit;
}

}  // namespace

PhotonTrace trace_batch(const Scene& scene, const OwnedRoutes& owned,
                        const PhotonTraceSettings& settings, int64_t limit, int64_t& begin) {
  constexpr int64_t kGroup = 32 * kPhotonChunk;
  PhotonTrace batch;
  while (begin < settings.photons_per_pass && !is_full(batch, limit)) {
    const int64_t end = std::min(begin + kGroup, settings.photons_per_pass);
    append(trace_photons(scene, owned, settings, begin, end), batch);
    begin = end;
  }
  return batch;
}

PhotonMapTrace trace_map(const Scene& scene, const OwnedRoutes& owned,
                         std::span<const PhotonTraceSettings> sets, int64_t limit) {
  PhotonMapTrace map;
  const int64_t paths = sets[0].photons_per_pass;
  std::vector<PhotonTrace> chunks(sets.size());
  while (map.paths_of_set < paths && !is_full(map.trace, limit)) {
    const int64_t begin = map.paths_of_set, end = std::min(begin + kPhotonChunk, paths);
    parallel_chunks(*sets[0].control, sets.size(), 1, [&](int64_t s, int64_t, int64_t) {
      PhotonTraceSettings unwatched_set = sets[s];
      unwatched_set.control = &unwatched;
      PhotonTrace& chunk = chunks[s];
      chunk = trace_photons(scene, owned, unwatched_set, begin, end);
      for (Photon& photon : chunk.photons) photon.set = static_cast<uint8_t>(s);
    });
    for (PhotonTrace& chunk : chunks) append(std::move(chunk), map.trace);
    map.paths_of_set = end;
  }
  return map;
}

}  // namespace nephroid
