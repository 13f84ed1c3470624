#include "integrator/learned_emission.h"

#include "core/parallel.h"
#include "integrator/compiled_plan.h"
#include "integrator/merge_pass.h"
#include "integrator/photon_pass.h"

namespace nephroid {

namespace {

constexpr uint64_t kStream = 0x6c6561726e;  // "learn"
constexpr uint32_t kRounds = 3;
/// Camera walks of a round, about.
constexpr int kWalks = 1 << 13;
/// Paths of a round; more in rounds after one that found little.
constexpr int64_t kPaths = 1 << 14, kMostPaths = 1 << 18;
constexpr size_t kLittle = 256;

/// Every how many pixels, in each direction, a camera walk starts.
int pixel_stride(const PixelBounds& b) {
  int stride = 1;
  while (b.area() / (int64_t{stride} * stride) > kWalks) ++stride;
  return stride;
}

/// What the camera sees: points on surfaces, as photons, and how far around one light counts.
struct VisiblePoints {
  PhotonGrid grid;
  PixelFootprint footprint;
  Vec3f eye{0, 0, 0};
  float radius_pixels = 0;

  bool has_near(const Vec3f& p) const {
    bool any = false;
    grid.query(p, radius_pixels * footprint.width(length(p - eye)),
               [&](const Photon&, float) { any = true; });
    return any;
  }
};

/// Points where camera walks of the pass would merge photons.
VisiblePoints visible_points(const Scene& scene, const Film& film, const OwnedRoutes& owned,
                             const PhotonPass& pass, const IntegratorOptions& options) {
  const PixelBounds& b = film.bounds();
  const int stride = pixel_stride(b);
  const int rows = (b.height() + stride - 1) / stride;
  std::vector<std::vector<Photon>> found(static_cast<size_t>(rows));
  const int shift_x = static_cast<int>(pass.trace.key.pass) % stride,
            shift_y = static_cast<int>(pass.trace.key.pass / 2) % stride;
  parallel_chunks(rows, 1, [&](int64_t row, int64_t, int64_t) {
    const int y = b.y0 + static_cast<int>(row) * stride + shift_y;
    if (y >= b.y1) return;
    for (int x = b.x0 + shift_x; x < b.x1; x += stride) {
      PathSampler sampler(pass.point, hash_combine(pass.trace.key.seed, kStream, x, y));
      CameraPath path = start_merging_path(scene, x, y, sampler, pass);
      if (!(path.camera_weight > 0)) continue;
      auto keep = [&](const Walk&, const MergePoint& at) {
        Photon point;
        point.p = at.vertex.surface.p;
        found[static_cast<size_t>(row)].push_back(point);
      };
      MergeWalkVisitor visitor(owned, keep);
      random_walk(scene, TransportMode::kRadiance, options.max_depth, path.walk, sampler, visitor);
    }
  });
  std::vector<Photon> points;
  for (const auto& row : found) points.insert(points.end(), row.begin(), row.end());
  // Wide enough to leave no gaps between the walks, and to reach as far as a merge.
  const float radius = std::max(2.0f * static_cast<float>(stride), first_radius(options));
  const Vec3f eye = scene.camera->camera_to_world(pass.trace.time).point(Vec3f(0, 0, 0));
  return {PhotonGrid(std::move(points)), pass.footprint, eye, radius};
}

EmissionGuide learn(uint64_t seed, const Scene& scene, const Film& film, const OwnedRoutes& owned,
                    const IntegratorOptions& options) {
  if (!photons_can_count(owned)) return {};
  EmissionGuide guide;
  std::vector<UsefulStart> useful;
  int64_t paths = kPaths, all_paths = 0;
  for (uint32_t round = 0; round < kRounds; ++round) {
    IntegratorOptions of_round = options;
    of_round.photons_per_pass = paths;
    PhotonPass pass =
        start_photon_pass({hash_combine(seed, kStream), round}, scene, film, of_round);
    pass.trace.guide = &guide;
    const VisiblePoints visible = visible_points(scene, film, owned, pass, options);
    const std::vector<UsefulStart> found =
        trace_useful_starts(scene, owned, pass.trace, 0, paths,
                            [&](const Photon& photon) { return visible.has_near(photon.p); });
    useful.insert(useful.end(), found.begin(), found.end());
    all_paths += paths;
    guide = EmissionGuide(scene, useful, static_cast<double>(all_paths));
    if (useful.size() < kLittle) paths = std::min(4 * paths, kMostPaths);
  }
  return guide;
}

}  // namespace

const EmissionGuide& LearnedEmission::guide(uint64_t seed, const Scene& scene, const Film& film,
                                            const OwnedRoutes& owned,
                                            const IntegratorOptions& options) {
  if (!options.guides_emission) return kUnguided;
  if (guide_ && seed_ == seed) return *guide_;
  seed_ = seed;
  const EstimatorKind kind = owned.routes->groups()[owned.group].estimator;
  if (kind == EstimatorKind::kPathAndPhotons) {
    // Photons are of use to it where those of a route of caustics would be.
    const CompiledPlan plan =
        compile_plan({{{"caustic", "C.*[DG]S+[DG]?L", EstimatorKind::kPhotons, {}},
                       {"rest", ".*", EstimatorKind::kPath, {}}},
                      {}},
                     scene);
    constexpr size_t kCaustics = 0;  // the group of the first route
    const auto routes = std::make_shared<const Routes>(plan.compilation.routes);
    guide_ = learn(seed, scene, film, {routes, plan.symbols, kCaustics}, options);
  } else {
    guide_ = learn(seed, scene, film, owned, options);
  }
  return *guide_;
}

}  // namespace nephroid
