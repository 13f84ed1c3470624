#include "integrator/learning/visible_points.h"

#include <algorithm>
#include <optional>

#include "core/parallel.h"
#include "integrator/photons/merge_radius.h"

namespace nephroid {

namespace {

constexpr uint64_t kVisiblePointStream = 0x7369676874;  // "sight"
/// Approximate limit of camera walks.
constexpr int kWalks = 1 << 13;
/// Largest number of rough vertices of a walk that looks for casters.
constexpr int kRoughVertices = 3;

/// Some pixels of a film, evenly spread, in rows. They differ from pass to pass.
struct SomePixels {
  SomePixels(const PixelBounds& b, uint32_t pass) : bounds(b) {
    while (b.area() / (int64_t{stride} * stride) > kWalks) ++stride;
    rows = (b.height() + stride - 1) / stride;
    // A crop can be narrower than the stride.
    shift_x = static_cast<int>(pass) % std::clamp(b.width(), 1, stride);
    shift_y = static_cast<int>(pass / 2) % std::clamp(b.height(), 1, stride);
  }
  /// Calls f(row, x, y), rows in parallel.
  template <class F>
  void for_each(PassControl& control, const F& f) const {
    parallel_chunks(control, rows, 1, [&](int64_t row, int64_t, int64_t) {
      const int y = bounds.y0 + static_cast<int>(row) * stride + shift_y;
      if (y >= bounds.y1) return;
      for (int x = bounds.x0 + shift_x; x < bounds.x1; x += stride) f(row, x, y);
    });
  }
  PixelBounds bounds;
  int stride = 1, rows = 0, shift_x = 0, shift_y = 0;
};

/// Points found by the walks of one row of pixels, or of all rows.
template <class T>
struct RowPoints {
  std::vector<T> points;
  uint64_t rays = 0;
};
template <class T>
RowPoints<T> joined(const std::vector<RowPoints<T>>& rows) {
  RowPoints<T> all;
  for (const RowPoints<T>& row : rows) {
    all.points.insert(all.points.end(), row.points.begin(), row.points.end());
    all.rays += row.rays;
  }
  return all;
}

/// Records the last vertices of runs of specular events that began behind a rough vertex.
class CasterVisitor {
 public:
  explicit CasterVisitor(std::vector<Vec3f>& casters) : casters_(casters) {}

  ClassMask useful(const WalkVertex& v) const { return v.classes_of(ClassMask::kAll); }
  bool scatters_in(const Medium&) const { return true; }
  bool looks_under_surfaces() const { return true; }
  void escape(const Walk&) { end_run(); }
  void emitter(const Walk&, const SurfaceInteraction&, const Light&) { end_run(); }
  void medium_emission(const Medium&, const SampledSpectrum&) {}
  void vertex(const Walk&, const WalkVertex& v, PathSampler&) { at_ = v.surface.p; }
  void medium_vertex(const Walk&, const MediumVertex& v, PathSampler&) { at_ = v.p; }
  bool scatter(const Walk&, const WalkEvent& event) {
    if (event.letter == EventClass::kSpecular) {
      if (rough_ > 0) last_ = at_;
      return true;
    }
    end_run();
    return ++rough_ <= kRoughVertices;
  }

 private:
  void end_run() {
    if (last_) casters_.push_back(*last_);
    last_.reset();
  }
  std::vector<Vec3f>& casters_;
  Vec3f at_{0, 0, 0};
  std::optional<Vec3f> last_;
  int rough_ = 0;
};

/// Starts a camera path at some pixels; `run(path, sampler, points of the row)` runs its walk.
template <class T, class Run>
RowPoints<T> walk_from(const Scene& scene, const SomePixels& pixels, const PhotonPass& pass,
                       const Run& run) {
  std::vector<RowPoints<T>> rows(pixels.rows);
  pixels.for_each(*pass.trace.control, [&](size_t row, int x, int y) {
    PathSampler sampler(pass.point, hash_combine(pass.trace.key.seed, kVisiblePointStream, x, y));
    CameraPath path = start_merging_path(scene, x, y, sampler, pass);
    if (!(path.camera_weight > 0)) return;
    run(path, sampler, rows[row].points);
    rows[row].rays += path.walk.rays;
  });
  return joined(rows);
}

}  // namespace

VisiblePoints visible_points(const Scene& scene, const FilmFormat& film, const OwnedRoutes& owned,
                             const PhotonPass& pass, const IntegratorOptions& options) {
  const SomePixels pixels(film.bounds(), pass.trace.key.pass);
  const auto run = [&](CameraPath& path, PathSampler& sampler, std::vector<Photon>& points) {
    auto keep = [&](const Walk&, const MergePoint& at) {
      Photon point;
      point.p = at.vertex.surface.p;
      points.push_back(point);
    };
    MergeWalkVisitor visitor(owned, keep);
    random_walk(scene, TransportMode::kRadiance, options.max_depth, path.walk, sampler, visitor);
  };
  RowPoints<Photon> all = walk_from<Photon>(scene, pixels, pass, run);
  // Wide enough to leave no gaps between walks and to cover a merge radius.
  const float radius = std::max(2.0f * static_cast<float>(pixels.stride),
                                first_radius(options, film.picture_pixels()));
  const Vec3f eye = scene.camera->camera_to_world(pass.trace.time).point(Vec3f(0, 0, 0));
  return {PhotonGrid(std::move(all.points)), pass.footprint, eye, radius, all.rays};
}

CausticCasters caustic_casters(const Scene& scene, const FilmFormat& film, const PhotonPass& pass,
                               const IntegratorOptions& options) {
  const SomePixels pixels(film.bounds(), pass.trace.key.pass);
  const auto run = [&](CameraPath& path, PathSampler& sampler, std::vector<Vec3f>& points) {
    CasterVisitor visitor(points);
    random_walk(scene, TransportMode::kRadiance, options.max_depth, path.walk, sampler, visitor);
  };
  RowPoints<Vec3f> all = walk_from<Vec3f>(scene, pixels, pass, run);
  return {std::move(all.points), all.rays};
}

}  // namespace nephroid
