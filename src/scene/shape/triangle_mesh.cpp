// Triangle meshes: hit attributes, areas and light sampling. Embree finds the hits; intersect() is
// the reference of the tests. fill() runs once per ray and has a short path for meshes without
// normals and tangents. Orientation, texture frame and error bound: pbrt-v4, sections 6.5 and 6.8.
#include <stdexcept>
#include <string>

#include "core/counted.h"
#include "core/warps.h"
#include "scene/shape/closed_mesh.h"
#include "scene/shape/shape.h"
#include "scene/shape/solid_angle.h"
#include "scene/shape/spherical_triangle.h"

namespace nephroid {
namespace {

/// Outside of these solid angles sampling by area is as good and more precise (pbrt-v4).
constexpr double kMinTriangleArea = 3e-4, kMaxTriangleArea = 6.22;

struct Corners {
  Vec3f p0, p1, p2;
};

struct Weights {
  float b0, b1, b2;
};

Corners corners_of(const MeshData& mesh, uint32_t triangle) {
  const uint32_t* v = &mesh.triangles[3 * size_t{triangle}];
  return {mesh.positions[v[0]], mesh.positions[v[1]], mesh.positions[v[2]]};
}

template <class T>
T interpolate(const std::vector<T>& values, const uint32_t* v, const Weights& b) {
  return values[v[0]] * b.b0 + values[v[1]] * b.b1 + values[v[2]] * b.b2;
}

/// Twice the area times the normal, in double, where differences of floats are (almost) exact.
Vec3d edge_cross(const Corners& c) {
  const Vec3d p0 = to_double(c.p0);
  return (to_double(c.p1) - p0).cross(to_double(c.p2) - p0);
}

inline Vec3f unit_normal(const Corners& c) {
  const Vec3d n = edge_cross(c);
  const double l2 = n.dot(n);
  if (!(l2 > 0.0)) return {0, 0, 1};
  return to_float(n * (1.0 / std::sqrt(l2)));
}

void set_point(const Corners& c, const Weights& b, Vec3f* p, Vec3f* p_error) {
  const Vec3f q0 = c.p0 * b.b0, q1 = c.p1 * b.b1, q2 = c.p2 * b.b2;
  *p = q0 + q1 + q2;
  // Beyond the rounding of p itself: the ray tracer's plane distances have rounding errors
  // proportional to the triangle's size, also along axes on which all coordinates are zero.
  const float extent = std::max(max_component(abs(c.p1 - c.p0)), max_component(abs(c.p2 - c.p0)));
  *p_error = (abs(q0) + abs(q1) + abs(q2)) * gamma_bound(7) + Vec3f(extent * gamma_bound(6));
}

/// Texture coordinates over a triangle: differences to corner 2, and their determinant.
struct TextureEdges {
  Vec2f d02, d12;
  double determinant;
  bool degenerate() const { return std::abs(determinant) < 1e-9; }

  /// Derivatives by u and v of a quantity with these differences to corner 2.
  void derivatives(const Vec3f& q02, const Vec3f& q12, Vec3f* by_u, Vec3f* by_v) const {
    const double inverse = 1.0 / determinant;
    const Vec3d a = to_double(q02), b = to_double(q12);
    *by_u = to_float((a * double(d12.y) - b * double(d02.y)) * inverse);
    *by_v = to_float((b * double(d02.x) - a * double(d12.x)) * inverse);
  }
};

TextureEdges texture_edges(const MeshData& mesh, const uint32_t* v) {
  TextureEdges t;
  if (mesh.uvs.empty()) {
    t.d02 = Vec2f(-1, -1);
    t.d12 = Vec2f(0, -1);
    t.determinant = 1.0;
    return t;
  }
  const Vec2f uv0 = mesh.uvs[v[0]], uv1 = mesh.uvs[v[1]], uv2 = mesh.uvs[v[2]];
  t.d02 = uv0 - uv2;
  t.d12 = uv1 - uv2;
  t.determinant = double(t.d02.x) * t.d12.y - double(t.d02.y) * t.d12.x;
  return t;
}

Vec2f texture_point(const MeshData& mesh, const uint32_t* v, const Weights& b) {
  // Default texture coordinates of the corners: (0,0), (1,0), (1,1).
  if (mesh.uvs.empty()) return {b.b1 + b.b2, b.b2};
  return interpolate(mesh.uvs, v, b);
}

/// The geometric normal towards the outside. `ns` gets the interpolated normal, not normalised;
/// null if the mesh has none or they cancel.
inline Vec3f outside_normal(const MeshData& mesh, bool flip, const Corners& c, const uint32_t* v,
                            const Weights& b, Vec3f* ns) {
  Vec3f n = unit_normal(c);
  if (flip) n = -n;
  *ns = mesh.normals.empty() ? Vec3f(0, 0, 0) : interpolate(mesh.normals, v, b);
  return dot(n, *ns) < 0.0f ? -n : n;
}

/// Normal and frames of a triangle without vertex attributes: the short path, since most hits take
/// it.
void fill_plain(const Corners& c, bool flip, SurfaceInteraction& out) {
  out.dpdu = out.shading_dpdu = c.p1 - c.p0;
  out.dpdv = out.shading_dpdv = c.p2 - c.p1;
  const Vec3d p0 = to_double(c.p0), e1 = to_double(c.p1) - p0, e2 = to_double(c.p2) - p0;
  const Vec3d n = e1.cross(e2);
  const double n2 = n.dot(n), x2 = e1.dot(e1);
  if (!(n2 > 0.0)) {
    out.ng = Vec3f(0, 0, 1);
    out.shading = Frame();
    return;
  }
  const Vec3d z = n * ((flip ? -1.0 : 1.0) / std::sqrt(n2)), x = e1 * (1.0 / std::sqrt(x2));
  out.ng = out.shading.z = to_float(z);
  out.shading.x = to_float(x);
  out.shading.y = to_float(z.cross(x));
}

/// Replaces the geometric shading frame by that of the mesh's normals and tangents.
void fill_shading(const MeshData& mesh, const uint32_t* v, const Weights& b, const Vec3f& normal,
                  const TextureEdges& texture, SurfaceInteraction& out) {
  const bool has_normal = max_component(abs(normal)) > 0.0f;
  const Vec3f ns = has_normal ? normalize(normal) : out.ng;
  Vec3f ss = out.dpdu;
  if (!mesh.tangents.empty()) {
    const Vec3f tangent = interpolate(mesh.tangents, v, b);
    if (max_component(abs(tangent)) > 0.0f) ss = tangent;
  }
  Vec3f ts = cross(ns, ss);
  if (max_component(abs(ts)) > 0.0f)
    ss = cross(ts, ns);
  else
    coordinate_system(ns, &ss, &ts);
  out.shading = Frame::from_z_and_tangent(ns, ss);
  out.shading_dpdu = ss;
  out.shading_dpdv = ts;
  if (mesh.normals.empty()) return;

  const Vec3f n0 = mesh.normals[v[0]], n1 = mesh.normals[v[1]], n2 = mesh.normals[v[2]];
  if (!texture.degenerate()) {
    texture.derivatives(n0 - n2, n1 - n2, &out.dndu, &out.dndv);
    return;
  }
  const Vec3f turn = cross(n2 - n0, n1 - n0);
  if (max_component(abs(turn)) > 0.0f) coordinate_system(normalize(turn), &out.dndu, &out.dndv);
}

}  // namespace

TriangleMesh::TriangleMesh(MeshData data, bool flip) : data_(std::move(data)), flip_(flip) {
  for (const uint32_t index : data_.triangles)
    if (index >= data_.positions.size())
      throw std::invalid_argument("triangle mesh: vertex index " + std::to_string(index) +
                                  " is out of range, the mesh has " +
                                  counted(data_.positions.size(), "vertex", "vertices"));
}

uint32_t TriangleMesh::primitive_count() const {
  return static_cast<uint32_t>(data_.triangles.size() / 3);
}

Bounds3f TriangleMesh::bounds(uint32_t primitive) const {
  const Corners c = corners_of(data_, primitive);
  Bounds3f box(c.p0);
  box.extendBy(c.p1);
  box.extendBy(c.p2);
  return box;
}

std::optional<ShapeHit> TriangleMesh::intersect(uint32_t primitive, const Ray& ray,
                                                float t_min) const {
  const Corners c = corners_of(data_, primitive);
  const Vec3d p0 = to_double(c.p0), d = to_double(ray.d), from = to_double(ray.o) - p0;
  const Vec3d e1 = to_double(c.p1) - p0, e2 = to_double(c.p2) - p0;
  const Vec3d side = d.cross(e2);
  const double determinant = e1.dot(side);
  if (determinant == 0.0) return std::nullopt;
  const double u = from.dot(side) / determinant;
  const Vec3d other = from.cross(e1);
  const double v = d.dot(other) / determinant;
  if (!(u >= 0.0 && v >= 0.0 && u + v <= 1.0)) return std::nullopt;
  const float t = static_cast<float>(e2.dot(other) / determinant);
  if (!(t > t_min && t < ray.t_max)) return std::nullopt;
  return ShapeHit{t, Vec2f(static_cast<float>(u), static_cast<float>(v))};
}

void TriangleMesh::fill(uint32_t primitive, const Vec2f& barycentric, const Ray&, float,
                        SurfaceInteraction& out) const {
  const Weights b{1.0f - barycentric.x - barycentric.y, barycentric.x, barycentric.y};
  const uint32_t* v = &data_.triangles[3 * size_t{primitive}];
  const Corners c = corners_of(data_, primitive);
  set_point(c, b, &out.p, &out.p_error);
  out.uv = texture_point(data_, v, b);
  if (!data_.second_uvs.empty() || !data_.colors.empty()) {
    out.mesh = &data_;
    out.barycentric = barycentric;
  }
  out.face_index = data_.face_indices.empty() ? 0 : data_.face_indices[primitive];

  out.dndu = out.dndv = Vec3f(0, 0, 0);
  if (data_.uvs.empty() && data_.normals.empty() && data_.tangents.empty()) {
    fill_plain(c, flip_, out);
    return;
  }

  Vec3f ns;
  out.ng = outside_normal(data_, flip_, c, v, b, &ns);
  const TextureEdges texture = texture_edges(data_, v);
  if (data_.uvs.empty()) {
    out.dpdu = c.p1 - c.p0;
    out.dpdv = c.p2 - c.p1;
  } else if (texture.degenerate()) {
    coordinate_system(-unit_normal(c), &out.dpdu, &out.dpdv);
  } else {
    texture.derivatives(c.p0 - c.p2, c.p1 - c.p2, &out.dpdu, &out.dpdv);
  }
  if (!data_.normals.empty() || !data_.tangents.empty()) {
    fill_shading(data_, v, b, ns, texture, out);
    return;
  }
  out.shading = Frame::from_z_and_tangent(out.ng, out.dpdu);
  out.shading_dpdu = out.dpdu;
  out.shading_dpdv = out.dpdv;
}

float TriangleMesh::area(uint32_t primitive) const {
  return static_cast<float>(0.5 * edge_cross(corners_of(data_, primitive)).length());
}

namespace {

ShapeSample sample_at(const MeshData& mesh, bool flip, uint32_t primitive, const Weights& b,
                      float pdf) {
  const uint32_t* v = &mesh.triangles[3 * size_t{primitive}];
  const Corners c = corners_of(mesh, primitive);
  ShapeSample s;
  set_point(c, b, &s.p, &s.p_error);
  Vec3f ns;
  s.ng = outside_normal(mesh, flip, c, v, b, &ns);
  s.uv = texture_point(mesh, v, b);
  s.pdf = pdf;
  return s;
}

SphericalTriangle seen_triangle(const Corners& c, const Vec3f& from) {
  const Vec3d o = to_double(from);
  return {to_double(c.p0) - o, to_double(c.p1) - o, to_double(c.p2) - o};
}

bool sampled_by_direction(const SphericalTriangle& triangle) {
  return triangle.solid_angle() >= kMinTriangleArea && triangle.solid_angle() <= kMaxTriangleArea;
}

/// Intersection of the direction w from `from`, which points into the triangle.
Weights weights_along(const Corners& c, const Vec3f& from, const Vec3d& w) {
  const Vec3d p0 = to_double(c.p0), e1 = to_double(c.p1) - p0, e2 = to_double(c.p2) - p0;
  const Vec3d o = to_double(from) - p0, side = w.cross(e2);
  const double inverse = 1.0 / e1.dot(side);
  const double b1 = std::clamp(o.dot(side) * inverse, 0.0, 1.0);
  const double b2 = std::clamp(w.dot(o.cross(e1)) * inverse, 0.0, 1.0 - b1);
  const float f1 = static_cast<float>(b1), f2 = static_cast<float>(b2);
  return {std::max(0.0f, 1.0f - f1 - f2), f1, f2};
}

}  // namespace

std::optional<ShapeSample> TriangleMesh::sample_area(uint32_t primitive, const Vec2f& u) const {
  const float a = area(primitive);
  if (!(a > 0.0f) || !std::isfinite(1.0f / a)) return std::nullopt;
  const Vec2f b = square_to_triangle(u);
  return sample_at(data_, flip_, primitive, {b.x, b.y, std::max(0.0f, 1.0f - b.x - b.y)}, 1.0f / a);
}

std::optional<ShapeSample> TriangleMesh::sample_towards(uint32_t primitive, const Vec3f& from,
                                                        const Vec2f& u) const {
  const Corners c = corners_of(data_, primitive);
  const SphericalTriangle seen = seen_triangle(c, from);
  if (!sampled_by_direction(seen)) return seen_from(sample_area(primitive, u), from);
  return sample_at(data_, flip_, primitive, weights_along(c, from, seen.sample(u)),
                   static_cast<float>(1.0 / seen.solid_angle()));
}

float TriangleMesh::pdf_towards(uint32_t primitive, const Vec3f& from, const Vec3f& p,
                                const Vec3f& ng) const {
  const SphericalTriangle seen = seen_triangle(corners_of(data_, primitive), from);
  if (sampled_by_direction(seen)) return static_cast<float>(1.0 / seen.solid_angle());
  const float a = area(primitive);
  if (!(a > 0.0f) || !std::isfinite(1.0f / a)) return 0.0f;
  return area_to_solid_angle(1.0f / a, from, p, ng);
}

void TriangleMesh::normal_bounds(uint32_t primitive, Vec3f* axis, float* cos_half_angle) const {
  const uint32_t* v = &data_.triangles[3 * size_t{primitive}];
  const Weights third{1.0f / 3.0f, 1.0f / 3.0f, 1.0f / 3.0f};
  Vec3f ns;
  *axis = outside_normal(data_, flip_, corners_of(data_, primitive), v, third, &ns);
  *cos_half_angle = 1.0f;
  // Corner normals on both sides of the plane: the outside varies within the triangle.
  if (data_.normals.empty()) return;
  for (int i = 0; i < 3; ++i)
    if (dot(*axis, data_.normals[v[i]]) < 0.0f) *cos_half_angle = -1.0f;
}

bool TriangleMesh::is_inside_out() const {
  return is_closed_inside_out(data_.positions, primitive_count(), [this](size_t face) {
    const Corners c = corners_of(data_, static_cast<uint32_t>(face));
    const uint32_t* v = &data_.triangles[3 * face];
    Vec3f unused;
    const Weights center{1.0f / 3, 1.0f / 3, 1.0f / 3};
    const Vec3f outside = outside_normal(data_, flip_, c, v, center, &unused);
    if (dot(outside, unit_normal(c)) < 0.0f) return OutsideRing{{v[0], v[2], v[1], v[1]}};
    return OutsideRing{{v[0], v[1], v[2], v[2]}};
  });
}

}  // namespace nephroid
