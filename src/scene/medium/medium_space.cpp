// The box of a medium; see medium_space.h.
#include "scene/medium/medium_space.h"

namespace nephroid {

namespace {

/// Maps the box to the unit cube, row-vector convention.
Mat44d cube_from_medium(const Vec3d& p_min, const Vec3d& p_max) {
  Mat44d m;
  for (int i = 0; i < 3; ++i) {
    m[i][i] = 1.0 / (p_max[i] - p_min[i]);
    m[3][i] = -p_min[i] / (p_max[i] - p_min[i]);
  }
  return m;
}

}  // namespace

MediumSpace::MediumSpace(const Mat44d& world_from_medium, const Vec3d& p_min, const Vec3d& p_max)
    : medium_from_world_(world_from_medium.inverse()),
      cube_from_world_(medium_from_world_ * cube_from_medium(p_min, p_max)) {}

Vec3d MediumSpace::map_point(const Mat44d& m, const Vec3f& p) {
  const double x = p.x, y = p.y, z = p.z;
  return {x * m[0][0] + y * m[1][0] + z * m[2][0] + m[3][0],
          x * m[0][1] + y * m[1][1] + z * m[2][1] + m[3][1],
          x * m[0][2] + y * m[1][2] + z * m[2][2] + m[3][2]};
}

std::optional<CubeRay> MediumSpace::overlap(const Ray& ray, float t_max) const {
  CubeRay r;
  r.o = map_point(cube_from_world_, ray.o);
  const Mat44d& m = cube_from_world_;
  const double dx = ray.d.x, dy = ray.d.y, dz = ray.d.z;
  double t0 = 0.0, t1 = t_max;
  for (int i = 0; i < 3; ++i) {
    r.d[i] = dx * m[0][i] + dy * m[1][i] + dz * m[2][i];
    if (!std::isfinite(r.o[i]) || !std::isfinite(r.d[i])) return std::nullopt;
    if (r.d[i] == 0.0) {
      if (!(r.o[i] >= 0.0 && r.o[i] <= 1.0)) return std::nullopt;
      continue;
    }
    const double a = -r.o[i] / r.d[i], b = (1.0 - r.o[i]) / r.d[i];
    t0 = std::max(t0, std::min(a, b));
    t1 = std::min(t1, std::max(a, b));
  }
  r.t_min = static_cast<float>(t0);
  r.t_max = static_cast<float>(t1);
  if (!(r.t_min < r.t_max) || !std::isfinite(t1)) return std::nullopt;
  return r;
}

MediumSpace read_medium_box(const MediumDescription& description) {
  const ParameterSet& p = description.parameters;
  const Vec3f p0 = p.get_point3("p0").value_or(Vec3f(0, 0, 0));
  const Vec3f p1 = p.get_point3("p1").value_or(Vec3f(1, 1, 1));
  Vec3d lo, hi;
  for (int i = 0; i < 3; ++i) {
    lo[i] = std::min(p0[i], p1[i]);
    hi[i] = std::max(p0[i], p1[i]);
    const double width = hi[i] - lo[i];
    if (!(width > 0.0))
      throw SceneError(description.where, "\"p0\" and \"p1\" of medium \"" + description.name +
                                              "\" span no volume, expected opposite corners of "
                                              "a box");
  }
  return {description.transform.start, lo, hi};
}

}  // namespace nephroid
