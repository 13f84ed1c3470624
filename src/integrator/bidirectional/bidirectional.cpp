#include "integrator/bidirectional/bidirectional.h"

#include <vector>

#include "core/parallel.h"
#include "integrator/bidirectional/path_pair.h"
#include "integrator/bidirectional/technique_choice.h"
#include "integrator/estimator/exposed_pixels.h"
#include "integrator/estimator/lamp_counter.h"
#include "integrator/estimator/reach.h"
#include "integrator/estimator/technique_counter.h"
#include "integrator/path/path_options.h"
#include "transport/roughness_band.h"

namespace nephroid {

namespace {

constexpr uint64_t kBdptEyeStream = 0x62647065;    // "bdpe"
constexpr uint64_t kBdptLightStream = 0x6264706c;  // "bdpl"

/// Limit of pixels per strip of rows, or one row. Splats are added once per strip.
constexpr int kMaxPixels = 1 << 16;

/// Splats and counts of a row of pixels.
struct PixelRow {
  std::vector<Splat> splats;
  uint64_t rays = 0, useful = 0;
  TechniqueCounter::Row techniques;
};

/// Renders one sample of each pixel.
class PairRound {
 public:
  PairRound(const PairSettings& settings, const PassKey& key, uint64_t index, Film& film)
      : settings_(settings),
        key_(key),
        index_(index),
        film_(film),
        eye_point_(eye_point(static_cast<uint32_t>(index), kEyePathDimensions)),
        light_point_(light_point(static_cast<uint32_t>(index))),
        techniques_(film.format(), settings.owned.group, key.pass),
        lamps_(*settings.owned.symbols, key.pass),
        parts_(film.parts_of(static_cast<int>(settings.owned.group)).size()),
        values_(film.bounds().area() * parts_) {}

  void render(SplatBuffer& buffer, EstimatorStatistics& statistics, PassControl& control) {
    const PixelBounds& b = film_.bounds();
    const int strip = std::max(1, kMaxPixels / std::max(1, b.width()));
    for (int begin = b.y0; begin < b.y1; begin += strip) {
      std::vector<Splat> splats;
      const auto trace_row = [&](PixelRow& row, int64_t y, int64_t) {
        render_row(begin + static_cast<int>(y), row);
      };
      ordered_reduce<PixelRow>(control, std::min(strip, b.y1 - begin), 1, trace_row,
                               [&](PixelRow&& row) {
                                 splats.insert(splats.end(), row.splats.begin(), row.splats.end());
                                 statistics.rays += row.rays;
                                 statistics.light_paths_useful += row.useful;
                                 techniques_.add(row.techniques);
                               });
      techniques_.add_splats(splats, 1.0 / settings_.light_paths);
      lamps_.add_splats(splats, film_.format(), 1.0 / settings_.light_paths);
      buffer.add(splats);
      statistics.splats += splats.size();
    }
    buffer.finish(1.0 / settings_.light_paths, values_);
    techniques_.add_to(statistics.techniques);
    lamps_.add_to(statistics);
    statistics.camera_paths += b.area();
    statistics.light_paths += b.area();
  }

 private:
  void render_row(int y, PixelRow& row) {
    const PixelBounds& b = film_.bounds();
    LightSubpath path;
    std::vector<CameraSplat> seen;
    PartSums light(*settings_.owned.routes, settings_.owned.group);
    row.techniques = techniques_.start_row(light);
    LampCounter::Slice lamps(&lamps_, light);
    for (int x = b.x0; x < b.x1; ++x) {
      seen.clear();
      light.clear();
      render_pixel(x, y, path, seen, light, lamps, row);
    }
  }

  void render_pixel(int x, int y, LightSubpath& path, std::vector<CameraSplat>& seen,
                    PartSums& light, LampCounter::Slice& lamps, PixelRow& row) {
    const Scene& scene = settings_.scene;
    const FilmSettings& film = film_.settings();
    PathSampler eye(eye_point_, hash_combine(key_.seed, kBdptEyeStream, x, y, index_ >> 32));
    eye.start_dimension(dimensions::kWavelength);
    const SampledWavelengths lambda =
        SampledWavelengths::sample_visible(wavelength_number(scene, eye.get_1d()));
    eye.start_dimension(dimensions::kTime);
    CameraPath camera = start_camera_path(scene, x, y, eye, lambda, eye.get_1d());
    const SensorWeights weights =
        sensor_weights(lambda, *film.color_space, film.imaging_ratio, film.white_balance);

    PathSampler sampler(light_point_,
                        hash_combine(key_.seed, kBdptLightStream, x, y, index_ >> 32));
    row.rays += trace_light_path(settings_, lambda, camera.u_time, sampler, &path, &seen, nullptr,
                                 kEyePathDimensions)
                    .rays;
    row.useful += !seen.empty();
    for (const CameraSplat& c : seen)
      for (int i = 0; i < c.seen.count; ++i)
        row.splats.push_back({c.seen.film[i], static_cast<uint8_t>(light.place(c.part)),
                              weights.apply(c.value), c.lamp});
    if (settings_.technique.t == 1) return;
    row.rays += trace_eye_path(settings_, path, camera, eye, light).rays;
    const PixelBounds& b = film_.bounds();
    const size_t pixel = static_cast<size_t>(y - b.y0) * b.width() + (x - b.x0);
    const std::span<const Rgb> colors =
        light.colors(weights, camera.camera_weight, film.max_component, camera.filter_weight);
    const double factor = static_cast<double>(camera.camera_weight) * camera.filter_weight;
    light.add_techniques_to(row.techniques, weights, factor);
    lamps.take(weights, factor);
    std::copy(colors.begin(), colors.end(),
              values_.begin() + static_cast<std::ptrdiff_t>(pixel * parts_));
  }

  const PairSettings& settings_;
  const PassKey key_;
  const uint64_t index_;
  Film& film_;
  const SobolPoint eye_point_, light_point_;
  TechniqueCounter techniques_;
  LampCounter lamps_;
  const size_t parts_;
  std::vector<Rgb> values_;  ///< [pixel * parts + part]
};

constexpr const EstimatorSetting* kBdptSettings[] = {&kTechniqueSetting, &kSpecularTreesSetting};

}  // namespace

constinit const EstimatorDescriptor Bidirectional::kDescriptor = {
    .traits = {.name = "bdpt",
               .help = "bidirectional path tracing: paths from eye and lights, connected in all "
                       "ways",
               .starts_at_lights = true,
               .why_never_sampled = out_of_reach_of_connections},
    .settings = kBdptSettings,
    .bytes_per_pixel =
        [](const PixelMemoryInput& need) {
          return PixelBytes{.of_pass = bytes_per_pixel(need.parts)};
        },
    .exposed_pixels = pixels_of_splats,
    .make = make_estimator<Bidirectional>,
};

Bidirectional::Bidirectional(OwnedRoutes owned, const IntegratorOptions& options)
    : owned_(std::move(owned)), options_(options) {
  statistics_.tells_lamps = true;
}

void Bidirectional::render_pass(const PassKey& key, const Learned*, const Scene& scene, Film& film,
                                PassControl& control) {
  const int group = static_cast<int>(owned_.group);
  const CameraView view(scene, film.bounds());
  PairSettings settings{scene, owned_};
  settings.view = scene.camera->connects() ? &view : nullptr;
  settings.specular_alpha = specular_alpha_of_pass(scene.specular_band, key);
  settings.max_depth = options_.max_depth;
  settings.light_paths = static_cast<double>(film.bounds().area());
  settings.technique = options_.own<TechniqueChoice>();
  const SpecularTree tree(scene, owned_, options_.max_depth);
  settings.tree = options_.own<PathOptions>().specular_trees ? &tree : nullptr;
  SplatBuffer buffer(film, group, *scene.filter);
  const size_t parts = film.parts_of(group).size();
  statistics_.hold(0, film.bounds().area() * bytes_per_pixel(parts));
  const int samples = std::max(1, options_.camera_samples_per_pass);
  for (int k = 0; k < samples; ++k) {
    const uint64_t index = uint64_t{key.pass} * samples + k;
    // Light that is on the film cannot be removed, so only the first sample may be stopped.
    PairRound(settings, key, index, film).render(buffer, statistics_, k == 0 ? control : unwatched);
    film.add_estimates(group, 1);
  }
}

}  // namespace nephroid
