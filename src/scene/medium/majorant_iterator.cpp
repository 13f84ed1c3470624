// Walks through a grid of majorants; see medium.h. It must not know what the majorants bound.
// Paper: Amanatides & Woo 1987, A Fast Voxel Traversal Algorithm.
#include "scene/medium/medium.h"

namespace nephroid {

MajorantIterator::MajorantIterator(const Vec3d& o, const Vec3d& d, float t_min, float t_max,
                                   const SampledSpectrum& sigma_t, const float* scales,
                                   const int resolution[3])
    : t_(t_min), t_end_(t_max), sigma_(sigma_t), scales_(scales) {
  for (int axis = 0; axis < 3; ++axis) {
    const int n = resolution[axis];
    resolution_[axis] = n;
    const double at = (o[axis] + double(t_min) * d[axis]) * n;
    cell_[axis] = static_cast<int>(std::clamp(at, 0.0, n - 1.0));
    step_[axis] = d[axis] < 0.0 ? -1 : 1;
    origin_[axis] = o[axis];
    per_cell_[axis] = 1.0 / (d[axis] * n);
    set_crossing(axis, d[axis] != 0.0);
  }
}

void MajorantIterator::set_crossing(int axis, bool moves) {
  // Computed from the cell's number, not accumulated, so that errors do not grow along the ray.
  const double wall = cell_[axis] + (step_[axis] > 0 ? 1 : 0);
  const double t = (wall - origin_[axis] * resolution_[axis]) * per_cell_[axis];
  next_crossing_[axis] = moves ? t : std::numeric_limits<double>::infinity();
}

std::optional<MajorantSegment> MajorantIterator::next() {
  if (!(t_ < t_end_)) return std::nullopt;
  MajorantSegment segment{t_, t_end_, sigma_};
  if (!scales_) {
    t_ = t_end_;
    return segment;
  }
  // Skips cells that the ray only touches, and joins neighbours with the same majorant.
  float scale = scale_here();
  for (;;) {
    const double* c = next_crossing_;
    const int axis = c[0] < c[1] ? (c[0] < c[2] ? 0 : 2) : (c[1] < c[2] ? 1 : 2);
    const bool ends = !(c[axis] < t_end_);
    cell_[axis] += step_[axis];
    if (ends || cell_[axis] < 0 || cell_[axis] >= resolution_[axis]) {
      t_ = t_end_;
      break;
    }
    t_ = std::max(t_, static_cast<float>(c[axis]));
    set_crossing(axis, true);
    const float next_scale = scale_here();
    if (!(t_ > segment.t_min))
      scale = next_scale;
    else if (next_scale != scale)
      break;
  }
  segment.t_max = t_;
  segment.sigma_maj = sigma_ * scale;
  return segment;
}

}  // namespace nephroid
