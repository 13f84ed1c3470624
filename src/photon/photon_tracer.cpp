#include "photon/photon_tracer.h"

#include <algorithm>

#include "core/parallel.h"
#include "photon/light_walk.h"

namespace nephroid {

namespace {

// Later vertices are random: photons that come so far are many, and points are made for each
// photon.
constexpr int kStratifiedDimensions = 48;
constexpr uint64_t kStream = 0x70686f746f6e;  // "photon"

class PhotonVisitor : public LightWalkVisitor {
 public:
  PhotonVisitor(const OwnedRoutes& owned, const Emission& emission, std::vector<Photon>& out)
      : LightWalkVisitor(owned, emission), flux_(emission.flux), out_(out) {}

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
    if ((v.possible & deposits_at(v)) == ClassMask::kNone) return;
    Photon photon;
    photon.p = v.surface.p;
    photon.wi = v.surface.wo;
    photon.ng = v.surface.ng;
    photon.flux = flux_ * walk.throughput / v.surface.coverage;
    photon.state = state_;
    photon.secondary_terminated = walk.lambda.secondary_terminated();
    photon.events = static_cast<uint16_t>(walk.events);
    out_.push_back(photon);
    ++stored_;
  }

  bool scatter(const Walk& walk, const WalkEvent& event) {
    specular_ |= event.letter == EventClass::kSpecular;
    return LightWalkVisitor::scatter(walk, event);
  }

  bool useful() const { return stored_ > 0; }
  bool specular() const { return specular_; }
  const Vec3f& first_hit() const { return first_hit_; }

 private:
  void meet(const Vec3f& p) {
    first_hit_ = p;
    is_met_ = true;
  }
  /// Where a mix chooses among materials, whoever looks here may see another one.
  ClassMask deposits_at(const WalkVertex& v) const {
    if (!v.mixed) return routes_.deposits(group_, state_, label_at(symbols_, v));
    ClassMask any = ClassMask::kNone;
    for (size_t label = 0; label <= routes_.labels().size(); ++label)
      any = any | routes_.deposits(group_, state_, static_cast<Label>(label));
    return any;
  }

  const SampledSpectrum flux_;
  std::vector<Photon>& out_;
  int stored_ = 0;
  bool specular_ = false, is_met_ = false;
  Vec3f first_hit_{0, 0, 0};
};

/// What became of one light path.
struct Outcome {
  bool useful = false, specular = false;
  uint64_t rays = 0;
  UsefulStart start;
};

/// Photon number `j` of the pass; what it leaves goes to `photons`.
Outcome trace_photon(const Scene& scene, const OwnedRoutes& owned,
                     const PhotonTraceSettings& settings, int64_t j, std::vector<Photon>& photons) {
  // All passes together run through one sequence; the seed changes when its 32 bits are used up.
  const uint64_t number =
      static_cast<uint64_t>(settings.key.pass) * static_cast<uint64_t>(settings.photons_per_pass) +
      static_cast<uint64_t>(j);
  const SobolPoint point(static_cast<uint32_t>(number), kStratifiedDimensions);
  PathSampler sampler(point, hash_combine(settings.key.seed, kStream, number >> 32));
  const auto emitted = emit(scene, *settings.guide, settings.lambda, settings.time, sampler);
  if (!emitted) return {};
  Walk walk = walk_from(*emitted, settings.lambda, settings.specular_alpha, kEmissionDimensions);
  PhotonVisitor visitor(owned, *emitted, photons);
  random_walk(scene, TransportMode::kImportance, settings.max_events, walk, sampler, visitor);
  return {visitor.useful(),
          visitor.specular(),
          walk.rays,
          {emitted->light, visitor.first_hit(), emitted->weight}};
}

}  // namespace

PhotonTrace trace_photons(const Scene& scene, const OwnedRoutes& owned,
                          const PhotonTraceSettings& settings, int64_t begin, int64_t end) {
  struct Chunk {
    std::vector<Photon> photons;
    uint64_t useful = 0, specular = 0, rays = 0;
  };
  std::vector<Chunk> chunks(static_cast<size_t>(chunk_count(end - begin, kPhotonChunk)));
  parallel_chunks(end - begin, kPhotonChunk, [&](int64_t c, int64_t b, int64_t e) {
    Chunk& chunk = chunks[static_cast<size_t>(c)];
    for (int64_t j = begin + b; j < begin + e; ++j) {
      const Outcome outcome = trace_photon(scene, owned, settings, j, chunk.photons);
      chunk.useful += outcome.useful;
      chunk.specular += outcome.specular;
      chunk.rays += outcome.rays;
    }
  });
  PhotonTrace trace;
  trace.paths = static_cast<uint64_t>(end - begin);
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

UsefulStarts trace_useful_starts(const Scene& scene, const OwnedRoutes& owned,
                                 const PhotonTraceSettings& settings, int64_t begin, int64_t end,
                                 const std::function<bool(const Photon&)>& is_useful) {
  std::vector<UsefulStarts> chunks(static_cast<size_t>(chunk_count(end - begin, kPhotonChunk)));
  parallel_chunks(end - begin, kPhotonChunk, [&](int64_t c, int64_t b, int64_t e) {
    UsefulStarts& chunk = chunks[static_cast<size_t>(c)];
    std::vector<Photon> photons;
    for (int64_t j = begin + b; j < begin + e; ++j) {
      photons.clear();
      const Outcome outcome = trace_photon(scene, owned, settings, j, photons);
      chunk.rays += outcome.rays;
      if (std::any_of(photons.begin(), photons.end(), is_useful))
        chunk.starts.push_back(outcome.start);
    }
  });
  UsefulStarts all;
  for (const UsefulStarts& chunk : chunks) {
    all.starts.insert(all.starts.end(), chunk.starts.begin(), chunk.starts.end());
    all.rays += chunk.rays;
  }
  return all;
}

namespace {

/// Adds another trace behind the first.
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
    parallel_chunks(static_cast<int64_t>(sets.size()), 1, [&](int64_t s, int64_t, int64_t) {
      PhotonTrace& chunk = chunks[static_cast<size_t>(s)];
      chunk = trace_photons(scene, owned, sets[static_cast<size_t>(s)], begin, end);
      for (Photon& photon : chunk.photons) photon.set = static_cast<uint8_t>(s);
    });
    for (PhotonTrace& chunk : chunks) append(std::move(chunk), map.trace);
    map.paths_of_set = end;
  }
  return map;
}

}  // namespace nephroid
