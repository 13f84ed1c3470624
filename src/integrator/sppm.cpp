#include "integrator/sppm.h"

#include "core/parallel.h"
#include "integrator/photon_pass.h"

namespace nephroid {

namespace {

constexpr uint64_t kStream = 0x7370706d;  // "sppm"
constexpr float kDefaultRadius = 2.0f;

}  // namespace

Sppm::Sppm(OwnedRoutes owned, const IntegratorOptions& options)
    : owned_(std::move(owned)), options_(options) {
  if (!(options_.radius > 0)) options_.radius = kDefaultRadius;
}

void Sppm::render_pass(const PassKey& key, const Scene& scene, Film& film) {
  const int group = static_cast<int>(owned_.group);
  const size_t parts = film.parts_of(group).size();
  const PixelBounds& b = film.bounds();
  const FilmSettings& settings = film.settings();
  const PhotonPass pass = start_photon_pass(key, scene, film, options_);
  const int64_t photons = pass.trace.photons_per_pass;
  pixels_.resize(static_cast<size_t>(b.area()));
  flux_.resize(pixels_.size() * parts);
  footprint_.resize(pixels_.size());

  // The radius stays until the pass is complete.
  std::vector<Found> found(pixels_.size());
  std::vector<Rgb> phi(pixels_.size() * parts);
  std::vector<uint64_t> rays(static_cast<size_t>(b.height()), 0);
  for (int64_t begin = 0; begin < photons;) {
    PhotonTrace trace = trace_batch(scene, owned_, pass.trace, options_.memory_photons, begin);
    count_photons(trace, statistics_);
    const PhotonGrid grid(std::move(trace.photons));
    count_memory(grid, pixels_.size() * (bytes_kept(parts) + bytes_of_pass(parts)), statistics_);

    parallel_chunks(b.height(), 1, [&](int64_t row, int64_t, int64_t) {
      const int y = b.y0 + static_cast<int>(row);
      PartSums sums(*owned_.routes, owned_.group);
      for (int x = b.x0; x < b.x1; ++x) {
        const size_t index = static_cast<size_t>(row) * static_cast<size_t>(b.width()) +
                             static_cast<size_t>(x - b.x0);
        SharedStatistics& pixel = pixels_[index];
        PathSampler sampler(pass.point, hash_combine(key.seed, kStream, x, y));
        CameraPath path = start_merging_path(scene, x, y, sampler, pass);
        sums.clear();
        auto merge = [&](const Walk& walk, const MergePoint& at) {
          const float width = pass.footprint.width(walk.length);
          if (!(pixel.radius_squared > 0)) {
            pixel.radius_squared = sqr(static_cast<double>(options_.radius) * width);
            footprint_[index] = width;
          }
          found[index].count +=
              merge_photons(grid, owned_, at, options_.max_depth,
                            static_cast<float>(std::sqrt(pixel.radius_squared)), sums);
        };
        MergeWalkVisitor visitor(owned_, merge);
        if (path.camera_weight > 0)
          random_walk(scene, TransportMode::kRadiance, options_.max_depth, path.walk, sampler,
                      visitor);
        rays[static_cast<size_t>(row)] += path.walk.rays;
        for (size_t i = 0; i < parts; ++i) {
          Rgb& sum = phi[index * parts + i];
          sum = sum + pass.weights.apply(sums.sums()[i]) * path.camera_weight;
        }
        found[index].filter_weight = path.filter_weight;
      }
    });
  }
  film.set_estimates(group, 1);
  emitted_ += static_cast<double>(photons);

  // [E1] for every pixel, and the picture so far.
  std::vector<Rgb> values(parts);
  float smallest = kInfinity, largest = 0;
  for (size_t i = 0; i < pixels_.size(); ++i) {
    SharedStatistics& pixel = pixels_[i];
    if (!(pixel.radius_squared > 0)) continue;
    // A pass's estimate is clamped as a sample of other integrators is, then weighed by the filter.
    const double area_of_pass =
        static_cast<double>(photons) * static_cast<double>(kPi) * pixel.radius_squared;
    const std::span<Rgb> estimate(&phi[i * parts], parts);
    PartSums::clamp_total(estimate, settings.max_component * static_cast<float>(area_of_pass));
    const double kept = pixel.update(static_cast<double>(found[i].count), options_.alpha);
    const double scale = 1.0 / (emitted_ * static_cast<double>(kPi) * pixel.radius_squared);
    for (size_t k = 0; k < parts; ++k) {
      std::array<double, 3>& tau = flux_[i * parts + k];
      const Rgb add = estimate[k] * found[i].filter_weight;
      for (int c = 0; c < 3; ++c)
        tau[static_cast<size_t>(c)] = (tau[static_cast<size_t>(c)] + add[c]) * kept;
      values[k] = {static_cast<float>(tau[0] * scale), static_cast<float>(tau[1] * scale),
                   static_cast<float>(tau[2] * scale)};
    }
    found_ += found[i].count;
    film.replace(group, b.x0 + static_cast<int>(i % static_cast<size_t>(b.width())),
                 b.y0 + static_cast<int>(i / static_cast<size_t>(b.width())), values);
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
  explain_darkness(owned_, found_, s);
  return s;
}

}  // namespace nephroid
