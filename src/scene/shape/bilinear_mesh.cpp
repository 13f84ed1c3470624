// Meshes of bilinear patches: hits, texture frames and light sampling. The geometry of one patch is
// in bilinear_patch.h. Frames, orientation and choice of sampling method follow pbrt-v4, section
// 6.6.
#include <stdexcept>
#include <string>

#include "core/counted.h"
#include "scene/shape/bilinear_patch.h"
#include "scene/shape/closed_mesh.h"
#include "scene/shape/plane_rectangle.h"
#include "scene/shape/shape.h"
#include "scene/shape/solid_angle.h"

namespace nephroid {
namespace {

/// Samples [0,1] with density proportional to the line from a to b; u is the input of the inverse
/// cdf.
double sample_linear(double u, double a, double b) {
  if (!(a + b > 0.0)) return u;
  return std::min(1.0, u * (a + b) / (a + std::sqrt((1.0 - u) * a * a + u * b * b)));
}

/// Area elements at the corners, whose bilinear interpolation is the density of area sampling.
struct CornerWeights {
  double w00, w10, w01, w11;

  explicit CornerWeights(const BilinearPatch& patch)
      : w00(patch.cross(0, 0).length()),
        w10(patch.cross(1, 0).length()),
        w01(patch.cross(0, 1).length()),
        w11(patch.cross(1, 1).length()) {}
  double sum() const { return w00 + w10 + w01 + w11; }
  Imath::V2d sample(const Vec2f& u) const {
    const double v = sample_linear(u.y, w00 + w10, w01 + w11);
    return {sample_linear(u.x, w00 * (1 - v) + w01 * v, w10 * (1 - v) + w11 * v), v};
  }
  double pdf(double u, double v) const {
    return 4.0 * ((w00 * (1 - u) + w10 * u) * (1 - v) + (w01 * (1 - u) + w11 * u) * v) / sum();
  }
};

/// Rotates v by the smallest rotation that takes the unit vector `from` to the unit vector `to`.
Vec3d rotate_from_to(const Vec3d& from, const Vec3d& to, const Vec3d& v) {
  const Vec3d axis = from.cross(to);
  const double cosine = from.dot(to);
  // Opposite vectors: half a turn around an orthogonal axis, here v's component in that plane.
  if (cosine < -1.0 + 1e-12) return v - from * (2.0 * from.dot(v));
  const Vec3d moved = axis.cross(v);
  return v + moved + axis.cross(moved) / (1.0 + cosine);
}

class BilinearMesh final : public Shape {
 public:
  BilinearMesh(MeshData data, bool flip);
  uint32_t primitive_count() const override {
    return static_cast<uint32_t>(data_.quads.size() / 4);
  }
  const MeshData* flat_quads() const override {
    return rectangles_ == primitive_count() ? &data_ : nullptr;
  }
  Bounds3f bounds(uint32_t) const override;
  std::optional<ShapeHit> intersect(uint32_t, const Ray&, float t_min) const override;
  void fill(uint32_t, const Vec2f& hit_uv, const Ray&, float t, SurfaceInteraction&) const override;
  float area(uint32_t primitive) const override {
    return static_cast<float>(patch(primitive).area());
  }
  std::optional<ShapeSample> sample_area(uint32_t, const Vec2f&) const override;
  std::optional<ShapeSample> sample_towards(uint32_t, const Vec3f& from,
                                            const Vec2f&) const override;
  float pdf_towards(uint32_t, const Vec3f& from, const Vec3f& p, const Vec3f& ng) const override;
  void normal_bounds(uint32_t, Vec3f* axis, float* cos_half_angle) const override;
  bool is_inside_out() const override;
  std::optional<PlaneRectangle> rectangle(uint32_t primitive) const override {
    if (!is_rectangle_[primitive] || !has_one_normal(primitive)) return std::nullopt;
    return plane(primitive);
  }

 private:
  const uint32_t* corners(uint32_t primitive) const { return &data_.quads[4 * size_t{primitive}]; }
  /// True if there are no vertex normals, or if they are all equal.
  bool has_one_normal(uint32_t primitive) const {
    if (data_.normals.empty()) return true;
    const uint32_t* v = corners(primitive);
    const auto& n = data_.normals;
    return n[v[0]] == n[v[1]] && n[v[0]] == n[v[2]] && n[v[0]] == n[v[3]];
  }
  BilinearPatch patch(uint32_t primitive) const {
    const uint32_t* v = corners(primitive);
    const auto& p = data_.positions;
    return {to_double(p[v[0]]), to_double(p[v[1]]), to_double(p[v[2]]), to_double(p[v[3]])};
  }
  Vec3d outside_normal(uint32_t primitive, const BilinearPatch&, double u, double v) const;
  /// The same, from the normal along dpdu x dpdv, already reversed for a flipped mesh.
  Vec3d turned_outside(uint32_t primitive, const Vec3d& n, float u, float v) const;
  void fill_texture_frame(uint32_t primitive, const Vec2f& uv, SurfaceInteraction& out) const;
  PlaneRectangle plane(uint32_t primitive) const;  ///< only for a patch that is a rectangle
  Vec2f texture_point(uint32_t primitive, const Vec2f& uv) const;
  ShapeSample of_mesh(uint32_t primitive, ShapeSample) const;

  MeshData data_;
  bool flip_;
  std::vector<bool> is_rectangle_;  ///< per patch
  uint32_t rectangles_ = 0;         ///< number of rectangles
};

template <class T>
T blend(const std::vector<T>& values, const uint32_t* v, float s, float t) {
  return (values[v[0]] * (1.0f - t) + values[v[2]] * t) * (1.0f - s) +
         (values[v[1]] * (1.0f - t) + values[v[3]] * t) * s;
}
template <class T>
T blend_by_u(const std::vector<T>& values, const uint32_t* v, float t) {
  return (values[v[1]] - values[v[0]]) * (1.0f - t) + (values[v[3]] - values[v[2]]) * t;
}
template <class T>
T blend_by_v(const std::vector<T>& values, const uint32_t* v, float s) {
  return (values[v[2]] - values[v[0]]) * (1.0f - s) + (values[v[3]] - values[v[1]]) * s;
}

/// The unit normal along dpdu x dpdv, or that of the centre where the patch is degenerate.
Vec3d unit_cross(const BilinearPatch& patch, double u, double v) {
  Vec3d n = patch.cross(u, v);
  if (!(n.dot(n) > 0.0)) n = patch.cross(0.5, 0.5);
  const double l2 = n.dot(n);
  return l2 > 0.0 ? n / std::sqrt(l2) : Vec3d(0, 0, 1);
}

BilinearMesh::BilinearMesh(MeshData data, bool flip) : data_(std::move(data)), flip_(flip) {
  for (const uint32_t index : data_.quads)
    if (index >= data_.positions.size())
      throw std::invalid_argument("bilinear mesh: vertex index " + std::to_string(index) +
                                  " is out of range, the mesh has " +
                                  counted(data_.positions.size(), "vertex", "vertices"));
  const size_t count = data_.quads.size() / 4;
  is_rectangle_.resize(count);
  for (size_t i = 0; i < count; ++i) {
    is_rectangle_[i] = patch(static_cast<uint32_t>(i)).is_rectangle();
    rectangles_ += is_rectangle_[i];
  }
}

bool BilinearMesh::is_inside_out() const {
  return is_closed_inside_out(data_.positions, primitive_count(), [this](size_t face) {
    const auto primitive = static_cast<uint32_t>(face);
    const BilinearPatch shape = patch(primitive);
    const uint32_t* v = corners(primitive);
    if (outside_normal(primitive, shape, 0.5, 0.5).dot(shape.cross(0.5, 0.5)) < 0.0)
      return OutsideRing{{v[0], v[2], v[3], v[1]}};
    return OutsideRing{{v[0], v[1], v[3], v[2]}};
  });
}

PlaneRectangle BilinearMesh::plane(uint32_t primitive) const {
  const BilinearPatch shape = patch(primitive);
  return {shape, to_float(outside_normal(primitive, shape, 0.5, 0.5))};
}

Bounds3f BilinearMesh::bounds(uint32_t primitive) const {
  const uint32_t* v = corners(primitive);
  Bounds3f box;
  for (int i = 0; i < 4; ++i) box.extendBy(data_.positions[v[i]]);
  return box;
}

std::optional<ShapeHit> BilinearMesh::intersect(uint32_t primitive, const Ray& ray,
                                                float t_min) const {
  const auto found = patch(primitive).hits(to_double(ray.o), to_double(ray.d));
  std::optional<ShapeHit> nearest;
  for (int i = 0; i < found.count; ++i) {
    const float t = static_cast<float>(found.hit[i].t);
    if (!(t > t_min && t < ray.t_max) || (nearest && nearest->t <= t)) continue;
    nearest =
        ShapeHit{t, Vec2f(static_cast<float>(found.hit[i].u), static_cast<float>(found.hit[i].v))};
  }
  return nearest;
}

Vec3d BilinearMesh::outside_normal(uint32_t primitive, const BilinearPatch& shape, double u,
                                   double v) const {
  const Vec3d n = unit_cross(shape, u, v);
  return turned_outside(primitive, flip_ ? -n : n, static_cast<float>(u), static_cast<float>(v));
}

Vec3d BilinearMesh::turned_outside(uint32_t primitive, const Vec3d& n, float u, float v) const {
  if (data_.normals.empty()) return n;
  const Vec3f ns = blend(data_.normals, corners(primitive), u, v);
  return n.dot(to_double(ns)) < 0.0 ? -n : n;
}

/// Converts the derivatives by the patch's own (u,v) to texture coordinates, as in pbrt-v4. Exact
/// if each texture axis follows one axis of the patch.
void BilinearMesh::fill_texture_frame(uint32_t primitive, const Vec2f& uv,
                                      SurfaceInteraction& out) const {
  const uint32_t* v = corners(primitive);
  out.uv = blend(data_.uvs, v, uv.x, uv.y);
  const Vec2f by_u = blend_by_u(data_.uvs, v, uv.y), by_v = blend_by_v(data_.uvs, v, uv.x);
  // A texture coordinate that hardly changes along an edge does not change.
  const auto inverse = [](float x, float other) {
    return std::abs(x) < std::max(1e-8f, 1e-4f * std::abs(other)) ? 0.0f : 1.0f / x;
  };
  const float duds = inverse(by_u.x, by_u.y), dvds = inverse(by_v.x, by_v.y);
  const float dudt = inverse(by_u.y, by_u.x), dvdt = inverse(by_v.y, by_v.x);
  const Vec3f dpds = out.dpdu * duds + out.dpdv * dvds;
  Vec3f dpdt = out.dpdu * dudt + out.dpdv * dvdt;
  const Vec3f turned = cross(dpds, dpdt);
  if (max_component(abs(turned)) > 0.0f) {
    // The texture's handedness must not flip the surface.
    if (dot(cross(out.dpdu, out.dpdv), turned) < 0.0f) dpdt = -dpdt;
    out.dpdu = dpds;
    out.dpdv = dpdt;
  }
  const Vec3f dnds = out.dndu * duds + out.dndv * dvds;
  out.dndv = out.dndu * dudt + out.dndv * dvdt;
  out.dndu = dnds;
}

void BilinearMesh::fill(uint32_t primitive, const Vec2f& hit_uv, const Ray&, float,
                        SurfaceInteraction& out) const {
  const BilinearPatch shape = patch(primitive);
  const uint32_t* corner = corners(primitive);
  const double u = hit_uv.x, v = hit_uv.y;
  set_patch_point(shape.point(u, v), error_of_patch(shape), &out.p, &out.p_error);
  out.uv = hit_uv;
  out.face_index = data_.face_indices.empty() ? 0 : data_.face_indices[primitive];
  const Vec3d pu = shape.dpdu(v), pv = shape.dpdv(u);
  out.dpdu = to_float(pu);
  out.dpdv = to_float(pv);

  const Vec3d before = unit_cross(shape, u, v) * (flip_ ? -1.0 : 1.0);
  out.ng = to_float(turned_outside(primitive, before, hit_uv.x, hit_uv.y));
  Vec3f ns(0, 0, 0);
  if (!data_.normals.empty()) ns = blend(data_.normals, corner, hit_uv.x, hit_uv.y);
  const bool has_normal = max_component(abs(ns)) > 0.0f;
  if (has_normal) {
    out.dndu = blend_by_u(data_.normals, corner, hit_uv.y);
    out.dndv = blend_by_v(data_.normals, corner, hit_uv.x);
  } else if (const Vec3d twist = shape.d2pduv(); twist == Vec3d(0, 0, 0)) {
    out.dndu = out.dndv = Vec3f(0, 0, 0);
  } else {
    // The normal is dpdu x dpdv normalised; the only second derivative is the mixed one.
    const Vec3d n = pu.cross(pv);
    const double l2 = n.dot(n);
    const auto derivative = [&](const Vec3d& dn) {
      if (!(l2 > 0.0)) return Vec3f(0, 0, 0);
      return to_float((dn - n * (n.dot(dn) / l2)) * ((flip_ ? -1.0 : 1.0) / std::sqrt(l2)));
    };
    out.dndu = derivative(pu.cross(twist));
    out.dndv = derivative(twist.cross(pv));
  }
  if (!data_.uvs.empty()) fill_texture_frame(primitive, hit_uv, out);
  out.shading_dpdu = out.dpdu;
  out.shading_dpdv = out.dpdv;
  Vec3f shading_normal = out.ng;
  if (has_normal) {
    shading_normal = normalize(ns);
    const Vec3d to = to_double(shading_normal).normalized();
    out.shading_dpdu = to_float(rotate_from_to(before, to, to_double(out.dpdu)));
    out.shading_dpdv = to_float(rotate_from_to(before, to, to_double(out.dpdv)));
  }
  out.shading = Frame::from_z_and_tangent(shading_normal, out.shading_dpdu);
}

/// Texture coordinates of the point (u,v) of a patch.
Vec2f BilinearMesh::texture_point(uint32_t primitive, const Vec2f& uv) const {
  return data_.uvs.empty() ? uv : blend(data_.uvs, corners(primitive), uv.x, uv.y);
}

/// Adds the mesh's normal and texture coordinates to a sample of the patch.
ShapeSample BilinearMesh::of_mesh(uint32_t primitive, ShapeSample s) const {
  if (!has_one_normal(primitive))
    s.ng = to_float(outside_normal(primitive, patch(primitive), s.uv.x, s.uv.y));
  s.uv = texture_point(primitive, s.uv);
  return s;
}

std::optional<ShapeSample> BilinearMesh::sample_area(uint32_t primitive, const Vec2f& u) const {
  if (is_rectangle_[primitive]) return of_mesh(primitive, plane(primitive).sample_area(u));
  const BilinearPatch shape = patch(primitive);
  const CornerWeights weights(shape);
  if (!(weights.sum() > 0.0)) return std::nullopt;
  const Imath::V2d uv = weights.sample(u);
  const double element = shape.cross(uv.x, uv.y).length();
  const double pdf = weights.pdf(uv.x, uv.y) / element;
  if (!(element > 0.0) || !(pdf > 0.0)) return std::nullopt;
  ShapeSample s;
  set_patch_point(shape.point(uv.x, uv.y), error_of_patch(shape), &s.p, &s.p_error);
  s.ng = to_float(outside_normal(primitive, shape, uv.x, uv.y));
  s.uv = texture_point(primitive, Vec2f(static_cast<float>(uv.x), static_cast<float>(uv.y)));
  s.pdf = static_cast<float>(pdf);
  return s;
}

std::optional<ShapeSample> BilinearMesh::sample_towards(uint32_t primitive, const Vec3f& from,
                                                        const Vec2f& u) const {
  if (!is_rectangle_[primitive]) return seen_from(sample_area(primitive, u), from);
  const std::optional<ShapeSample> s = plane(primitive).sample_towards(from, u);
  return s ? std::optional(of_mesh(primitive, *s)) : s;
}

float BilinearMesh::pdf_towards(uint32_t primitive, const Vec3f& from, const Vec3f& p,
                                const Vec3f& ng) const {
  if (is_rectangle_[primitive]) return plane(primitive).pdf_towards(from, p, ng);
  const BilinearPatch shape = patch(primitive);
  // (u,v) of p: the nearest intersection of the line along the normal with the patch. At the rim it
  // can miss by rounding; the nearest corner's density then serves.
  const BilinearPatch::Hits found = shape.hits(to_double(p), to_double(ng));
  double nearest = std::numeric_limits<double>::infinity(), u = 0.0, v = 0.0;
  for (int i = 0; i < found.count; ++i)
    if (std::abs(found.hit[i].t) < nearest) {
      nearest = std::abs(found.hit[i].t);
      u = found.hit[i].u;
      v = found.hit[i].v;
    }
  if (found.count == 0) {
    for (int i = 0; i < 4; ++i) {
      const Vec3d to_corner = shape.point(i & 1, i >> 1) - to_double(p);
      if (to_corner.length() < nearest) {
        nearest = to_corner.length();
        u = i & 1;
        v = i >> 1;
      }
    }
  }
  const CornerWeights weights(shape);
  const double element = shape.cross(u, v).length();
  if (!(weights.sum() > 0.0) || !(element > 0.0)) return 0.0f;
  return area_to_solid_angle(static_cast<float>(weights.pdf(u, v) / element), from, p, ng);
}

void BilinearMesh::normal_bounds(uint32_t primitive, Vec3f* axis, float* cos_half_angle) const {
  // The unnormalised normal is affine in u and v, so the corners' normals span the cone.
  const BilinearPatch shape = patch(primitive);
  Vec3d n[4], sum(0, 0, 0);
  for (int i = 0; i < 4; ++i) {
    n[i] = outside_normal(primitive, shape, i & 1, i >> 1);
    sum += n[i];
  }
  *axis = Vec3f(0, 0, 1);
  *cos_half_angle = -1.0f;
  if (!(sum.length() > 1e-6)) return;
  const Vec3d middle = sum.normalized();
  double cosine = 1.0;
  for (const Vec3d& corner : n) cosine = std::min(cosine, middle.dot(corner));
  if (cosine <= 0.0) return;
  *axis = to_float(middle);
  *cos_half_angle = static_cast<float>(cosine);
}

}  // namespace

ShapePtr make_bilinear_mesh(MeshData data, bool flip) {
  return std::make_shared<BilinearMesh>(std::move(data), flip);
}

}  // namespace nephroid
