#include "integrator/path.h"

#include <array>
#include <vector>

#include "core/parallel.h"
#include "core/warps.h"
#include "integrator/surface_sample.h"
#include "transport/camera_path.h"
#include "transport/direct_light.h"

namespace nephroid {

namespace {

struct Features {
  Vec3f normal{0, 0, 0};
  float depth = 0;
  FirstSurface surface;  ///< if the depth is above 0
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
      const SampledSpectrum le =
          light.radiance_at_infinity(walk.previous_p, walk.ray.d, walk.lambda);
      if (le.is_black()) continue;
      radiance_ += walk.throughput * le *
                   (walk.delta ? 1.0f / walk.density.u_mean
                               : weight_of_hit(walk, direct_pdf_w(scene_, walk, i)));
    }
  }

  void emitter(const Walk& walk, const SurfaceInteraction& hit, const Light& light) {
    if (routes_.owner(state_) != route_) return;
    const SampledSpectrum le = light.radiance(hit.p, hit.ng, hit.uv, hit.wo, walk.lambda);
    if (le.is_black()) return;
    radiance_ += walk.throughput * le *
                 (walk.delta ? 1.0f / walk.density.u_mean
                             : weight_of_hit(walk, direct_pdf_w(scene_, walk, hit)));
  }

  void medium_emission(const SampledSpectrum& radiance) {
    if (route_ == Routes::kMediumEmission) radiance_ += radiance;
  }

  ClassMask letters() const { return routes_.useful_eye_events(state_, route_); }
  bool looks_under_surfaces() const { return false; }

  void vertex(const Walk& walk, const WalkVertex& v, PathSampler& sampler) {
    if (walk.vertices == 0) record_features(walk, v);
    const ClassMask useful = v.classes_of(letters());
    const ClassMask finite = v.bsdf.finite_classes() & useful;
    if (owns_any(v, finite)) next_event(walk, v, finite, useful, sampler);
  }

  void medium_vertex(const Walk& walk, const MediumVertex& v, PathSampler& sampler) {
    if (!owns(EventClass::kVolume)) return;
    const auto d = sample_direct(scene_, Receiver::of(v, walk.medium), walk.lambda, sampler);
    if (!d) return;
    ++shadow_rays_;
    const ShadowFlight shadow = trace_shadow(scene_, *d, walk.lambda, sampler);
    if (shadow.transmittance.is_black()) return;
    const float phase = v.phase.eval(v.wo, d->wi_world);
    radiance_ += walk.throughput * d->radiance * shadow.transmittance *
                 (phase * weight_of_direct(walk, *d, shadow, phase));
  }

  bool scatter(const Walk&, EventClass letter) {
    state_ = routes_.next(state_, letter);
    return true;
  }

  const SampledSpectrum& radiance() const { return radiance_; }
  const Features& features() const { return features_; }
  const SampledSpectrum& albedo() const { return albedo_; }
  uint64_t shadow_rays() const { return shadow_rays_; }

 private:
  static constexpr EventClass kClasses[] = {EventClass::kDiffuse, EventClass::kSpecular};

  bool owns(EventClass letter) const {
    return routes_.owner(routes_.next(state_, letter)) == route_;
  }
  bool owns_any(const WalkVertex& v, ClassMask finite) const {
    for (const EventClass c : kClasses)
      if (contains(finite, c) && owns(v.letter(c))) return true;
    return false;
  }

  // Weights of the two techniques that find a light, the spectral average included ([D3], [V5]).
  static float weight_of_hit(const Walk& walk, float direct_pdf) {
    const SpectralDensity& d = walk.density;
    return power_heuristic(walk.pdf_w * d.u_mean, direct_pdf * d.l_mean) / d.u_mean;
  }
  static float weight_of_direct(const Walk& walk, const DirectSample& direct,
                                const ShadowFlight& shadow, float walk_pdf) {
    if (walk.density.plain && shadow.plain)
      return direct.delta ? 1.0f : power_heuristic(direct.pdf_w, walk_pdf);
    SpectralDensity d;
    d.u = walk.density.u * shadow.u;
    d.l = walk.density.u * shadow.l;
    d.take_means(walk.lambda);
    return (direct.delta ? 1.0f : power_heuristic(direct.pdf_w * d.l_mean, walk_pdf * d.u_mean)) /
           d.l_mean;
  }

  void next_event(const Walk& walk, const WalkVertex& v, ClassMask finite, ClassMask among,
                  PathSampler& sampler) {
    const auto d =
        sample_direct(scene_, Receiver::of(v.surface, walk.medium), walk.lambda, sampler);
    if (!d) return;
    const Vec3f wi = v.to_local(d->wi_world);
    std::array<BsdfEval, std::size(kClasses)> evals;
    bool any = false;
    for (size_t i = 0; i < evals.size(); ++i) {
      if (!contains(finite, kClasses[i]) || !owns(v.letter(kClasses[i]))) continue;
      evals[i] = v.bsdf.eval(v.wo, wi, TransportMode::kRadiance, kClasses[i], among);
      any |= !evals[i].f.is_black();
    }
    if (!any) return;
    ++shadow_rays_;
    const ShadowFlight shadow = trace_shadow(scene_, *d, walk.lambda, sampler);
    if (shadow.transmittance.is_black()) return;
    SampledSpectrum sum;
    for (const BsdfEval& e : evals)
      if (!e.f.is_black()) sum += e.f * weight_of_direct(walk, *d, shadow, e.pdf_w);
    radiance_ += walk.throughput * sum * d->radiance * shadow.transmittance * abs_cos_theta(wi);
  }

  void record_features(const Walk& walk, const WalkVertex& v) {
    albedo_ = v.bsdf.albedo(v.wo);
    features_.normal = v.surface.shading.z;
    features_.depth = walk.length;
    features_.surface = {v.surface.p, v.surface.ng, v.surface.shading.z, v.surface.wo,
                         v.surface.uv};
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
  const Rgb seen = settings.white_balance ? *settings.white_balance * white : white;
  return seen * (kCieYIntegral * settings.imaging_ratio);
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
        const SampledWavelengths lambda =
            SampledWavelengths::sample_visible(wavelength_number(scene, sampler.get_1d()));
        sampler.start_dimension(dimensions::kTime);
        CameraPath path = start_camera_path(scene, x, y, sampler, lambda, sampler.get_1d());
        PathVisitor visitor(scene, routes_, route_);
        if (path.camera_weight > 0)
          random_walk(scene, TransportMode::kRadiance, max_depth_, path.walk, sampler, visitor);
        const SensorWeights weights =
            sensor_weights(path.walk.lambda, *settings.color_space, settings.imaging_ratio,
                           settings.white_balance);
        const Rgb rgb = clamp_component(weights.apply(visitor.radiance()) * path.camera_weight,
                                        settings.max_component);
        film.add(buffer_, x, y, rgb * path.filter_weight);
        film.add_features(x, y, of_white(weights.apply(visitor.albedo()), white),
                          visitor.features().normal, visitor.features().depth);
        if (settings.gbuffer && visitor.features().depth > 0)
          film.add_surface(x, y, surface_sample(scene, path, visitor.features().surface));
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
