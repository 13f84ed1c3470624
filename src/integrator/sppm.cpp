#include "integrator/sppm.h"

#include "core/parallel.h"
#include "integrator/photon_pass.h"

namespace nephroid {

namespace {

constexpr uint64_t kStream = 0x7370706d;  // "sppm"
constexpr float kDefaultRadius = 2.0f;

}  // namespace

Sppm::Sppm(int emission_buffer, int photon_buffer, const IntegratorOptions& options)
    : routes_(Routes::all(Route::kCaustic)),
      emission_buffer_(emission_buffer),
      photon_buffer_(photon_buffer),
      options_(options) {
  if (!(options_.radius > 0)) options_.radius = kDefaultRadius;
}

void Sppm::render_pass(const PassKey& key, const Scene& scene, Film& film) {
  const PixelBounds& b = film.bounds();
  const FilmSettings& settings = film.settings();
  const PassSetting setting = pass_setting(key);
  const SensorWeights weights =
      sensor_weights(setting.lambda, *settings.color_space, settings.imaging_ratio);
  const PixelFootprint footprint = scene.camera->footprint();
  const SobolPoint point(key.pass);
  pixels_.resize(static_cast<size_t>(b.area()));
  footprint_.resize(pixels_.size());

  PhotonTraceSettings trace_settings;
  trace_settings.key = key;
  trace_settings.lambda = setting.lambda;
  trace_settings.time = setting.time;
  trace_settings.photons_per_pass = options_.photons_per_pass > 0
                                        ? options_.photons_per_pass
                                        : default_photons_per_pass(b.area());
  trace_settings.max_events = options_.max_depth;
  const int64_t photons = trace_settings.photons_per_pass;
  const int64_t batch =
      std::max<int64_t>(kPhotonChunk, options_.memory_photons / 8 / kPhotonChunk * kPhotonChunk);

  // What a pass finds is collected over its batches; the radius stays until the pass is complete.
  struct Found {
    double phi[3] = {0, 0, 0};
    uint64_t count = 0;
  };
  std::vector<Found> found(pixels_.size());
  std::vector<uint64_t> rays(static_cast<size_t>(b.height()), 0);
  for (int64_t begin = 0; begin < photons; begin += batch) {
    const bool first_batch = begin == 0;
    PhotonTrace trace = trace_photons(scene, routes_, Route::kCaustic, trace_settings, begin,
                                      std::min(photons, begin + batch));
    statistics_.photon_paths += trace.paths;
    statistics_.photon_paths_useful += trace.useful_paths;
    statistics_.photon_paths_specular += trace.specular_paths;
    statistics_.photons_stored += trace.photons.size();
    statistics_.rays += trace.rays;
    const PhotonGrid grid(std::move(trace.photons));

    parallel_chunks(b.height(), 1, [&](int64_t row, int64_t, int64_t) {
      const int y = b.y0 + static_cast<int>(row);
      for (int x = b.x0; x < b.x1; ++x) {
        const size_t index = static_cast<size_t>(row) * static_cast<size_t>(b.width()) +
                             static_cast<size_t>(x - b.x0);
        SharedStatistics& pixel = pixels_[index];
        PathSampler sampler(point, hash_combine(key.seed, kStream, x, y));
        CameraPath path = start_camera_path(scene, x, y, sampler, setting.lambda, setting.time);
        SampledSpectrum flux, seen;
        auto merge = [&](const Walk& walk, const WalkVertex& v, EyeState eye) {
          const float width = footprint.width(walk.length);
          if (!(pixel.radius_squared > 0)) {
            pixel.radius_squared = sqr(static_cast<double>(options_.radius) * width);
            footprint_[index] = width;
          }
          const MergeResult m = merge_photons(
              grid, routes_, Route::kCaustic, v, eye, walk.events + 1, options_.max_depth,
              walk.lambda.secondary_terminated(), static_cast<float>(std::sqrt(pixel.radius_squared)));
          flux += walk.throughput * (m.reflected + m.hero);
          found[index].count += m.found;
        };
        auto emission = [&](const Walk& walk, EyeState, const SampledSpectrum& le) {
          SampledSpectrum l = walk.throughput * le;
          // The camera walk alone dropped its secondary wavelengths: the hero stands for all.
          if (walk.lambda.secondary_terminated()) {
            const float hero = l[0] * kSpectrumSamples;
            l = SampledSpectrum();
            l.set(0, hero);
          }
          seen += l;
        };
        MergeWalkVisitor visitor(scene, routes_, merge, emission);
        random_walk(scene, TransportMode::kRadiance, options_.max_depth, path.walk, sampler,
                    visitor);
        rays[static_cast<size_t>(row)] += path.walk.rays;
        const Rgb rgb = weights.apply(flux) * path.filter_weight;
        for (int c = 0; c < 3; ++c) found[index].phi[c] += static_cast<double>(rgb[c]);
        if (first_batch)
          film.add(emission_buffer_, x, y, weights.apply(seen) * path.filter_weight);
      }
    });
  }
  film.add_estimates(emission_buffer_, 1);
  film.set_estimates(photon_buffer_, 1);
  emitted_ += static_cast<double>(photons);

  // [E1] for every pixel, and the picture so far.
  float smallest = kInfinity, largest = 0;
  for (size_t i = 0; i < pixels_.size(); ++i) {
    SharedStatistics& pixel = pixels_[i];
    if (!(pixel.radius_squared > 0)) continue;
    pixel.update(static_cast<double>(found[i].count), found[i].phi, options_.alpha);
    const double scale = 1.0 / (emitted_ * static_cast<double>(kPi) * pixel.radius_squared);
    film.replace(photon_buffer_, b.x0 + static_cast<int>(i % static_cast<size_t>(b.width())),
                 b.y0 + static_cast<int>(i / static_cast<size_t>(b.width())),
                 {static_cast<float>(pixel.flux[0] * scale), static_cast<float>(pixel.flux[1] * scale),
                  static_cast<float>(pixel.flux[2] * scale)});
    const float r = static_cast<float>(std::sqrt(pixel.radius_squared)) / footprint_[i];
    smallest = std::min(smallest, r);
    largest = std::max(largest, r);
  }
  for (const uint64_t r : rays) statistics_.rays += r;
  statistics_.camera_paths += static_cast<uint64_t>(b.area());
  statistics_.radius_min_pixels = largest > 0 ? smallest : 0;
  statistics_.radius_max_pixels = largest;
}

}  // namespace nephroid
