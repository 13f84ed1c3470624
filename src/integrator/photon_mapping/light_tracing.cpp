#include "integrator/photon_mapping/light_tracing.h"

#include <vector>

#include "core/counted.h"
#include "core/errors.h"
#include "core/parallel.h"
#include "film/part_sums.h"
#include "film/splats.h"
#include "integrator/estimator/exposed_pixels.h"
#include "integrator/photons/photon_pass.h"
#include "photon/light_walk.h"
#include "transport/camera_connection.h"
#include "transport/camera_path.h"

namespace nephroid {

namespace {

// Dimensions between those of the path's start and those of its vertices.
constexpr int kStartLens = kLightPathStartDimensions;  // 2
constexpr int kFirstVertex = kStartLens + 2;
constexpr uint64_t kLightTracingStream = 0x6c69676874;  // "light"

/// Light paths per chunk. Splats are added to the buffer once per group of chunks.
constexpr int64_t kTracingChunk = 1024;
constexpr int64_t kTracingGroup = 64 * kTracingChunk;

/// Settings shared by the light paths of a pass.
struct LightPass {
  const Scene& scene;
  const OwnedRoutes& owned;
  const FilmSettings& film;
  const CameraView view;
  const PartSums places;  ///< owned parts and their places
  PassKey key;
  int64_t paths = 0;
  float specular_alpha = 0;
  int max_depth = 0;
  const ConnectionWeight& weight;
};

struct TracingChunk {
  std::vector<Splat> splats;
  uint64_t rays = 0, useful = 0;
};

// Connects one light path to the camera.
class ConnectingVisitor : public LightWalkVisitor {
 public:
  ConnectingVisitor(const LightPass& pass, const Emission& emission, float u_time,
                    TracingChunk& out)
      : LightWalkVisitor(pass.owned, emission),
        pass_(pass),
        flux_(emission.flux),
        camera_(pass.scene, pass.view, u_time),
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

  /// Connects the start point itself: the word `C L`.
  void start(const Walk& walk, const Emission& emission, PathSampler& sampler) {
    sampler.start_dimension(kStartLens);
    const EmissionSample& e = emission.start;
    const Part part = routes_.owner(routes_.start(), symbols_.light(emission.light));
    if (pass_.weight || !pass_.places.owns(part) || !(e.coverage > 0.0f)) return;
    const auto seen = pass_.view.connect(e.p, sampler.get_2d(), camera_.u_time());
    if (!seen) return;
    const Vec3f& w = seen->line.wi;
    const Light& light = *pass_.scene.lights[emission.light];
    const SampledSpectrum radiance = light.radiance(e.p, e.ng, e.uv, w, walk.lambda);
    if (radiance.is_black()) return;
    const Medium* medium = nullptr;
    if (!pass_.scene.light_media.empty()) {
      const MediumInterface& media = pass_.scene.light_media[emission.light];
      medium = dot(w, e.ng) > 0.0f ? media.outside : media.inside;
    }
    const SampledSpectrum through =
        camera_.arrives(*seen, offset_ray_origin(e.p, e.p_error, e.ng, w), walk, medium, sampler);
    splat(*seen, part, radiance * through * (e.coverage * abs_dot(w, e.ng) / emission.pdf_start),
          walk);
  }

  void vertex(const Walk& walk, const WalkVertex& v, PathSampler& sampler) {
    if (pass_.weight && v.subsurface_exit) return;
    const ClassMask classes =
        v.classes_of(routes_.connects(group_, state_, label_at(symbols_, v))) &
        v.bsdf.finite_classes();
    if (classes == ClassMask::kNone) return;
    const auto part_of = [&](EventClass c, const Vec3f& wi) {
      const EventSymbol event = symbol_at(symbols_, v, c, wi);
      const Part part = routes_.meet(pass_.weight ? routes_.merge(routes_.start(), event)
                                                  : routes_.next(routes_.start(), event),
                                     state_);
      return pass_.places.owns(part) ? part : kNoPart;
    };
    camera_.connect(walk, v, classes, sampler, part_of, [&](const CameraEvent& event) {
      const float weight = pass_.weight ? pass_.weight(event.seen.line, v) : 1.0f;
      splat(event.seen, event.part,
            flux_ * walk.throughput * event.f * event.through * (event.cosine * weight), walk);
    });
  }

  void medium_vertex(const Walk& walk, const MediumVertex& v, PathSampler& sampler) {
    const Part part =
        routes_.meet(routes_.next(routes_.start(), symbol_in(symbols_, v.medium)), state_);
    if (pass_.weight || !pass_.places.owns(part)) return;
    camera_.connect(walk, v, sampler,
                    [&](const LensConnection& seen, const SampledSpectrum& through, float phase) {
                      splat(seen, part, flux_ * walk.throughput * through * phase, walk);
                    });
  }

  uint64_t rays() const { return camera_.rays(); }
  bool is_seen() const { return is_seen_; }

 private:
  /// Splats the intensity (flux per solid angle) that goes to the lens.
  void splat(const LensConnection& seen, Part part, const SampledSpectrum& intensity,
             const Walk& walk) {
    if (intensity.is_black()) return;
    is_seen_ = true;
    const SensorWeights weights = sensor_weights(
        walk.lambda, *pass_.film.color_space, pass_.film.imaging_ratio, pass_.film.white_balance);
    const Rgb value = weights.apply(intensity) * (seen.line.film_density * seen.line.weight);
    for (int i = 0; i < seen.count; ++i)
      out_.splats.push_back({seen.film[i], static_cast<uint8_t>(pass_.places.place(part)), value});
  }

  const LightPass& pass_;
  const SampledSpectrum flux_;
  CameraConnector camera_;
  TracingChunk& out_;
  bool is_seen_ = false;
};

void trace_light_path(const LightPass& pass, uint64_t number, TracingChunk& out) {
  const LightPathSequence sequence{hash_combine(pass.key.seed, kLightTracingStream)};
  const LightPathLaunch launch{
      .scene = pass.scene, .specular_alpha = pass.specular_alpha, .max_events = pass.max_depth};
  sequence.at(number, [&](PathSampler& sampler) {
    const LightPathMoment moment = sample_moment(pass.scene, sampler);
    launch_light_path(
        launch, moment.lambda, pass.scene.camera->motion_time(moment.u_time), sampler, kFirstVertex,
        [&](const Emission& emission) {
          return ConnectingVisitor(pass, emission, moment.u_time, out);
        },
        [&](const ConnectingVisitor& visitor, const Walk& walk) {
          out.rays += walk.rays + visitor.rays();
          out.useful += visitor.is_seen();
        });
  });
}

// Only paths that the camera sees through no S, and emitting shapes, can be connected to it.
const char* unseen_by_camera(const PathSummary& path) {
  const EventSummary& events = path.events;
  const bool unseen = events.count > 0
                          ? events.first_specular && (events.any_rough || path.light_can_be_hit())
                          : path.light == LightKind::kEnvironment;
  return unseen ? "only rough surfaces, media and emitting shapes can be connected to the camera"
                : nullptr;
}

}  // namespace

constinit const EstimatorDescriptor LightTracing::kDescriptor = {
    .traits = {.name = "lighttrace",
               .help = "paths from the lights, each vertex of which is connected to the camera",
               .connects = true,
               .starts_at_lights = true,
               .why_never_sampled = unseen_by_camera},
    .bytes_per_pixel =
        [](const PixelMemoryInput& need) {
          return PixelBytes{.of_pass = SplatBuffer::bytes_per_pixel(need.parts)};
        },
    .exposed_pixels = pixels_of_splats,
    .make = make_estimator<LightTracing>,
};

LightTracing::LightTracing(OwnedRoutes owned, const IntegratorOptions& options)
    : owned_(std::move(owned)), options_(options) {}

int64_t light_pass(const PassKey& key, const Scene& scene, const Film& film,
                   const OwnedRoutes& owned, const IntegratorOptions& options,
                   const ConnectionWeight& weight, SplatBuffer& buffer,
                   EstimatorStatistics& statistics, PassControl& control) {
  const PhotonPass settings = start_photon_pass(key, scene, film.format(), options, control);
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
  const uint64_t first = uint64_t{key.pass} * pass.paths;
  for (int64_t begin = 0; begin < pass.paths; begin += kTracingGroup) {
    const int64_t count = std::min(kTracingGroup, pass.paths - begin);
    const auto trace_chunk = [&](TracingChunk& chunk, int64_t b, int64_t e) {
      for (int64_t j = b; j < e; ++j) trace_light_path(pass, first + (begin + j), chunk);
    };
    std::vector<Splat> found;
    ordered_reduce<TracingChunk>(
        control, count, kTracingChunk, trace_chunk, [&](TracingChunk&& chunk) {
          found.insert(found.end(), chunk.splats.begin(), chunk.splats.end());
          statistics.rays += chunk.rays;
          statistics.light_paths_useful += chunk.useful;
        });
    buffer.add(found);
    statistics.splats += found.size();
  }
  statistics.light_paths += pass.paths;
  return pass.paths;
}

void LightTracing::render_pass(const PassKey& key, const Learned*, const Scene& scene, Film& film,
                               PassControl& control) {
  const int group = static_cast<int>(owned_.group);
  SplatBuffer buffer(film, group, *scene.filter);
  statistics_.hold(
      0, film.bounds().area() * SplatBuffer::bytes_per_pixel(film.parts_of(group).size()));
  const int64_t paths =
      light_pass(key, scene, film, owned_, options_, {}, buffer, statistics_, control);
  buffer.finish(1.0 / static_cast<double>(paths));
  film.add_estimates(group, 1);
}

EstimatorStatistics LightTracing::statistics() const {
  EstimatorStatistics s = statistics_;
  if (s.splats == 0 && s.light_paths > 0)
    s.notes.push_back("none of " + counted(s.light_paths, "light path") +
                      " could be connected to the camera along a route of light tracing");
  return s;
}

}  // namespace nephroid
