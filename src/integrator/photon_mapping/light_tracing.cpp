#include "integrator/photon_mapping/light_tracing.h"

#include <vector>

#include "core/errors.h"
#include "core/parallel.h"
#include "film/part_sums.h"
#include "film/splats.h"
#include "integrator/photons/photon_pass.h"
#include "photon/light_walk.h"
#include "transport/camera_connection.h"
#include "transport/camera_path.h"

namespace nephroid {

namespace {

// Dimensions between those of a light path's start and those of its vertices.
constexpr int kStartLens = kLightPathStartDimensions;  // 2
constexpr int kFirstVertex = kStartLens + 2;
constexpr uint64_t kStream = 0x6c69676874;  // "light"

/// Light paths are traced in chunks of this many, and their splats added in groups of chunks.
constexpr int64_t kChunk = 1024;
constexpr int64_t kGroup = 64 * kChunk;

/// What the light paths of a pass share.
struct LightPass {
  const Scene& scene;
  const OwnedRoutes& owned;
  const FilmSettings& film;
  const CameraView view;
  const PartSums places;  ///< tells which parts are owned, and their places
  PassKey key;
  int64_t paths = 0;
  float specular_alpha = 0;
  int max_depth = 0;
  const ConnectionWeight& weight;
};

struct Chunk {
  std::vector<Splat> splats;
  uint64_t rays = 0, useful = 0;
};

// Connects one light path to the camera.
class ConnectingVisitor : public LightWalkVisitor {
 public:
  ConnectingVisitor(const LightPass& pass, const LightPathStart& start, Chunk& out)
      : LightWalkVisitor(pass.owned, start.emission),
        pass_(pass),
        flux_(start.emission.flux),
        u_time_(start.u_time),
        out_(out) {}

  ClassMask useful(const WalkVertex& v) const {
    return routes_.useful_before_connection(group_, state_, label_at(symbols_, v));
  }
  bool scatters_in(const Medium& medium) const {
    const Label label = symbols_.medium(medium.index());
    return contains(routes_.useful_before_connection(group_, state_, label) |
                        routes_.connects(group_, state_, label),
                    EventClass::kVolume);
  }
  bool looks_under_surfaces() const { return true; }

  /// The start point itself: the word `C l`.
  void start(const Walk& walk, const Emission& emission, PathSampler& sampler) {
    const EmissionSample& e = emission.start;
    const Part part = routes_.owner(routes_.start(), symbols_.light(emission.light));
    if (pass_.weight || !pass_.places.owns(part) || !(e.coverage > 0.0f)) return;
    const auto seen = pass_.view.connect(e.p, sampler.get_2d(), u_time_);
    if (!seen) return;
    const Vec3f& w = seen->line.wi;
    const Light& light = *pass_.scene.lights[static_cast<size_t>(emission.light)];
    const SampledSpectrum radiance = light.radiance(e.p, e.ng, e.uv, w, walk.lambda);
    if (radiance.is_black()) return;
    const Medium* medium = nullptr;
    if (!pass_.scene.light_media.empty()) {
      const MediumInterface& media = pass_.scene.light_media[static_cast<size_t>(emission.light)];
      medium = dot(w, e.ng) > 0.0f ? media.outside : media.inside;
    }
    const SampledSpectrum through =
        arrives(*seen, offset_ray_origin(e.p, e.p_error, e.ng, w), walk, medium, sampler);
    expose(*seen, part, radiance * through * (e.coverage * abs_dot(w, e.ng) / emission.pdf_start),
           walk);
  }

  void vertex(const Walk& walk, const WalkVertex& v, PathSampler& sampler) {
    if (pass_.weight && v.subsurface_exit) return;
    const ClassMask classes =
        v.classes_of(routes_.connects(group_, state_, label_at(symbols_, v))) &
        v.bsdf.finite_classes();
    if (classes == ClassMask::kNone) return;
    const auto seen = pass_.view.connect(v.surface.p, sampler.get_2d(), u_time_);
    if (!seen) return;
    const Vec3f& w = seen->line.wi;
    const Vec3f wi = v.to_local(w);
    // Veach's correction for shading normals [P2]; where light comes out from under the surface it
    // has been brought there by area.
    const float cosine =
        abs_dot(w, v.surface.ng) *
        (v.subsurface_exit ? 1.0f : abs_cos_theta(v.wo) / abs_dot(v.surface.wo, v.surface.ng));
    if (!std::isfinite(cosine)) return;
    const float weight = pass_.weight ? pass_.weight(seen->line, v) : 1.0f;
    SampledSpectrum through;
    bool traced = false;
    for (const EventClass c : kSurfaceClasses) {
      if (!contains(classes, c)) continue;
      const EventSymbol event = symbol_at(symbols_, v, c, wi);
      const Part part = routes_.meet(pass_.weight ? routes_.merge(routes_.start(), event)
                                                  : routes_.next(routes_.start(), event),
                                     state_);
      if (!pass_.places.owns(part)) continue;
      const BsdfEval e = v.bsdf.eval(v.wo, wi, TransportMode::kImportance, c, ClassMask::kAll);
      if (e.f.is_black()) continue;
      if (!traced)
        through = arrives(*seen, v.surface.spawn_origin(w), walk,
                          medium_towards(v.surface, w, walk.medium), sampler);
      traced = true;
      if (through.is_black()) return;
      expose(*seen, part, flux_ * walk.throughput * e.f * through * (cosine * weight), walk);
    }
  }

  void medium_vertex(const Walk& walk, const MediumVertex& v, PathSampler& sampler) {
    const Part part =
        routes_.meet(routes_.next(routes_.start(), symbol_in(symbols_, v.medium)), state_);
    if (pass_.weight || !pass_.places.owns(part)) return;
    const auto seen = pass_.view.connect(v.p, sampler.get_2d(), u_time_);
    if (!seen) return;
    const SampledSpectrum through = arrives(*seen, v.p, walk, walk.medium, sampler);
    expose(*seen, part, flux_ * walk.throughput * through * v.phase.eval(v.wo, seen->line.wi),
           walk);
  }

  uint64_t rays() const { return rays_; }
  bool useful() const { return exposed_; }

 private:
  SampledSpectrum arrives(const Exposure& seen, const Vec3f& origin, const Walk& walk,
                          const Medium* medium, const PathSampler& sampler) {
    ++rays_;
    return attenuation_to_camera(pass_.scene, origin, walk.ray.time, medium, seen.line, walk.lambda,
                                 sampler);
  }

  /// Flux per solid angle that goes to the lens becomes light on the film.
  void expose(const Exposure& seen, Part part, const SampledSpectrum& intensity, const Walk& walk) {
    if (intensity.is_black()) return;
    exposed_ = true;
    const SensorWeights weights = sensor_weights(
        walk.lambda, *pass_.film.color_space, pass_.film.imaging_ratio, pass_.film.white_balance);
    const Rgb value = weights.apply(intensity) * (seen.line.film_density * seen.line.weight);
    for (int i = 0; i < seen.count; ++i)
      out_.splats.push_back({seen.film[static_cast<size_t>(i)],
                             static_cast<uint8_t>(pass_.places.place(part)), value});
  }

  const LightPass& pass_;
  const SampledSpectrum flux_;
  const float u_time_;
  Chunk& out_;
  uint64_t rays_ = 0;
  bool exposed_ = false;
};

void trace_light_path(const LightPass& pass, uint64_t number, Chunk& out) {
  // All passes together run through one sequence; the seed changes when its 32 bits are used up.
  const SobolPoint point(static_cast<uint32_t>(number), kLightPathPointDimensions);
  PathSampler sampler(point, hash_combine(pass.key.seed, kStream, number >> 32));
  const std::optional<LightPathStart> start = start_light_path(pass.scene, sampler);
  if (!start) return;
  Walk walk = walk_from(start->emission, start->lambda, pass.specular_alpha, kFirstVertex);
  ConnectingVisitor visitor(pass, *start, out);
  sampler.start_dimension(kStartLens);
  visitor.start(walk, start->emission, sampler);
  random_walk(pass.scene, TransportMode::kImportance, pass.max_depth, walk, sampler, visitor);
  out.rays += walk.rays + visitor.rays();
  out.useful += visitor.useful();
}

}  // namespace

void require_connecting_camera(const Scene& scene) {
  if (!scene.camera->connects())
    throw UsageError(
        "light tracing cannot find its way through the lenses of this camera, expected routes "
        "without lighttrace and photons+light, or another camera");
}

LightTracing::LightTracing(OwnedRoutes owned, const IntegratorOptions& options)
    : owned_(std::move(owned)), options_(options) {}

int64_t light_pass(const PassKey& key, const Scene& scene, const Film& film,
                   const OwnedRoutes& owned, const IntegratorOptions& options,
                   const ConnectionWeight& weight, SplatBuffer& buffer,
                   EstimatorStatistics& statistics) {
  const PhotonPass settings = start_photon_pass(key, scene, film.format(), options);
  const LightPass pass{scene,
                       owned,
                       film.settings(),
                       CameraView(scene, film.bounds()),
                       PartSums(*owned.routes, owned.group),
                       key,
                       settings.trace.photons_per_pass,
                       settings.trace.specular_alpha,
                       options.max_depth,
                       weight};
  const uint64_t first = uint64_t{key.pass} * static_cast<uint64_t>(pass.paths);
  for (int64_t begin = 0; begin < pass.paths; begin += kGroup) {
    const int64_t count = std::min(kGroup, pass.paths - begin);
    std::vector<Chunk> chunks(static_cast<size_t>(chunk_count(count, kChunk)));
    parallel_chunks(count, kChunk, [&](int64_t c, int64_t b, int64_t e) {
      for (int64_t j = b; j < e; ++j)
        trace_light_path(pass, first + static_cast<uint64_t>(begin + j),
                         chunks[static_cast<size_t>(c)]);
    });
    std::vector<Splat> found;
    for (const Chunk& chunk : chunks) {
      found.insert(found.end(), chunk.splats.begin(), chunk.splats.end());
      statistics.rays += chunk.rays;
      statistics.light_paths_useful += chunk.useful;
    }
    buffer.add(found);
    statistics.splats += found.size();
  }
  statistics.light_paths += static_cast<uint64_t>(pass.paths);
  return pass.paths;
}

std::unique_ptr<PassFindings> LightTracing::render_pass(const PassKey& key, const Learned*,
                                                        const Scene& scene, Film& film) {
  const int group = static_cast<int>(owned_.group);
  SplatBuffer buffer(film, group, *scene.filter);
  statistics_.hold(0, static_cast<uint64_t>(film.bounds().area()) *
                          SplatBuffer::bytes_per_pixel(film.parts_of(group).size()));
  const int64_t paths = light_pass(key, scene, film, owned_, options_, {}, buffer, statistics_);
  buffer.finish(1.0 / static_cast<double>(paths));
  film.add_estimates(group, 1);
  return nullptr;
}

EstimatorStatistics LightTracing::statistics() const {
  EstimatorStatistics s = statistics_;
  if (s.splats == 0 && s.light_paths > 0)
    s.notes.push_back("none of " + std::to_string(s.light_paths) +
                      " light paths had a point of its routes that the camera sees");
  return s;
}

}  // namespace nephroid
