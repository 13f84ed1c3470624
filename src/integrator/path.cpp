#include "integrator/path.h"

#include <vector>

#include "core/parallel.h"
#include "integrator/path_visitor.h"
#include "transport/camera_path.h"
#include "transport/roughness_band.h"

namespace nephroid {

namespace {

constexpr uint64_t kStream = 0x70617468;  // "path"

/// False if no path that the scene can have belongs to the group.
bool owns_any_path(const OwnedRoutes& owned) {
  const Routes& routes = *owned.routes;
  if (routes.ends(owned.group, routes.start())) return true;
  for (size_t label = 0; label <= routes.labels().size(); ++label)
    if (routes.useful(owned.group, routes.start(), static_cast<Label>(label)) != ClassMask::kNone)
      return true;
  return false;
}

}  // namespace

PathEstimator::PathEstimator(OwnedRoutes owned, const IntegratorOptions& options)
    : owned_(std::move(owned)),
      options_(options),
      samples_per_pass_(std::max(1, options.camera_samples_per_pass)),
      finds_something_(owns_any_path(owned_)) {}

void PathEstimator::render_pass(const PassKey& key, const Scene& scene, Film& film) {
  if (!finds_something_) {
    film.add_estimates(static_cast<int>(owned_.group), 1);
    return;
  }
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
        Features features;
        PathVisitor visitor(scene, owned_, options_.blind_walks, light, &features);
        if (path.camera_weight > 0)
          random_walk(scene, TransportMode::kRadiance, options_.max_depth, path.walk, sampler,
                      visitor);
        const SensorWeights weights =
            sensor_weights(path.walk.lambda, *settings.color_space, settings.imaging_ratio,
                           settings.white_balance);
        film.add(
            group, x, y,
            light.colors(weights, path.camera_weight, settings.max_component, path.filter_weight));
        features.add_to(film, x, y, scene, path, weights);
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
