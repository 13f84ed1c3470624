#include "integrator/path/path.h"

#include "integrator/estimator/path_tally.h"
#include "integrator/estimator/pixel_pass.h"
#include "integrator/estimator/reach.h"
#include "integrator/path/path_options.h"
#include "integrator/path/path_pass.h"
#include "integrator/path/path_visitor.h"

namespace nephroid {

namespace {

constexpr uint64_t kPathStream = 0x70617468;  // "path"
constexpr const EstimatorSetting* kPathSettings[] = {&kSpecularTreesSetting};

/// True if the group owns some path that is possible in the scene.
bool owns_any_path(const OwnedRoutes& owned) {
  const Routes& routes = *owned.routes;
  if (routes.ends(owned.group, routes.start())) return true;
  for (size_t label = 0; label <= routes.labels().size(); ++label)
    if (routes.useful(owned.group, routes.start(), static_cast<Label>(label)) != ClassMask::kNone)
      return true;
  return false;
}

}  // namespace

constinit const EstimatorDescriptor PathEstimator::kDescriptor = {
    .traits = {.name = "path",
               .help = "path tracing with next-event estimation, from the eye",
               .why_never_sampled = out_of_reach_of_eye_walks},
    .settings = kPathSettings,
    .make = make_estimator<PathEstimator>,
};

PathEstimator::PathEstimator(OwnedRoutes owned, const IntegratorOptions& options)
    : owned_(std::move(owned)),
      options_(options),
      samples_per_pass_(std::max(1, options.camera_samples_per_pass)),
      finds_something_(owns_any_path(owned_)) {
  statistics_.tells_lamps = true;
}

void PathEstimator::render_pass(const PassKey& key, const Learned*, const Scene& scene, Film& film,
                                PassControl& control) {
  if (!finds_something_) {
    film.add_estimates(static_cast<int>(owned_.group), 1);
    return;
  }
  LampCounter lamps(*owned_.symbols, key.pass);
  const PathPass pass{key,         scene,   film, owned_, samples_per_pass_,
                      kPathStream, control, true, &lamps};
  const SpecularTree tree(scene, owned_, options_.max_depth);
  const PathOptions& own = options_.own<PathOptions>();
  statistics_.rays += trace_paths(pass, [&](int x, int y, CameraPath& path,
                                            const SensorWeights& weights, PathSampler& sampler,
                                            PartSums& light) {
    Features features;
    PathVisitor visitor(scene, owned_, own.blind_walks, light, &features,
                        own.specular_trees ? &tree : nullptr);
    if (path.camera_weight > 0)
      random_walk(scene, TransportMode::kRadiance, options_.max_depth, path.walk, sampler, visitor);
    features.add_to(film, x, y, scene, path, weights);
    return path.walk.rays + visitor.more_rays();
  });
  lamps.add_to(statistics_);
  statistics_.camera_paths += film.bounds().area() * samples_per_pass_;
}

void PathEstimator::record_pixel(const PixelPass& pixel, const Learned*, PathTally& tally) const {
  if (!finds_something_) return;
  const Scene& scene = pixel.scene;
  const FilmSettings& film = pixel.film.settings();
  const PathOptions& own = options_.own<PathOptions>();
  const SpecularTree tree(scene, owned_, options_.max_depth);
  const float specular_alpha = specular_alpha_of_pass(scene.specular_band, pixel.key);
  PartSums light(*owned_.routes, owned_.group);
  for (int k = 0; k < pixel.camera_paths; ++k) {
    const SobolPoint point =
        eye_point(pixel.key.pass * static_cast<uint32_t>(pixel.camera_paths) + k);
    PathSampler sampler(point, hash_combine(pixel.key.seed, kPathStream, pixel.x, pixel.y));
    CameraPath path = start_own_path(scene, pixel.x, pixel.y, specular_alpha, sampler);
    const SensorWeights weights = sensor_weights_of(path, film);
    light.clear();
    tally.begin(path.walk.ray.o);
    RecordingVisitor visitor(PathVisitor(scene, owned_, own.blind_walks, light, nullptr,
                                         own.specular_trees ? &tree : nullptr, &tally),
                             tally.walk);
    if (path.camera_weight > 0)
      random_walk(scene, TransportMode::kRadiance, options_.max_depth, path.walk, sampler, visitor);
    tally.end(weights, path.camera_weight, film.max_component,
              path.filter_weight / static_cast<float>(pixel.camera_paths));
  }
}

}  // namespace nephroid
