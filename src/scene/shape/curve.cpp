// Pieces of curves: construction, intersection and hit attributes; see curve.h. Works in the space
// of the ray: its direction is the third axis, and the curve is projected to the plane
// perpendicular to it (Nakamaru & Ohno 2002; pbrt-v4 section 6.7).
#include "scene/shape/curve.h"

#include <algorithm>

namespace nephroid {
namespace {

using Bezier = std::array<Vec3d, 4>;

Vec3d mix(const Vec3d& a, const Vec3d& b, double t) {
  return a * (1.0 - t) + b * t;
}
Vec3d unit(const Vec3d& v) {
  const double l = v.length();
  return l > 0.0 ? v / l : v;
}
/// A unit vector perpendicular to a unit vector.
Vec3d across(const Vec3d& d) {
  return unit(std::abs(d.x) < 0.6 ? d.cross(Vec3d(1, 0, 0)) : d.cross(Vec3d(0, 1, 0)));
}

/// The polar form of the curve: (u,u,u) gives its value, mixed arguments give control points.
Vec3d polar(const Bezier& p, double a, double b, double c) {
  const Vec3d q0 = mix(p[0], p[1], a), q1 = mix(p[1], p[2], a), q2 = mix(p[2], p[3], a);
  return mix(mix(q0, q1, b), mix(q1, q2, b), c);
}
Bezier part_of(const Bezier& p, double u0, double u1) {
  return {polar(p, u0, u0, u0), polar(p, u0, u0, u1), polar(p, u0, u1, u1), polar(p, u1, u1, u1)};
}
Vec3d derivative(const Bezier& p, double s) {
  return mix(mix(p[1] - p[0], p[2] - p[1], s), mix(p[2] - p[1], p[3] - p[2], s), s) * 3.0;
}
Vec3d second_derivative(const Bezier& p, double s) {
  return mix(p[0] - p[1] * 2.0 + p[2], p[1] - p[2] * 2.0 + p[3], s) * 6.0;
}

/// Number of equal parts whose chords are within `tolerance` of the curve. The distance is at most
/// 1/8 of the second derivative, which is largest at an end.
double parts_needed(const Bezier& p, double tolerance) {
  const double bend =
      std::max(second_derivative(p, 0.0).length(), second_derivative(p, 1.0).length());
  return tolerance > 0.0 ? std::sqrt(bend / (8.0 * tolerance)) : kInfinity;
}

/// The scale of a similarity transform, else 0.
double similarity_scale(const Mat44d& m) {
  const Vec3d rows[3] = {
      {m[0][0], m[0][1], m[0][2]}, {m[1][0], m[1][1], m[1][2]}, {m[2][0], m[2][1], m[2][2]}};
  const double scale2 = rows[0].length2();
  for (int i = 0; i < 3; ++i) {
    if (std::abs(rows[i].length2() - scale2) > 1e-5 * scale2) return 0.0;
    if (std::abs(rows[i].dot(rows[(i + 1) % 3])) > 1e-5 * scale2) return 0.0;
  }
  return std::sqrt(scale2);
}

Vec3d apply(const Mat44d& m, const Vec3d& v, double w) {
  return {v.x * m[0][0] + v.y * m[1][0] + v.z * m[2][0] + w * m[3][0],
          v.x * m[0][1] + v.y * m[1][1] + v.z * m[2][1] + w * m[3][1],
          v.x * m[0][2] + v.y * m[1][2] + v.z * m[2][2] + w * m[3][2]};
}

}  // namespace

/// A ray in the space of the points. x, y and the unit direction d form a right-handed frame.
struct CurveShape::Line {
  Vec3d o, d, x, y;
  double per_t;  ///< length per unit of the ray's t

  Vec3d to_plane(const Vec3d& p) const {
    const Vec3d v = p - o;
    return {v.dot(x), v.dot(y), v.dot(d)};
  }
  Bezier to_plane(const Bezier& p) const {
    return {to_plane(p[0]), to_plane(p[1]), to_plane(p[2]), to_plane(p[3])};
  }
};

struct CurveShape::Nearest {
  double s = -1.0;       ///< parameter of the piece; negative if there is no point
  Vec3d p{0, 0, 0};      ///< in the line's frame
  double z = kInfinity;  ///< depth along the line
};

/// Part of a piece in the line's frame, with the number of divisions left.
struct CurveShape::Search {
  uint32_t piece;
  Bezier points;
  double s0, s1;
  int divisions;
};

CurveShape::CurveShape(const Transform& object_to_world, bool reverse_orientation, CurveType type,
                       const std::vector<CurveSegment>& segments)
    : type_(type), flip_(reverse_orientation), to_world_(object_to_world), error_scale_(0.0f) {
  const double scale = similarity_scale(object_to_world.m);
  baked_ = scale > 0.0;
  mirrored_ = baked_ && object_to_world.swaps_handedness();
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i)
      error_scale_[j] +=
          static_cast<float>(std::abs(object_to_world.m[i][j]) / (baked_ ? scale : 1.0));
  for (CurveSegment s : segments) {
    if (baked_) {
      for (Vec3f& p : s.points) p = object_to_world.point(p);
      s.width0 *= static_cast<float>(scale);
      s.width1 *= static_cast<float>(scale);
      s.normal0 = normalize(object_to_world.normal(s.normal0));
      s.normal1 = normalize(object_to_world.normal(s.normal1));
    }
    add(s);
  }
  vertices_.shrink_to_fit();
  ranges_.shrink_to_fit();
  if (baked_) to_world_ = Transform();
}

void CurveShape::add(const CurveSegment& s) {
  const Bezier whole = {to_double(s.points[0]), to_double(s.points[1]), to_double(s.points[2]),
                        to_double(s.points[3])};
  double length = 0.0;
  for (size_t i = 0; i < 3; ++i) length += (whole[i + 1] - whole[i]).length();
  if (!(length > 0.0)) return;
  // Errors of a fortieth of the width show in thick curves, for which eight pieces are no cost.
  constexpr int kMaxPieces = 128, kMaxFinePieces = 8;
  const double width = std::max(s.width0, s.width1);
  const double parts = parts_needed(whole, width / 40.0);
  const double fine_parts = parts_needed(whole, width / 400.0);
  int pieces = 1;
  while ((pieces < kMaxPieces && pieces * kPartsPerPiece < parts) ||
         (pieces < kMaxFinePieces && pieces * kPartsPerPiece < fine_parts))
    pieces *= 2;
  for (int i = 0; i < pieces; ++i) {
    const Range range{static_cast<float>(i) / static_cast<float>(pieces),
                      static_cast<float>(i + 1) / static_cast<float>(pieces)};
    const Bezier piece = part_of(whole, range.u0, range.u1);
    for (size_t k = 0; k < 4; ++k) {
      const float u = lerp(static_cast<float>(k) / 3.0f, range.u0, range.u1);
      vertices_.push_back({to_float(piece[k]), 0.5f * lerp(u, s.width0, s.width1)});
    }
    ranges_.push_back(range);
    if (type_ == CurveType::kRibbon) ends_.push_back({s.normal0, s.normal1});
  }
}

Bounds3f CurveShape::bounds(uint32_t piece) const {
  Bounds3f box;
  float radius = 0.0f;
  for (size_t k = 0; k < 4; ++k) {
    box.extendBy(vertices_[4 * piece + k].p);
    radius = std::max(radius, vertices_[4 * piece + k].radius);
  }
  box.min -= Vec3f(radius);
  box.max += Vec3f(radius);
  Bounds3f world;
  for (int corner = 0; corner < 8; ++corner)
    world.extendBy(to_world_.point(Vec3f(corner & 1 ? box.max.x : box.min.x,
                                         corner & 2 ? box.max.y : box.min.y,
                                         corner & 4 ? box.max.z : box.min.z)));
  for (int j = 0; j < 3; ++j) {
    world.min[j] = std::nextafter(world.min[j], -kInfinity);
    world.max[j] = std::nextafter(world.max[j], kInfinity);
  }
  return world;
}

CurveShape::Line CurveShape::line_of(const Ray& ray) const {
  Line line;
  line.o = to_double(ray.o);
  line.d = to_double(ray.d);
  if (!baked_) {
    line.o = apply(to_world_.inverse, line.o, 1.0);
    line.d = apply(to_world_.inverse, line.d, 0.0);
  }
  line.per_t = line.d.length();
  line.d = unit(line.d);
  line.x = across(line.d);
  line.y = line.d.cross(line.x);
  return line;
}

std::array<Vec3d, 4> CurveShape::points_of(uint32_t piece) const {
  const Vertex* v = &vertices_[4 * static_cast<size_t>(piece)];
  return {to_double(v[0].p), to_double(v[1].p), to_double(v[2].p), to_double(v[3].p)};
}

Vec3d CurveShape::ribbon_normal(uint32_t piece, double s) const {
  const Vec3d a = to_double(ends_[piece].normal0), b = to_double(ends_[piece].normal1);
  const double u = ranges_[piece].u0 + s * (ranges_[piece].u1 - ranges_[piece].u0);
  const double angle = std::atan2(a.cross(b).length(), a.dot(b)), sine = std::sin(angle);
  // Equal normals; or opposite ones, which have no shortest rotation between them.
  if (!(sine > 1e-6)) return a;
  return a * (std::sin((1.0 - u) * angle) / sine) + b * (std::sin(u * angle) / sine);
}

double CurveShape::seen_width(uint32_t piece, double s, const Line& line) const {
  const Vertex* v = &vertices_[4 * static_cast<size_t>(piece)];
  const double width = 2.0 * ((1.0 - s) * v[0].radius + s * v[3].radius);
  return type_ == CurveType::kRibbon ? width * std::abs(ribbon_normal(piece, s).dot(line.d))
                                     : width;
}

CurveShape::Nearest CurveShape::refine(uint32_t piece, double s, const Line& line) const {
  const Bezier c = line.to_plane(points_of(piece));
  // Newton's method for the distance in the plane. Where that has no minimum, steps along the
  // tangent.
  for (int i = 0; i < 4; ++i) {
    const Vec3d p = polar(c, s, s, s), d1 = derivative(c, s), d2 = second_derivative(c, s);
    const double slope = p.x * d1.x + p.y * d1.y;
    const double tangent2 = d1.x * d1.x + d1.y * d1.y;
    const double curvature = tangent2 + p.x * d2.x + p.y * d2.y;
    const double divisor = curvature > 0.1 * tangent2 ? curvature : tangent2;
    if (!(divisor > 0.0)) break;
    s = std::clamp(s - slope / divisor, 0.0, 1.0);
  }
  Nearest n;
  n.s = s;
  n.p = polar(c, s, s, s);
  n.z = n.p.z;
  return n;
}

void CurveShape::search(const Search& part, const Line& line, double z_min, Nearest* best) const {
  const Vertex* v = &vertices_[4 * static_cast<size_t>(part.piece)];
  const double radius = std::max(v[0].radius, v[3].radius);
  const Bezier& c = part.points;
  for (int axis = 0; axis < 3; ++axis) {
    const auto [low, high] = std::minmax({c[0][axis], c[1][axis], c[2][axis], c[3][axis]});
    if (low - radius > (axis == 2 ? best->z : 0.0)) return;
    if (high + radius < (axis == 2 ? z_min : 0.0)) return;
  }
  if (part.divisions > 0) {
    const double middle = 0.5 * (part.s0 + part.s1);
    const int left = part.divisions - 1;
    search({part.piece, part_of(c, 0.0, 0.5), part.s0, middle, left}, line, z_min, best);
    search({part.piece, part_of(c, 0.5, 1.0), middle, part.s1, left}, line, z_min, best);
    return;
  }
  // Between the perpendiculars at both ends, and within the width at the nearest point.
  const auto beyond = [](const Vec3d& end, const Vec3d& inwards) {
    return end.x * (inwards.x - end.x) + end.y * (inwards.y - end.y) > 0.0;
  };
  if (beyond(c[0], c[1]) || beyond(c[3], c[2])) return;
  const Vec3d chord = c[3] - c[0];
  const double length2 = chord.x * chord.x + chord.y * chord.y;
  if (!(length2 > 0.0)) return;
  const double along = std::clamp(-(c[0].x * chord.x + c[0].y * chord.y) / length2, 0.0, 1.0);
  const Nearest n = refine(part.piece, part.s0 + along * (part.s1 - part.s0), line);
  const double width = seen_width(part.piece, n.s, line);
  if (n.p.x * n.p.x + n.p.y * n.p.y > 0.25 * width * width) return;
  if (n.z > z_min && n.z < best->z) *best = n;
}

std::optional<ShapeHit> CurveShape::intersect(uint32_t piece, const Ray& ray, float t_min) const {
  const Line line = line_of(ray);
  const Vertex* v = &vertices_[4 * static_cast<size_t>(piece)];
  const Bezier points = line.to_plane(points_of(piece));
  const double parts = parts_needed(points, std::max(v[0].radius, v[3].radius) / 50.0);
  int divisions = 0;
  while (divisions < 10 && (1 << divisions) < parts) ++divisions;
  Nearest best;
  best.z = ray.t_max * line.per_t;
  search({piece, points, 0.0, 1.0, divisions}, line, t_min * line.per_t, &best);
  if (best.s < 0.0) return std::nullopt;
  return ShapeHit{static_cast<float>(best.z / line.per_t), Vec2f(static_cast<float>(best.s), 0.0f)};
}

bool CurveShape::is_hit(uint32_t piece, float s, const Ray& ray) const {
  const Line line = line_of(ray);
  const Nearest n = refine(piece, s, line);
  const double half = 0.5 * seen_width(piece, n.s, line);
  return n.p.x * n.p.x + n.p.y * n.p.y <= half * half;
}

void CurveShape::fill(uint32_t piece, const Vec2f& hit_uv, const Ray& ray, float,
                      SurfaceInteraction& out) const {
  const Line line = line_of(ray);
  const Nearest n = refine(piece, hit_uv.x, line);
  const Range& range = ranges_[piece];
  const Bezier points = points_of(piece);
  Vec3d dpdu = derivative(points, n.s);
  if (!(dpdu.length2() > 0.0)) dpdu = points[3] - points[0];
  if (!(dpdu.length2() > 0.0)) dpdu = line.x;
  dpdu /= range.u1 - range.u0;

  // In object space v grows to the left of the curve as seen along the ray, along d x dpdu. A
  // mirroring transform reverses this.
  const double side = mirrored_ ? -1.0 : 1.0;
  Vec3d left = line.d.cross(dpdu);
  left = left.length2() > 0.0 ? unit(left) * side : line.y;
  const Vec3d from_curve = line.x * -n.p.x + line.y * -n.p.y;
  const double width = seen_width(piece, n.s, line);
  const double offset = std::copysign(std::hypot(n.p.x, n.p.y), from_curve.dot(left));
  const double v = width > 0.0 ? std::clamp(0.5 + offset / width, 0.0, 1.0) : 0.5;

  const Vec3d tangent = unit(dpdu);
  Vec3d normal, dpdv;
  if (type_ == CurveType::kRibbon) {
    const Vec3d own = ribbon_normal(piece, n.s);
    normal = own - tangent * tangent.dot(own);
    normal = normal.length2() > 0.0 ? unit(normal) : across(tangent);
    dpdv = normal.cross(tangent) * side;
  } else {
    // pbrt-v4's normals of flat curves point along the ray; those of cylinders turn from one edge
    // to the other.
    const Vec3d away = unit(left.cross(tangent)) * side * -1.0;
    const double angle = type_ == CurveType::kCylinder ? (v - 0.5) * kPi : 0.0;
    normal = away * std::cos(angle) + left * std::sin(angle);
    dpdv = left * std::cos(angle) - away * std::sin(angle);
  }
  dpdv *= width;

  const Vec3d p = line.o + line.d * n.z;
  out.p = to_float(baked_ ? p : apply(to_world_.m, p, 1.0));
  out.p_error = error_scale_ * static_cast<float>(width) + abs(out.p) * gamma_bound(8);
  out.dpdu = to_float(baked_ ? dpdu : apply(to_world_.m, dpdu, 0.0));
  out.dpdv = to_float(baked_ ? dpdv : apply(to_world_.m, dpdv, 0.0));
  out.ng = to_float(normal * (flip_ ? -1.0 : 1.0));
  if (!baked_) out.ng = to_world_.normal(out.ng);
  out.ng = normalize(out.ng);
  out.uv = Vec2f(range.u0 + static_cast<float>(n.s) * (range.u1 - range.u0), static_cast<float>(v));
  out.dndu = out.dndv = Vec3f(0.0f);
  out.shading = Frame::from_z_and_tangent(out.ng, out.dpdu);
  out.shading_dpdu = out.dpdu;
  out.shading_dpdv = out.dpdv;
  out.face_index = 0;
}

float CurveShape::area(uint32_t piece) const {
  const Bezier p = points_of(piece);
  const Vertex* v = &vertices_[4 * static_cast<size_t>(piece)];
  double length = 0.0;
  for (size_t i = 0; i < 3; ++i) length += apply(to_world_.m, p[i + 1] - p[i], 0.0).length();
  return static_cast<float>(length * (v[0].radius + v[3].radius));
}

void CurveShape::normal_bounds(uint32_t, Vec3f* axis, float* cos_half_angle) const {
  *axis = Vec3f(0, 0, 1);
  *cos_half_angle = -1.0f;
}

}  // namespace nephroid
