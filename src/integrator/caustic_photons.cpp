#include "integrator/caustic_photons.h"

#include <vector>

#include "core/parallel.h"
#include "integrator/photon_pass.h"
#include "photon/radius_schedule.h"

namespace nephroid {

namespace {

constexpr uint64_t kStream = 0x6d65726765;  // "merge"

// First merge radius in pixel footprints, if the user gives none.
constexpr float kDefaultRadius = 1.5f;

struct RowResult {
  uint64_t rays = 0, found = 0;
};

}  // namespace

CausticPhotons::CausticPhotons(const Routes& routes, Route route, int buffer,
                               const IntegratorOptions& options)
    : routes_(routes), route_(route), buffer_(buffer), options_(options) {
  if (!(options_.radius > 0)) options_.radius = kDefaultRadius;
}

void CausticPhotons::render_pass(const PassKey& key, const Scene& scene, Film& film) {
  film.add_estimates(buffer_, 1);
  has_specular_material_ = scene.has_specular_material;
  if (!has_specular_material_) return;
  const PixelBounds& b = film.bounds();
  const FilmSettings& settings = film.settings();
  const PassSetting setting = pass_setting(key);
  const SensorWeights weights =
      sensor_weights(setting.lambda, *settings.color_space, settings.imaging_ratio);
  const PixelFootprint footprint = scene.camera->footprint();
  const float shrink =
      static_cast<float>(std::sqrt(memoryless_radius_squared(key.pass, options_.alpha)));
  const float radius_pixels = options_.radius * shrink;
  const SobolPoint point(key.pass);

  PhotonTraceSettings trace_settings;
  trace_settings.key = key;
  trace_settings.lambda = setting.lambda;
  trace_settings.time = setting.time;
  trace_settings.photons_per_pass = options_.photons_per_pass > 0
                                        ? options_.photons_per_pass
                                        : default_photons_per_pass(b.area());
  trace_settings.max_events = options_.max_depth;
  const int64_t photons = trace_settings.photons_per_pass;
  // A batch stores at most as many photons as memory allows even if every path deposits several times.
  const int64_t batch =
      std::max<int64_t>(kPhotonChunk, options_.memory_photons / 4 / kPhotonChunk * kPhotonChunk);

  std::vector<Rgb> pixels(static_cast<size_t>(b.area()));
  std::vector<RowResult> rows(static_cast<size_t>(b.height()));
  for (int64_t begin = 0; begin < photons; begin += batch) {
    PhotonTrace trace = trace_photons(scene, routes_, route_, trace_settings, begin,
                                      std::min(photons, begin + batch));
    statistics_.photon_paths += trace.paths;
    statistics_.photon_paths_useful += trace.useful_paths;
    statistics_.photon_paths_specular += trace.specular_paths;
    statistics_.photons_stored += trace.photons.size();
    statistics_.rays += trace.rays;
    if (trace.photons.empty()) continue;
    const PhotonGrid grid(std::move(trace.photons));

    parallel_chunks(b.height(), 1, [&](int64_t row, int64_t, int64_t) {
      const int y = b.y0 + static_cast<int>(row);
      RowResult& result = rows[static_cast<size_t>(row)];
      for (int x = b.x0; x < b.x1; ++x) {
        PathSampler sampler(point, hash_combine(key.seed, kStream, x, y));
        CameraPath path = start_camera_path(scene, x, y, sampler, setting.lambda, setting.time);
        SampledSpectrum sum, sum_hero;
        auto merge = [&](const Walk& walk, const WalkVertex& v, EyeState eye) {
          const float r = radius_pixels * footprint.width(walk.length);
          const MergeResult m = merge_photons(grid, routes_, route_, v, eye, walk.events + 1,
                                              options_.max_depth,
                                              walk.lambda.secondary_terminated(), r);
          result.found += m.found;
          const float scale = 1.0f / (static_cast<float>(photons) * kPi * r * r);
          sum += walk.throughput * m.reflected * scale;
          sum_hero += walk.throughput * m.hero * scale;
        };
        auto emission = [](const Walk&, EyeState, const SampledSpectrum&) {};
        MergeWalkVisitor visitor(scene, routes_, merge, emission);
        random_walk(scene, TransportMode::kRadiance, options_.max_depth, path.walk, sampler,
                    visitor);
        result.rays += path.walk.rays;
        Rgb& pixel = pixels[static_cast<size_t>(row) * static_cast<size_t>(b.width()) +
                            static_cast<size_t>(x - b.x0)];
        pixel = pixel + weights.apply(sum + sum_hero) * path.filter_weight;
      }
    });
  }

  for (int y = b.y0; y < b.y1; ++y)
    for (int x = b.x0; x < b.x1; ++x) {
      Rgb rgb = pixels[static_cast<size_t>(y - b.y0) * static_cast<size_t>(b.width()) +
                       static_cast<size_t>(x - b.x0)];
      const float m = std::max({std::abs(rgb.r), std::abs(rgb.g), std::abs(rgb.b)});
      if (m > settings.max_component) rgb = rgb * (settings.max_component / m);
      film.add(buffer_, x, y, rgb);
    }
  for (const RowResult& r : rows) statistics_.rays += r.rays;
  statistics_.camera_paths += static_cast<uint64_t>(b.area());
  statistics_.radius_min_pixels = radius_pixels;
  if (statistics_.radius_max_pixels == 0) statistics_.radius_max_pixels = radius_pixels;
}

EstimatorStatistics CausticPhotons::statistics() const {
  EstimatorStatistics s = statistics_;
  if (!has_specular_material_)
    s.notes.push_back("no material of the scene has a specular lobe: there are no caustics, and no "
                      "photons were needed");
  if (s.photons_stored > 0 || s.photon_paths == 0) return s;
  s.notes.push_back("0 of " + std::to_string(s.photon_paths) +
                    " photon paths deposited a photon: the caustic layer is black");
  if (s.photon_paths_specular == 0)
    s.notes.push_back("0 of " + std::to_string(s.photon_paths) +
                      " photons met a specular surface");
  else
    s.notes.push_back(std::to_string(s.photon_paths_specular) + " of " +
                      std::to_string(s.photon_paths) +
                      " photons met a specular surface, none reached a diffuse one behind it");
  return s;
}

}  // namespace nephroid
