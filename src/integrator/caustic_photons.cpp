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
  const PhotonPass pass = start_photon_pass(key, scene, film, options_);
  const int64_t photons = pass.trace.photons_per_pass;
  const float shrink =
      static_cast<float>(std::sqrt(memoryless_radius_squared(key.pass, options_.alpha)));
  const float radius_pixels = options_.radius * shrink;

  // A pixel's estimate is summed over the batches; its filter weight is the same in all of them.
  struct PixelEstimate {
    Rgb sum;
    float filter_weight = 1;
  };
  const size_t width = static_cast<size_t>(b.width());
  std::vector<PixelEstimate> pixels(static_cast<size_t>(b.area()));
  std::vector<RowResult> rows(static_cast<size_t>(b.height()));
  for (int64_t begin = 0; begin < photons;) {
    PhotonTrace trace =
        trace_batch(scene, routes_, route_, pass.trace, options_.memory_photons, begin);
    count_photons(trace, statistics_);
    if (trace.photons.empty()) continue;
    const PhotonGrid grid(std::move(trace.photons));

    parallel_chunks(b.height(), 1, [&](int64_t row, int64_t, int64_t) {
      const int y = b.y0 + static_cast<int>(row);
      RowResult& result = rows[static_cast<size_t>(row)];
      for (int x = b.x0; x < b.x1; ++x) {
        PathSampler sampler(pass.point, hash_combine(key.seed, kStream, x, y));
        CameraPath path = start_camera_path(scene, x, y, sampler, pass.trace.lambda, pass.u_time);
        SampledSpectrum sum;
        auto merge = [&](const Walk& walk, const WalkVertex& v, EyeState eye) {
          const float r = radius_pixels * pass.footprint.width(walk.length);
          if (!(r > 0.0f)) return;
          const MergeResult m =
              merge_photons(grid, routes_, route_, v, eye, walk.events + 1, options_.max_depth,
                            walk.lambda.secondary_terminated(), r);
          result.found += m.found;
          sum += walk.throughput * (m.reflected + m.hero) /
                 (static_cast<float>(photons) * kPi * r * r);
        };
        MergeWalkVisitor visitor(routes_, merge);
        if (path.camera_weight > 0)
          random_walk(scene, TransportMode::kRadiance, options_.max_depth, path.walk, sampler,
                      visitor);
        result.rays += path.walk.rays;
        PixelEstimate& pixel =
            pixels[static_cast<size_t>(row) * width + static_cast<size_t>(x - b.x0)];
        pixel.sum = pixel.sum + pass.weights.apply(sum) * path.camera_weight;
        pixel.filter_weight = path.filter_weight;
      }
    });
  }

  for (int y = b.y0; y < b.y1; ++y)
    for (int x = b.x0; x < b.x1; ++x) {
      const PixelEstimate& pixel =
          pixels[static_cast<size_t>(y - b.y0) * width + static_cast<size_t>(x - b.x0)];
      film.add(buffer_, x, y,
               clamp_component(pixel.sum, settings.max_component) * pixel.filter_weight);
    }
  for (const RowResult& r : rows) {
    statistics_.rays += r.rays;
    found_ += r.found;
  }
  statistics_.camera_paths += static_cast<uint64_t>(b.area());
  statistics_.radius_min_pixels = radius_pixels;
  if (statistics_.radius_max_pixels == 0) statistics_.radius_max_pixels = radius_pixels;
}

EstimatorStatistics CausticPhotons::statistics() const {
  EstimatorStatistics s = statistics_;
  if (!has_specular_material_)
    s.notes.push_back(
        "no material of the scene has a specular lobe: there are no caustics, and no "
        "photons were needed");
  explain_darkness(found_, s);
  return s;
}

}  // namespace nephroid
