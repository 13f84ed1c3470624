#include "integrator/sppm.h"

#include "core/parallel.h"
#include "integrator/photon_pass.h"

namespace nephroid {

namespace {

constexpr uint64_t kStream = 0x7370706d;  // "sppm"
constexpr float kDefaultRadius = 2.0f;

}  // namespace

Sppm::Sppm(int photon_buffer, const IntegratorOptions& options)
    : routes_(Routes::all(Route::kCaustic)), photon_buffer_(photon_buffer), options_(options) {
  if (!(options_.radius > 0)) options_.radius = kDefaultRadius;
}

void Sppm::render_pass(const PassKey& key, const Scene& scene, Film& film) {
  const PixelBounds& b = film.bounds();
  const FilmSettings& settings = film.settings();
  const PhotonPass pass = start_photon_pass(key, scene, film, options_);
  const int64_t photons = pass.trace.photons_per_pass;
  pixels_.resize(static_cast<size_t>(b.area()));
  footprint_.resize(pixels_.size());

  // What a pass finds is collected over its batches; the radius stays until the pass is complete.
  struct Found {
    Rgb phi;
    float filter_weight = 1;
    uint64_t count = 0;
  };
  std::vector<Found> found(pixels_.size());
  std::vector<uint64_t> rays(static_cast<size_t>(b.height()), 0);
  for (int64_t begin = 0; begin < photons;) {
    PhotonTrace trace =
        trace_batch(scene, routes_, Route::kCaustic, pass.trace, options_.memory_photons, begin);
    count_photons(trace, statistics_);
    const PhotonGrid grid(std::move(trace.photons));

    parallel_chunks(b.height(), 1, [&](int64_t row, int64_t, int64_t) {
      const int y = b.y0 + static_cast<int>(row);
      for (int x = b.x0; x < b.x1; ++x) {
        const size_t index = static_cast<size_t>(row) * static_cast<size_t>(b.width()) +
                             static_cast<size_t>(x - b.x0);
        SharedStatistics& pixel = pixels_[index];
        PathSampler sampler(pass.point, hash_combine(key.seed, kStream, x, y));
        CameraPath path = start_camera_path(scene, x, y, sampler, pass.trace.lambda, pass.u_time);
        SampledSpectrum flux;
        auto merge = [&](const Walk& walk, const WalkVertex& v, EyeState eye) {
          const float width = pass.footprint.width(walk.length);
          if (!(pixel.radius_squared > 0)) {
            pixel.radius_squared = sqr(static_cast<double>(options_.radius) * width);
            footprint_[index] = width;
          }
          const MergeResult m =
              merge_photons(grid, routes_, Route::kCaustic, v, eye, walk.events + 1,
                            options_.max_depth, walk.lambda.secondary_terminated(),
                            static_cast<float>(std::sqrt(pixel.radius_squared)));
          flux += walk.throughput * (m.reflected + m.hero);
          found[index].count += m.found;
        };
        MergeWalkVisitor visitor(routes_, merge);
        if (path.camera_weight > 0)
          random_walk(scene, TransportMode::kRadiance, options_.max_depth, path.walk, sampler,
                      visitor);
        rays[static_cast<size_t>(row)] += path.walk.rays;
        found[index].phi = found[index].phi + pass.weights.apply(flux) * path.camera_weight;
        found[index].filter_weight = path.filter_weight;
      }
    });
  }
  film.set_estimates(photon_buffer_, 1);
  emitted_ += static_cast<double>(photons);

  // [E1] for every pixel, and the picture so far.
  float smallest = kInfinity, largest = 0;
  for (size_t i = 0; i < pixels_.size(); ++i) {
    SharedStatistics& pixel = pixels_[i];
    if (!(pixel.radius_squared > 0)) continue;
    // A pass's estimate is clamped as a sample of other integrators is, then weighed by the filter.
    const double area_of_pass =
        static_cast<double>(photons) * static_cast<double>(kPi) * pixel.radius_squared;
    const float limit = settings.max_component * static_cast<float>(area_of_pass);
    const Rgb kept = clamp_component(found[i].phi, limit) * found[i].filter_weight;
    const double phi[3] = {kept.r, kept.g, kept.b};
    pixel.update(static_cast<double>(found[i].count), phi, options_.alpha);
    found_ += found[i].count;
    const double scale = 1.0 / (emitted_ * static_cast<double>(kPi) * pixel.radius_squared);
    film.replace(
        photon_buffer_, b.x0 + static_cast<int>(i % static_cast<size_t>(b.width())),
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

EstimatorStatistics Sppm::statistics() const {
  EstimatorStatistics s = statistics_;
  explain_darkness(found_, s);
  return s;
}

}  // namespace nephroid
