#include "integrator/virtual_lights/point_lights.h"

#include <algorithm>

#include "input/option_values.h"
#include "integrator/estimator/reach.h"
#include "integrator/estimator/slice_loop.h"
#include "integrator/path/path_visitor.h"
#include "integrator/virtual_lights/point_light_pool.h"
#include "transport/camera_connection.h"
#include "transport/roughness_band.h"

namespace nephroid {

namespace {

constexpr uint64_t kPointLightStream = 0x706f696e74;  // "point"
constexpr uint64_t kPointLightLearning = 0x70ea2;     // stream of the learning set
constexpr int kDefaultConnections = 32;               // connections per pixel and pass
constexpr int64_t kPathsPerConnection = 64;  // light paths per connection, over a pass's samples
constexpr int64_t kLearningPaths = 1024;
constexpr int kConnectionDimensions = 1 << 20;  // beyond the walks' dimensions; numbers are random

int connections_of(const IntegratorOptions& options) {
  const int asked = options.own<PointLightsOptions>().connections;
  return asked > 0 ? asked : kDefaultConnections;
}

/// p_A of [L1]: density per area at `p` (normal `ng`) of a walk that left `from` with `pdf_w`.
float density_per_area(const Vec3f& from, float pdf_w, const Vec3f& p, const Vec3f& ng) {
  const Vec3f way = p - from;
  const float d2 = dot(way, way);
  return pdf_w * std::abs(dot(way, ng)) / (d2 * std::sqrt(d2));
}

/// Path tracing that leaves point lights their share of the light between its first rough vertex
/// and a rough vertex that follows at once.
class PointLightsVisitor : public PathVisitorOf<PointLightsVisitor> {
 public:
  struct Pass {
    const PointLightPool& pool;
    int connections = 0;
    float density = 0;
    int max_depth = 0;
  };

  PointLightsVisitor(const Scene& scene, const OwnedRoutes& owned, const Pass& pass,
                     PartSums& light)
      : PathVisitorOf(scene, owned, false, light, nullptr), pass_(pass) {}

  float share() const { return share_; }
  float share_after(EventClass c) const { return share_ * (is_rough(c) ? rough_share_ : 1.0f); }

  void vertex(const Walk& walk, const WalkVertex& v, PathSampler& sampler) {
    // No point light is at the exit of a path that went under a surface.
    rough_share_ = 1.0f;
    if (stage_ == Stage::kFirstRough && v.merges && !v.subsurface_exit)
      rough_share_ =
          1.0f - point_light_share(pass_.density, density_per_area(walk.previous_p, walk.pdf_w,
                                                                   v.surface.p, v.surface.ng));
    PathVisitorOf::vertex(walk, v, sampler);
    if (stage_ == Stage::kBefore && pass_.pool.size() > 0) connect(walk, v, sampler);
  }

  bool scatter(const Walk& walk, const WalkEvent& event) {
    const bool rough = is_rough(event.letter);
    if (stage_ == Stage::kFirstRough && rough) share_ *= rough_share_;
    if (stage_ == Stage::kFirstRough)
      stage_ = Stage::kBehind;
    else if (stage_ == Stage::kBefore && rough)
      stage_ = Stage::kFirstRough;
    return PathVisitorOf::scatter(walk, event);
  }

 private:
  enum class Stage : uint8_t { kBefore, kFirstRough, kBehind };
  static bool is_rough(EventClass c) { return contains(ClassMask::kRough, c); }

  void connect(const Walk& walk, const WalkVertex& v, PathSampler& sampler) {
    if (!v.merges) return;
    const ClassMask among = v.useful_classes();
    const ClassMask classes = v.bsdf.finite_classes() & among & ClassMask::kRough;
    if (classes == ClassMask::kNone) return;
    sampler.start_dimension(kConnectionDimensions);
    const float u = sampler.get_1d();
    for (int k = 0; k < pass_.connections; ++k) {
      sampler.start_dimension(kConnectionDimensions + 1 + k);
      connect(walk, v, classes, among, pass_.pool.choose(k, pass_.connections, u), sampler);
    }
  }

  // [L2], for each pair of classes c at x and d at y.
  void connect(const Walk& walk, const WalkVertex& x, ClassMask classes, ClassMask among,
               const ChosenLight& chosen, const PathSampler& sampler) {
    const PointLight& y = *chosen.light;
    if (walk.events + y.events + 2 > pass_.max_depth) return;
    if (are_apart(walk.lambda.left(), y.left)) return;
    const Vec3f way = y.surface.p - x.surface.p;
    const float d2 = dot(way, way);
    if (!(d2 > 0.0f)) return;
    const Vec3f w = way / std::sqrt(d2);
    const Vec3f wi = x.to_local(w), to_x = y.surface.shading.to_local(-w);
    const float cosine = light_side_cosine(y.surface, y.wo, w, false);
    if (!std::isfinite(cosine)) return;
    const float geometry = abs_cos_theta(wi) * cosine / d2 * chosen.factor;
    const Label label = symbols_.material(y.material->index());
    SampledSpectrum arriving;
    bool traced = false;
    for (const EventClass c : {EventClass::kDiffuse, EventClass::kGlossy}) {
      if (!contains(classes, c)) continue;
      const EyeState eye = routes_.next(eye_, symbol_at(symbols_, x, c, wi));
      const BsdfEval at_x = x.bsdf.eval(x.wo, wi, TransportMode::kRadiance, c, among);
      if (at_x.f.is_black()) continue;
      const float share =
          y.only_from_light
              ? 1.0f
              : point_light_share(pass_.density, density_per_area(x.surface.p, at_x.pdf_w,
                                                                  y.surface.p, y.surface.ng));
      for (const EventClass d : {EventClass::kDiffuse, EventClass::kGlossy}) {
        const Part part = routes_.meet(
            eye, routes_.light_next(y.state, event_symbol(d, y.wo.z * to_x.z < 0.0f, label)));
        if (!light_.owns(part)) continue;
        const BsdfEval at_y =
            y.bsdf->eval(y.wo, to_x, TransportMode::kImportance, d, ClassMask::kAll);
        if (at_y.f.is_black()) continue;
        if (!traced) arriving = walk.throughput * y.flux * seen(walk, x, y, w, sampler);
        traced = true;
        if (arriving.is_black()) return;
        const SampledSpectrum found = arriving * at_x.f * at_y.f * (geometry * share);
        light_.add(part, merged_spectrum(found, walk.lambda.left(), y.left));
      }
    }
  }

  SampledSpectrum seen(const Walk& walk, const WalkVertex& x, const PointLight& y, const Vec3f& w,
                       const PathSampler& sampler) {
    ++shadow_rays_;
    return attenuation_between(scene_, x.surface.spawn_origin(w), y.surface.spawn_origin(-w),
                               walk.ray.time, medium_towards(x.surface, w, walk.medium),
                               walk.lambda, sampler);
  }

  const Pass& pass_;
  Stage stage_ = Stage::kBefore;
  float share_ = 1;        ///< 1 - s of [L2]: the walk's share of the path so far
  float rough_share_ = 1;  ///< the walk's share for an event of class D or G at this vertex
};

/// ρ of [L3], the density of point lights per area.
class LearnedDensity final : public Learned {
 public:
  LearnedDensity(float density, uint64_t rays) : density_(density), rays_(rays) {}
  float density() const { return density_; }
  void write(ByteWriter& to) const override { to(density_, rays_); }
  void add_to(EstimatorStatistics& s) const override {
    s.rays += rays_;
    s.learning_rays += rays_;
  }

 private:
  float density_;
  uint64_t rays_;
};

const EstimatorSetting kPointLightsSetting = {
    "point-lights",
    "N",
    "0",
    "connections",
    "Virtual point lights that a camera path is connected to. Up to 1024; 0 lets the integrator "
    "choose.",
    [](IntegratorOptions& options, const std::string& text) {
      options.edit<PointLightsOptions>().connections = parse_int("-D point-lights", text, 0, 1024);
    },
    [](const IntegratorOptions& options) {
      return std::to_string(options.own<PointLightsOptions>().connections);
    }};

constexpr const EstimatorSetting* kPointLightSettings[] = {&kPointLightsSetting};

}  // namespace

float point_light_share(float density, float walk_pdf_a) {
  if (!(walk_pdf_a > density)) return density > 0.0f ? 1.0f : 0.0f;
  return density / walk_pdf_a;
}

constinit const EstimatorDescriptor PointLights::kDescriptor = {
    .traits = {.name = "pointlights",
               .help = "path tracing that is connected to virtual point lights at its first rough "
                       "surface",
               .starts_at_lights = true,
               .why_never_sampled =
                   [](const PathSummary& path) {
                     return path.events.first_pair == FirstRoughPair::kBoth
                                ? nullptr
                                : out_of_reach_of_eye_walks(path);
                   }},
    .settings = kPointLightSettings,
    .keeps_photons = true,
    .make = make_estimator<PointLights>,
};

PointLights::PointLights(OwnedRoutes owned, const IntegratorOptions& options)
    : owned_(std::move(owned)), options_(options) {}

std::shared_ptr<const Learned> PointLights::learn(const Scene& scene, const FilmFormat& film,
                                                  uint64_t seed, PassControl& control) const {
  PhotonPass pass = start_photon_pass({hash_combine(seed, kPointLightLearning), 0}, scene, film,
                                      options_, control);
  pass.trace.photons_per_pass = kLearningPaths;
  const PointLightPool pool(scene, owned_, pass.trace,
                            point_lights_in_memory_of(options_.memory_photons));
  std::vector<float> distances;
  const size_t half = pool.size() / 2;
  for (size_t i = 0; i < half; ++i) {
    const Vec3f way = pool[i].surface.p - pool[i + half].surface.p;
    distances.push_back(dot(way, way));
  }
  float density = 0;
  if (!distances.empty()) {
    const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
    std::nth_element(distances.begin(), middle, distances.end());
    if (*middle > 0.0f)
      density = static_cast<float>(connections_of(options_)) / (2.0f * kPi * *middle);
  }
  return std::make_shared<LearnedDensity>(density, pool.rays());
}

std::shared_ptr<const Learned> PointLights::read_learned(ByteReader& from,
                                                         const FilmFormat&) const {
  float density = 0;
  uint64_t rays = 0;
  from(density, rays);
  expect_sound(density >= 0);
  return std::make_shared<LearnedDensity>(density, rays);
}

void PointLights::render_pass(const PassKey& key, const Learned* learned, const Scene& scene,
                              Film& film, PassControl& control) {
  const float density = static_cast<const LearnedDensity*>(learned)->density();
  const int samples = std::max(1, options_.camera_samples_per_pass);
  // Each sample of the pixels has its own wavelengths, time and point lights. The roughness
  // threshold is the pass's.
  const float specular_alpha = specular_alpha_of_pass(scene.specular_band, key);
  for (int k = 0; k < samples; ++k) {
    // Light that is on the film cannot be removed, so only the first sample may be stopped.
    PassControl& of_sample = k == 0 ? control : unwatched;
    const uint64_t index = uint64_t{key.pass} * samples + k;
    const uint64_t turn = index >> 32;
    const PassKey own{turn == 0 ? key.seed : hash_combine(key.seed, turn),
                      static_cast<uint32_t>(index)};
    PhotonPass pass = start_photon_pass(own, scene, film.format(), options_, of_sample);
    pass.trace.specular_alpha = specular_alpha;
    pass.trace.photons_per_pass =
        std::max<int64_t>(1, connections_of(options_) * kPathsPerConnection / samples);
    render_sample(pass, density, scene, film);
  }
}

void PointLights::render_sample(const PhotonPass& pass, float density, const Scene& scene,
                                Film& film) {
  const PixelBounds& b = film.bounds();
  const int group = static_cast<int>(owned_.group);
  const PassKey& key = pass.trace.key;
  const PointLightPool pool(scene, owned_, pass.trace,
                            point_lights_in_memory_of(options_.memory_photons));
  const PointLightsVisitor::Pass shared{pool, connections_of(options_), density,
                                        options_.max_depth};
  const auto render_slice = [&](uint64_t& rays, const PixelSlices::Run& run) {
    PartSums light(*owned_.routes, owned_.group);
    for (int i = 0; i < run.count; ++i) {
      const int x = run.x + i * run.step, y = run.y;
      PathSampler sampler(pass.point, hash_combine(key.seed, kPointLightStream, x, y));
      CameraPath path = start_merging_path(scene, x, y, sampler, pass);
      light.clear();
      PointLightsVisitor visitor(scene, owned_, shared, light);
      if (path.camera_weight > 0)
        random_walk(scene, TransportMode::kRadiance, options_.max_depth, path.walk, sampler,
                    visitor);
      film.add(group, x, y,
               light.colors(pass.weights, path.camera_weight, film.settings().max_component,
                            path.filter_weight));
      rays += path.walk.rays + visitor.more_rays();
    }
  };
  SlicesOfPass{.film = film, .group = group}.render<uint64_t>(
      *pass.trace.control, render_slice, [&](uint64_t&& rays) { statistics_.rays += rays; });
  statistics_.rays += pool.rays();
  statistics_.camera_paths += b.area();
  statistics_.photon_paths += pass.trace.photons_per_pass;
  statistics_.photon_paths_useful += pool.useful_paths();
  statistics_.photons_stored += pool.size();
  statistics_.hold(pool.bytes(), 0);
}

}  // namespace nephroid
