// Transforms, error bounds, areas and area sampling of quadrics. It knows the surface only through
// the virtual functions of quadric.h. Error bounds: pbrt-v4 section 6.8, for double arithmetic
// rounded once to float.
#include "scene/shape/quadric.h"

#include "scene/shape/solid_angle.h"

namespace nephroid {
namespace {

// Row vectors: p' = p * M, so M's rows are the images of the axes.
Vec3d transform_vector(const Mat44d& m, const Vec3d& v) {
  return {v.x * m[0][0] + v.y * m[1][0] + v.z * m[2][0],
          v.x * m[0][1] + v.y * m[1][1] + v.z * m[2][1],
          v.x * m[0][2] + v.y * m[1][2] + v.z * m[2][2]};
}
Vec3d transform_point(const Mat44d& m, const Vec3d& p) {
  return transform_vector(m, p) + Vec3d(m[3][0], m[3][1], m[3][2]);
}
/// v times the transposed 3x3 part; with the inverse matrix this maps normals.
Vec3d transform_transposed(const Mat44d& m, const Vec3d& v) {
  return {v.x * m[0][0] + v.y * m[0][1] + v.z * m[0][2],
          v.x * m[1][0] + v.y * m[1][1] + v.z * m[1][2],
          v.x * m[2][0] + v.y * m[2][1] + v.z * m[2][2]};
}
Vec3d unit_normal(const Vec3d& v) {
  return v / std::sqrt(v.dot(v));
}

double determinant3(const Mat44d& m) {
  const Vec3d a(m[0][0], m[0][1], m[0][2]), b(m[1][0], m[1][1], m[1][2]);
  return a.cross(b).dot(Vec3d(m[2][0], m[2][1], m[2][2]));
}

/// True if the map keeps all angles, up to rounding in the file.
bool keeps_angles(const Mat44d& m) {
  Vec3d axis[3];
  for (int i = 0; i < 3; ++i) axis[i] = Vec3d(m[i][0], m[i][1], m[i][2]);
  const double s2 = axis[0].dot(axis[0]);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j <= i; ++j)
      if (std::abs(axis[i].dot(axis[j]) - (i == j ? s2 : 0.0)) > 1e-6 * s2) return false;
  return true;
}

}  // namespace

double positive_angle(double y, double x) {
  const double phi = std::atan2(y, x);
  return phi < 0.0 ? phi + kTwoPiDouble : phi;
}

Quadric::Quadric(const Transform& object_to_world, bool reverse_orientation)
    : to_world_(object_to_world.m),
      to_object_(object_to_world.inverse),
      flip_(reverse_orientation),
      similarity_(keeps_angles(object_to_world.m)),
      determinant_(std::abs(determinant3(object_to_world.m))) {
  for (int j = 0; j < 3; ++j) {
    error_offset_[j] = std::abs(to_world_[3][j]);
    for (int i = 0; i < 3; ++i) {
      error_scale_[i][j] = 0.0;
      for (int k = 0; k < 3; ++k)
        error_scale_[i][j] += std::abs(to_object_[i][k]) * std::abs(to_world_[k][j]);
      error_offset_[j] += std::abs(to_object_[3][i]) * std::abs(to_world_[i][j]);
    }
  }
}

void Quadric::set_bounds(double radius, double z_min, double z_max, double ball) {
  const auto extent = [this](int axis, double r, bool with_z) {
    return r * std::sqrt(sqr(to_world_[0][axis]) + sqr(to_world_[1][axis]) +
                         (with_z ? sqr(to_world_[2][axis]) : 0.0));
  };
  for (int axis = 0; axis < 3; ++axis) {
    const double center = to_world_[3][axis], round = extent(axis, radius, false);
    const double at_min = z_min * to_world_[2][axis], at_max = z_max * to_world_[2][axis];
    double low = std::min(at_min, at_max) - round, high = std::max(at_min, at_max) + round;
    if (ball > 0.0) {
      const double whole = extent(axis, ball, true);
      low = std::max(low, -whole);
      high = std::min(high, whole);
    }
    // Rounded outwards, by more than the error of the double arithmetic.
    bounds_.min[axis] = std::nextafter(static_cast<float>(center + low), -kInfinity);
    bounds_.max[axis] = std::nextafter(static_cast<float>(center + high), kInfinity);
  }
}

Vec3d Quadric::to_object(const Vec3f& p) const {
  return transform_point(to_object_, to_double(p));
}
Vec3d Quadric::vector_to_object(const Vec3d& v) const {
  return transform_vector(to_object_, v);
}

Vec3f Quadric::world_normal(const Vec3d& n) const {
  const Vec3d world = unit_normal(transform_transposed(to_object_, n));
  return to_float(flip_ ? -world : world);
}

Vec3d Quadric::normal_to_object(const Vec3f& n) const {
  return unit_normal(transform_transposed(to_world_, to_double(n)));
}

Vec3f Quadric::world_point(const Vec3d& p, Vec3f* error) const {
  const Vec3d world = transform_point(to_world_, p);
  // One rounding to float, plus the double rounding of the two transforms and the intersection.
  constexpr double kFloatRounding = 0x1.0001p-24, kDoubleRounding = 32.0 * 0x1p-53;
  for (int j = 0; j < 3; ++j) {
    const double in_double = std::abs(world.x) * error_scale_[0][j] +
                             std::abs(world.y) * error_scale_[1][j] +
                             std::abs(world.z) * error_scale_[2][j] + error_offset_[j];
    (*error)[j] =
        static_cast<float>(std::abs(world[j]) * kFloatRounding + in_double * kDoubleRounding);
  }
  return to_float(world);
}

std::optional<ShapeHit> Quadric::intersect(uint32_t, const Ray& ray, float t_min) const {
  const Vec3d o = to_object(ray.o), d = vector_to_object(to_double(ray.d));
  const Roots found = roots(o, d);
  for (int i = 0; i < found.count; ++i) {
    const float t = static_cast<float>(found.t[i]);
    if (!(t > t_min && t < ray.t_max)) continue;
    if (contains(project(o + d * found.t[i]))) return ShapeHit{.t = t};
  }
  return std::nullopt;
}

void Quadric::fill(uint32_t, const Vec2f& hit_uv, const Ray& ray, float t,
                   SurfaceInteraction& out) const {
  // Intersects again in double: float t and uv would move the point along a large surface.
  const Vec3d o = to_object(ray.o), d = vector_to_object(to_double(ray.d));
  const Roots found = roots(o, d);
  Vec3d p;
  if (found.count == 0) {
    // By rounding, a grazing ray can miss here.
    p = ray.d == Vec3f(0) ? point_at(Vec2d(hit_uv.x, hit_uv.y)) : project(o + d * double{t});
  } else {
    const bool second =
        found.count == 2 && std::abs(found.t[1] - t) < std::abs(found.t[0] - double(t));
    p = project(o + d * found.t[second ? 1 : 0]);
  }
  out.p = world_point(p, &out.p_error);
  const Vec2d uv = uv_of(p);
  out.uv = Vec2f(static_cast<float>(uv.x), static_cast<float>(uv.y));
  out.face_index = 0;

  const Derivatives by = derivatives_at(p);
  out.dpdu = to_float(transform_vector(to_world_, by.dpdu));
  out.dpdv = to_float(transform_vector(to_world_, by.dpdv));
  // n' = N n / |N n|, N the inverse transpose; its derivative has no component along n'.
  const Vec3d scaled = transform_transposed(to_object_, normal_of(p));
  const double scale = (flip_ ? -1.0 : 1.0) / std::sqrt(scaled.dot(scaled));
  const Vec3d n = scaled * scale;
  const auto normal_derivative = [&](const Vec3d& local) {
    const Vec3d v = transform_transposed(to_object_, local) * scale;
    return to_float(v - n * n.dot(v));
  };
  out.ng = to_float(n);
  out.dndu = normal_derivative(by.dndu);
  out.dndv = normal_derivative(by.dndv);
  out.shading = Frame::from_z_and_tangent(out.ng, out.dpdu);
  out.shading_dpdu = out.dpdu;
  out.shading_dpdv = out.dpdv;
}

float Quadric::area(uint32_t) const {
  if (similarity_) return static_cast<float>(local_area() * std::pow(determinant_, 2.0 / 3.0));
  // Gauss-Legendre on a grid of cells over (u,v): exact for disks, good to about 1e-5 for stretches
  // up to 1:20. Called once per light.
  constexpr int kCells = 24;
  constexpr double kNode = 0.77459666924148337704;  // sqrt(3/5)
  constexpr double kNodes[3] = {0.5 - 0.5 * kNode, 0.5, 0.5 + 0.5 * kNode};
  constexpr double kWeights[3] = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
  double sum = 0.0;
  for (int i = 0; i < 3 * kCells; ++i)
    for (int j = 0; j < 3 * kCells; ++j) {
      const Vec3d p =
          point_at(Vec2d((i / 3 + kNodes[i % 3]) / kCells, (j / 3 + kNodes[j % 3]) / kCells));
      const Derivatives by = derivatives_at(p);
      const Vec3d cross =
          transform_vector(to_world_, by.dpdu).cross(transform_vector(to_world_, by.dpdv));
      sum += kWeights[i % 3] * kWeights[j % 3] * std::sqrt(cross.dot(cross));
    }
  return static_cast<float>(sum / (kCells * kCells));
}

float Quadric::pdf_a(const Vec3f& ng) const {
  const double local = local_area();
  if (!(local > 0.0)) return 0.0f;
  if (similarity_) return static_cast<float>(1.0 / (local * std::pow(determinant_, 2.0 / 3.0)));
  // |M^-T n_object| = 1 / |M^T n_world| for unit normals.
  const Vec3d v = transform_transposed(to_world_, to_double(ng));
  return static_cast<float>(std::sqrt(v.dot(v)) / (determinant_ * local));
}

ShapeSample Quadric::sample_of(const Vec3d& p, float pdf) const {
  ShapeSample s;
  s.p = world_point(p, &s.p_error);
  s.ng = world_normal(normal_of(p));
  const Vec2d uv = uv_of(p);
  s.uv = Vec2f(static_cast<float>(uv.x), static_cast<float>(uv.y));
  s.pdf = pdf;
  return s;
}

std::optional<ShapeSample> Quadric::sample_area(uint32_t, const Vec2f& u) const {
  if (!(local_area() > 0.0)) return std::nullopt;
  ShapeSample s = sample_of(local_sample(u), 0.0f);
  s.pdf = pdf_a(s.ng);
  if (!(s.pdf > 0.0f) || !std::isfinite(s.pdf)) return std::nullopt;
  return s;
}

std::optional<ShapeSample> Quadric::sample_towards(uint32_t primitive, const Vec3f& from,
                                                   const Vec2f& u) const {
  return seen_from(sample_area(primitive, u), from);
}

float Quadric::pdf_towards(uint32_t, const Vec3f& from, const Vec3f& p, const Vec3f& ng) const {
  return area_to_solid_angle(pdf_a(ng), from, p, ng);
}

}  // namespace nephroid
