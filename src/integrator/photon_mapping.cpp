#include "integrator/photon_mapping.h"

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

PhotonMapping::PhotonMapping(OwnedRoutes owned, const IntegratorOptions& options)
    : owned_(std::move(owned)),
      options_(options),
      photons_can_count_(photons_can_count(owned_)) {
  if (!(options_.radius > 0)) options_.radius = kDefaultRadius;
}

void PhotonMapping::render_pass(const PassKey& key, const Scene& scene, Film& film) {
  const int group = static_cast<int>(owned_.group);
  film.add_estimates(group, 1);
  if (!photons_can_count_) return;
  const PixelBounds& b = film.bounds();
  const FilmSettings& settings = film.settings();
  const PhotonPass pass = start_photon_pass(key, scene, film, options_);
  const int64_t photons = pass.trace.photons_per_pass;
  const float shrink =
      static_cast<float>(std::sqrt(memoryless_radius_squared(key.pass, options_.alpha)));
  const float radius_pixels = options_.radius * shrink;

  // A pixel's estimate is summed over the batches; its filter weight is the same in all of them.
  const size_t parts = film.parts_of(group).size();
  const size_t width = static_cast<size_t>(b.width());
  std::vector<Rgb> pixels(static_cast<size_t>(b.area()) * parts);
  std::vector<float> filter_weights(static_cast<size_t>(b.area()), 1.0f);
  std::vector<RowResult> rows(static_cast<size_t>(b.height()));
  for (int64_t begin = 0; begin < photons;) {
    PhotonTrace trace = trace_batch(scene, owned_, pass.trace, options_.memory_photons, begin);
    count_photons(trace, statistics_);
    if (trace.photons.empty()) continue;
    const PhotonGrid grid(std::move(trace.photons));

    parallel_chunks(b.height(), 1, [&](int64_t row, int64_t, int64_t) {
      const int y = b.y0 + static_cast<int>(row);
      RowResult& result = rows[static_cast<size_t>(row)];
      PartSums sums(*owned_.routes, owned_.group);
      for (int x = b.x0; x < b.x1; ++x) {
        PathSampler sampler(pass.point, hash_combine(key.seed, kStream, x, y));
        CameraPath path = start_merging_path(scene, x, y, sampler, pass);
        sums.clear();
        auto merge = [&](const Walk& walk, MergePoint at) {
          const float r = radius_pixels * pass.footprint.width(walk.length);
          if (!(r > 0.0f)) return;
          at.throughput = at.throughput / (static_cast<float>(photons) * kPi * r * r);
          result.found += merge_photons(grid, owned_, at, options_.max_depth, r, sums);
        };
        MergeWalkVisitor visitor(owned_, merge);
        if (path.camera_weight > 0)
          random_walk(scene, TransportMode::kRadiance, options_.max_depth, path.walk, sampler,
                      visitor);
        result.rays += path.walk.rays;
        const size_t pixel = static_cast<size_t>(row) * width + static_cast<size_t>(x - b.x0);
        for (size_t i = 0; i < parts; ++i) {
          Rgb& sum = pixels[pixel * parts + i];
          sum = sum + pass.weights.apply(sums.sums()[i]) * path.camera_weight;
        }
        filter_weights[pixel] = path.filter_weight;
      }
    });
  }

  for (int y = b.y0; y < b.y1; ++y)
    for (int x = b.x0; x < b.x1; ++x) {
      const size_t pixel = static_cast<size_t>(y - b.y0) * width + static_cast<size_t>(x - b.x0);
      const std::span<Rgb> estimate(&pixels[pixel * parts], parts);
      PartSums::clamp_total(estimate, settings.max_component);
      for (Rgb& color : estimate) color = color * filter_weights[pixel];
      film.add(group, x, y, estimate);
    }
  for (const RowResult& r : rows) {
    statistics_.rays += r.rays;
    found_ += r.found;
  }
  statistics_.camera_paths += static_cast<uint64_t>(b.area());
  statistics_.radius_min_pixels = radius_pixels;
  if (statistics_.radius_max_pixels == 0) statistics_.radius_max_pixels = radius_pixels;
}

EstimatorStatistics PhotonMapping::statistics() const {
  EstimatorStatistics s = statistics_;
  if (!photons_can_count_)
    s.notes.push_back(
        "no path of this scene belongs to the routes of the photons (no material has a specular "
        "lobe, for instance), and no photons were needed");
  explain_darkness(found_, s);
  return s;
}

}  // namespace nephroid
