// Curves: thin ribbons swept along cubic Bezier segments, for hair, fur and grass. Many curves form
// one shape; a primitive is a piece of a segment, short enough to be nearly straight. It must not
// know Embree or materials. As in pbrt-v4 section 6.7, rays are intersected in the plane
// perpendicular to them through the curve's nearest point; a hit is off by at most the width.
#pragma once

#include <array>
#include <vector>

#include "scene/shape/shape.h"

namespace nephroid {

/// Flat curves face every ray. Cylinders are flat curves with bent normals. Ribbons have normals of
/// their own and look narrower the more they turn away.
enum class CurveType { kFlat, kCylinder, kRibbon };

/// One cubic Bezier segment, object space.
struct CurveSegment {
  std::array<Vec3f, 4> points;
  float width0 = 1, width1 = 1;              ///< linear in between, at least 0
  Vec3f normal0{0, 0, 0}, normal1{0, 0, 0};  ///< unit normals, for ribbons only
};

/// The segments of a curve of degree 2 or 3: Bezier segments that share their ends, or a uniform
/// b-spline. The first three fields of each are set. Empty if the number of points fits no curve.
std::vector<CurveSegment> bezier_segments(const std::vector<Vec3f>& points, int degree);
std::vector<CurveSegment> bspline_segments(const std::vector<Vec3f>& points, int degree);

/// Hit coordinates: u in [0,1] along the piece; v is not used.
class CurveShape final : public Shape {
 public:
  /// A point of a piece's Bezier curve with half the width there, in Embree's layout.
  struct Vertex {
    Vec3f p;
    float radius;
  };
  /// Number of straight parts into which the ray tracer can divide a piece, with errors of at most
  /// a few hundredths of the width.
  static constexpr int kPartsPerPiece = 8;

  /// Segments without length are dropped. Similarity transforms are applied to the points once,
  /// others to rays and hits.
  CurveShape(const Transform& object_to_world, bool reverse_orientation, CurveType type,
             const std::vector<CurveSegment>& segments);

  bool merges_photons() const override { return false; }
  uint32_t primitive_count() const override { return static_cast<uint32_t>(ranges_.size()); }
  Bounds3f bounds(uint32_t piece) const override;
  /// Recursive subdivision in double.
  std::optional<ShapeHit> intersect(uint32_t piece, const Ray& ray, float t_min) const override;
  void fill(uint32_t piece, const Vec2f& hit_uv, const Ray& ray, float t,
            SurfaceInteraction& out) const override;

  /// True if the points are in world space: the ray tracer can then take vertices(), four per
  /// piece, and trace ribbons that face the ray. Otherwise it calls intersect().
  bool is_traceable() const { return baked_; }
  const std::vector<Vertex>& vertices() const { return vertices_; }
  CurveType type() const { return type_; }
  /// True if a ray that hits the full width of the piece at parameter `s` also hits the visible
  /// width, which is smaller where a ribbon has turned away.
  bool is_hit(uint32_t piece, float s, const Ray& ray) const;

  /// pbrt-v4's estimate: the length of the control polygon times the mean width.
  float area(uint32_t piece) const override;
  /// As in pbrt-v4, curves cannot be sampled: always empty.
  std::optional<ShapeSample> sample_area(uint32_t, const Vec2f&) const override { return {}; }
  std::optional<ShapeSample> sample_towards(uint32_t, const Vec3f&, const Vec2f&) const override {
    return {};
  }
  float pdf_towards(uint32_t, const Vec3f&, const Vec3f&, const Vec3f&) const override { return 0; }
  void normal_bounds(uint32_t, Vec3f* axis, float* cos_half_angle) const override;

 private:
  struct Range {
    float u0, u1;  ///< range of the segment that the piece covers
  };
  struct Ends {
    Vec3f normal0, normal1;  ///< normals at the ends of the segment
  };
  struct Line;     ///< a ray in curve space
  struct Nearest;  ///< the point of a piece nearest to a ray

  void add(const CurveSegment& segment);
  Line line_of(const Ray& ray) const;
  std::array<Vec3d, 4> points_of(uint32_t piece) const;
  /// Width of the piece as the ray sees it, in curve space, at parameter s of the piece.
  double seen_width(uint32_t piece, double s, const Line& line) const;
  Vec3d ribbon_normal(uint32_t piece, double s) const;
  /// Refines an approximate parameter.
  Nearest refine(uint32_t piece, double s, const Line& line) const;
  struct Search;
  void search(const Search& part, const Line& line, double z_min, Nearest* best) const;

  CurveType type_;
  bool baked_;     ///< points are in world space, else in object space
  bool mirrored_;  ///< baked with a transform that swaps handedness
  bool flip_;
  Transform to_world_;  ///< transform of the points to world space; identity if baked
  Vec3f error_scale_;   ///< per world axis: error of p over the width in the space of the points
  std::vector<Vertex> vertices_;  ///< four per piece
  std::vector<Range> ranges_;
  std::vector<Ends> ends_;  ///< for ribbons only
};

}  // namespace nephroid
