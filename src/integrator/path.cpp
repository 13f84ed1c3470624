#include "integrator/path.h"

#include <vector>

#include "core/parallel.h"
#include "core/warps.h"
#include "transport/camera_path.h"
#include "transport/direct_light.h"

namespace nephroid {

namespace {

struct Features {
  Vec3f normal{0, 0, 0};
  float depth = 0;
};

// Collects the light of one camera path.
class PathVisitor {
 public:
  PathVisitor(const Scene& scene, const Routes& routes, Route route)
      : scene_(scene), routes_(routes), route_(route) {}

  void escape(const Walk& walk) {
    if (routes_.owner(state_) != route_) return;
    for (const int i : scene_.light_sampler->infinite_lights()) {
      const Light& light = *scene_.lights[static_cast<size_t>(i)];
      const SampledSpectrum le = light.radiance_at_infinity(walk.ray.d, walk.lambda);
      if (le.is_black()) continue;
      const float w =
          walk.delta ? 1.0f : power_heuristic(walk.pdf_w, direct_pdf_w(scene_, walk, i));
      radiance_ += walk.throughput * le * w;
    }
  }

  void emitter(const Walk& walk, const SurfaceInteraction& hit, const Light& light) {
    if (routes_.owner(state_) != route_) return;
    const SampledSpectrum le = light.radiance(hit.p, hit.ng, hit.uv, hit.wo, walk.lambda);
    if (le.is_black()) return;
    const float w =
        walk.delta ? 1.0f : power_heuristic(walk.pdf_w, direct_pdf_w(scene_, walk, hit));
    radiance_ += walk.throughput * le * w;
  }

  ClassMask vertex(const Walk& walk, const WalkVertex& v, PathSampler& sampler) {
    if (walk.vertices == 0) record_features(walk, v);
    const ClassMask useful = routes_.useful_eye_events(state_, route_);
    const ClassMask finite = v.bsdf.finite_classes() & useful;
    if (owns_any(finite)) next_event(walk, v, finite, useful, sampler);
    return useful;
  }

  bool scatter(const Walk&, const BsdfSample& s) {
    state_ = routes_.next(state_, s.event);
    return true;
  }

  const SampledSpectrum& radiance() const { return radiance_; }
  const Features& features() const { return features_; }
  const SampledSpectrum& albedo() const { return albedo_; }
  uint64_t shadow_rays() const { return shadow_rays_; }

 private:
  static constexpr EventClass kClasses[] = {EventClass::kDiffuse, EventClass::kSpecular};

  bool owns(EventClass c) const { return routes_.owner(routes_.next(state_, c)) == route_; }
  bool owns_any(ClassMask finite) const {
    for (const EventClass c : kClasses)
      if (contains(finite, c) && owns(c)) return true;
    return false;
  }

  void next_event(const Walk& walk, const WalkVertex& v, ClassMask finite, ClassMask among,
                  PathSampler& sampler) {
    const std::optional<DirectSample> d = sample_direct(scene_, v.surface, walk.lambda, sampler);
    if (!d) return;
    SampledSpectrum sum;
    for (const EventClass c : kClasses) {
      if (!contains(finite, c) || !owns(c)) continue;
      const BsdfEval e = v.bsdf.eval(v.wo, d->wi, TransportMode::kRadiance, c, among);
      sum += e.f * (d->delta ? 1.0f : power_heuristic(d->pdf_w, e.pdf_w));
    }
    if (sum.is_black()) return;
    ++shadow_rays_;
    const SampledSpectrum through = scene_.transmittance(d->shadow_ray, walk.lambda);
    if (through.is_black()) return;
    radiance_ += walk.throughput * sum * d->radiance * through * abs_cos_theta(d->wi);
  }

  void record_features(const Walk& walk, const WalkVertex& v) {
    albedo_ = v.bsdf.albedo(v.wo);
    features_.normal = v.surface.shading.z;
    features_.depth = walk.length;
  }

  const Scene& scene_;
  const Routes& routes_;
  const Route route_;
  EyeState state_ = Routes::kEyeStart;
  SampledSpectrum radiance_;
  Features features_;
  SampledSpectrum albedo_;
  uint64_t shadow_rays_ = 0;
};

// The film's response to a flat spectrum of 1, on average over the wavelengths of a path.
Rgb response_to_white(const FilmSettings& settings) {
  const Rgb white = settings.color_space->from_xyz({1, 1, 1});
  return white * (kCieYIntegral * settings.imaging_ratio);
}

Rgb of_white(const Rgb& rgb, const Rgb& white) {
  return {rgb.r / white.r, rgb.g / white.g, rgb.b / white.b};
}

constexpr uint64_t kStream = 0x70617468;  // "path"

}  // namespace

PathEstimator::PathEstimator(const Routes& routes, Route route, int buffer,
                             const IntegratorOptions& options)
    : routes_(routes),
      route_(route),
      buffer_(buffer),
      max_depth_(options.max_depth),
      samples_per_pass_(std::max(1, options.camera_samples_per_pass)) {}

void PathEstimator::render_pass(const PassKey& key, const Scene& scene, Film& film) {
  const PixelBounds& b = film.bounds();
  const FilmSettings& settings = film.settings();
  const Rgb white = response_to_white(settings);
  std::vector<uint64_t> rays(static_cast<size_t>(b.height()), 0);
  for (int k = 0; k < samples_per_pass_; ++k) {
    const uint64_t index =
        uint64_t{key.pass} * static_cast<uint64_t>(samples_per_pass_) + static_cast<uint64_t>(k);
    const SobolPoint point(static_cast<uint32_t>(index));
    parallel_chunks(b.height(), 1, [&](int64_t row, int64_t, int64_t) {
      const int y = b.y0 + static_cast<int>(row);
      for (int x = b.x0; x < b.x1; ++x) {
        PathSampler sampler(point, hash_combine(key.seed, kStream, x, y, index >> 32));
        sampler.start_dimension(dimensions::kWavelength);
        const SampledWavelengths lambda = SampledWavelengths::sample_visible(sampler.get_1d());
        sampler.start_dimension(dimensions::kTime);
        CameraPath path = start_camera_path(scene, x, y, sampler, lambda, sampler.get_1d());
        PathVisitor visitor(scene, routes_, route_);
        random_walk(scene, TransportMode::kRadiance, max_depth_, path.walk, sampler, visitor);
        const SensorWeights weights =
            sensor_weights(path.walk.lambda, *settings.color_space, settings.imaging_ratio);
        const Rgb rgb = clamp_component(weights.apply(visitor.radiance()), settings.max_component);
        film.add(buffer_, x, y, rgb * path.filter_weight);
        film.add_features(x, y, of_white(weights.apply(visitor.albedo()), white),
                          visitor.features().normal, visitor.features().depth);
        rays[static_cast<size_t>(row)] += path.walk.rays + visitor.shadow_rays();
      }
    });
    film.add_estimates(buffer_, 1);
    film.add_feature_estimates(1);
  }
  for (const uint64_t r : rays) statistics_.rays += r;
  statistics_.camera_paths += static_cast<uint64_t>(b.area()) * samples_per_pass_;
}

}  // namespace nephroid
