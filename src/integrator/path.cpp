#include "integrator/path.h"

#include <array>
#include <vector>

#include "core/parallel.h"
#include "core/warps.h"
#include "film/part_sums.h"
#include "integrator/features.h"
#include "transport/camera_path.h"
#include "transport/direct_light.h"
#include "transport/roughness_band.h"
#include "transport/walk_symbols.h"

namespace nephroid {

namespace {

// Collects the light of one camera path.
class PathVisitor {
 public:
  /// With `blind`, walks do not look at what is useful for the routes: any routes see the same
  /// paths.
  PathVisitor(const Scene& scene, const OwnedRoutes& owned, bool blind, PartSums& light)
      : scene_(scene),
        routes_(*owned.routes),
        symbols_(*owned.symbols),
        group_(owned.group),
        blind_(blind),
        light_(light),
        eye_(routes_.start()) {}

  void escape(const Walk& walk) {
    if (!routes_.ends(group_, eye_)) return;
    for (const int i : scene_.light_sampler->infinite_lights()) {
      const Part part = routes_.owner(eye_, symbols_.light(i));
      if (!light_.owns(part)) continue;
      const Light& light = *scene_.lights[static_cast<size_t>(i)];
      const SampledSpectrum le =
          light.radiance_at_infinity(walk.previous_p, walk.ray.d, walk.lambda);
      if (le.is_black()) continue;
      light_.add(part, walk.throughput * le *
                           (walk.delta ? 1.0f / walk.density.u_mean
                                       : weight_of_hit(walk, direct_pdf_w(scene_, walk, i))));
    }
  }

  void emitter(const Walk& walk, const SurfaceInteraction& hit, const Light& light) {
    const Part part = routes_.owner(eye_, symbols_.light(hit.area_light));
    if (!light_.owns(part)) return;
    const SampledSpectrum le = light.radiance(hit.p, hit.ng, hit.uv, hit.wo, walk.lambda);
    if (le.is_black()) return;
    light_.add(part, walk.throughput * le *
                         (walk.delta ? 1.0f / walk.density.u_mean
                                     : weight_of_hit(walk, direct_pdf_w(scene_, walk, hit))));
  }

  void medium_emission(const Medium& medium, const SampledSpectrum& radiance) {
    const Part part = routes_.owner(eye_, symbols_.glow(medium.index()));
    if (light_.owns(part)) light_.add(part, radiance);
  }

  ClassMask useful(const WalkVertex& v) const {
    return blind_ ? ClassMask::kEvery : routes_.useful(group_, eye_, label_at(symbols_, v));
  }
  bool scatters_in(const Medium& medium) const {
    return blind_ || contains(routes_.useful(group_, eye_, symbols_.medium(medium.index())),
                              EventClass::kVolume);
  }
  bool looks_under_surfaces() const { return false; }

  void vertex(const Walk& walk, const WalkVertex& v, PathSampler& sampler) {
    features_.record(walk, v);
    const ClassMask among = v.classes_of(useful(v));
    const ClassMask finite = v.bsdf.finite_classes() & among;
    if (may_end_after_any(v, finite)) next_event(walk, v, finite, among, sampler);
  }

  void medium_vertex(const Walk& walk, const MediumVertex& v, PathSampler& sampler) {
    const EyeState eye = routes_.next(eye_, symbol_in(symbols_, v.medium));
    if (!routes_.ends(group_, eye)) return;
    const auto d = sample_direct(scene_, Receiver::of(v, walk.medium), walk.lambda, sampler);
    if (!d) return;
    const Part part = routes_.owner(eye, symbols_.light(d->light));
    if (!light_.owns(part)) return;
    ++shadow_rays_;
    const ShadowFlight shadow = trace_shadow(scene_, *d, walk.lambda, sampler);
    if (shadow.transmittance.is_black()) return;
    const float phase = v.phase.eval(v.wo, d->wi_world);
    light_.add(part, walk.throughput * d->radiance * shadow.transmittance *
                         (phase * weight_of_direct(walk, *d, shadow, phase)));
  }

  bool scatter(const Walk&, const WalkEvent& event) {
    eye_ = routes_.next(eye_, symbol_of(symbols_, event));
    return true;
  }

  const Features& features() const { return features_; }
  uint64_t shadow_rays() const { return shadow_rays_; }

 private:
  /// True if an event of one of the classes may be followed by light that belongs to the group.
  bool may_end_after_any(const WalkVertex& v, ClassMask finite) const {
    const Label label = label_at(symbols_, v);
    for (const EventClass c : kSurfaceClasses) {
      if (!contains(finite, c)) continue;
      for (const bool transmitted : {false, true})
        if (routes_.ends(group_, routes_.next(eye_, event_symbol(v.letter(c), transmitted, label))))
          return true;
    }
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
    const LightSymbol light = symbols_.light(d->light);
    std::array<BsdfEval, std::size(kSurfaceClasses)> evals;
    std::array<Part, std::size(kSurfaceClasses)> parts;
    bool any = false;
    for (size_t i = 0; i < evals.size(); ++i) {
      const EventClass c = kSurfaceClasses[i];
      if (!contains(finite, c)) continue;
      parts[i] = routes_.owner(routes_.next(eye_, symbol_at(symbols_, v, c, wi)), light);
      if (!light_.owns(parts[i])) continue;
      evals[i] = v.bsdf.eval(v.wo, wi, TransportMode::kRadiance, c, among);
      any |= !evals[i].f.is_black();
    }
    if (!any) return;
    ++shadow_rays_;
    const ShadowFlight shadow = trace_shadow(scene_, *d, walk.lambda, sampler);
    if (shadow.transmittance.is_black()) return;
    const SampledSpectrum arriving =
        walk.throughput * d->radiance * shadow.transmittance * abs_cos_theta(wi);
    for (size_t i = 0; i < evals.size(); ++i)
      if (!evals[i].f.is_black())
        light_.add(parts[i],
                   arriving * evals[i].f * weight_of_direct(walk, *d, shadow, evals[i].pdf_w));
  }

  const Scene& scene_;
  const Routes& routes_;
  const SceneSymbols& symbols_;
  const size_t group_;
  const bool blind_;
  PartSums& light_;
  EyeState eye_;
  Features features_;
  uint64_t shadow_rays_ = 0;
};

constexpr uint64_t kStream = 0x70617468;  // "path"

}  // namespace

PathEstimator::PathEstimator(OwnedRoutes owned, const IntegratorOptions& options)
    : owned_(std::move(owned)),
      options_(options),
      samples_per_pass_(std::max(1, options.camera_samples_per_pass)) {}

void PathEstimator::render_pass(const PassKey& key, const Scene& scene, Film& film) {
  const PixelBounds& b = film.bounds();
  const FilmSettings& settings = film.settings();
  const float specular_alpha = specular_alpha_of_pass(scene.specular_band, key);
  const int group = static_cast<int>(owned_.group);
  std::vector<uint64_t> rays(static_cast<size_t>(b.height()), 0);
  for (int k = 0; k < samples_per_pass_; ++k) {
    const uint64_t index =
        uint64_t{key.pass} * static_cast<uint64_t>(samples_per_pass_) + static_cast<uint64_t>(k);
    const SobolPoint point(static_cast<uint32_t>(index));
    parallel_chunks(b.height(), 1, [&](int64_t row, int64_t, int64_t) {
      const int y = b.y0 + static_cast<int>(row);
      PartSums light(*owned_.routes, owned_.group);
      for (int x = b.x0; x < b.x1; ++x) {
        PathSampler sampler(point, hash_combine(key.seed, kStream, x, y, index >> 32));
        sampler.start_dimension(dimensions::kWavelength);
        const SampledWavelengths lambda =
            SampledWavelengths::sample_visible(wavelength_number(scene, sampler.get_1d()));
        sampler.start_dimension(dimensions::kTime);
        CameraPath path = start_camera_path(scene, x, y, sampler, lambda, sampler.get_1d());
        path.walk.specular_alpha = specular_alpha;
        light.clear();
        PathVisitor visitor(scene, owned_, options_.blind_walks, light);
        if (path.camera_weight > 0)
          random_walk(scene, TransportMode::kRadiance, options_.max_depth, path.walk, sampler,
                      visitor);
        const SensorWeights weights =
            sensor_weights(path.walk.lambda, *settings.color_space, settings.imaging_ratio,
                           settings.white_balance);
        film.add(
            group, x, y,
            light.colors(weights, path.camera_weight, settings.max_component, path.filter_weight));
        visitor.features().add_to(film, x, y, scene, path, weights);
        rays[static_cast<size_t>(row)] += path.walk.rays + visitor.shadow_rays();
      }
    });
    film.add_estimates(group, 1);
    film.add_feature_estimates(1);
  }
  for (const uint64_t r : rays) statistics_.rays += r;
  statistics_.camera_paths += static_cast<uint64_t>(b.area()) * samples_per_pass_;
}

}  // namespace nephroid
