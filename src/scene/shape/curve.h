// Curves: thin swept ribbons along cubic Bezier segments, for hair, fur and grass. Many curves of a
// scene are one shape; a primitive is a piece of a segment, short enough to be nearly straight.
// Who calls it: the curve directive makes them, the ray tracer asks for the pieces. It must not
// know Embree or materials. Geometry as pbrt-v4 section 6.7: a ray meets a curve in the plane
// across the ray through the nearest point of the curve, and a hit is off by up to the width.
#pragma once

#include <array>
#include <vector>

#include "scene/shape/shape.h"

namespace nephroid {

/// Flat ones face every ray; cylinders are flat ones with bent normals; ribbons have normals of
/// their own, and look narrower the more they turn away.
enum class CurveType { kFlat, kCylinder, kRibbon };

/// One cubic Bezier segment, object space.
struct CurveSegment {
  std::array<Vec3f, 4> points;
  float width0 = 1, width1 = 1;              ///< linear in between; 0 or more
  Vec3f normal0{0, 0, 0}, normal1{0, 0, 0};  ///< unit, of ribbons only
};

/// The segments of a curve: Bezier segments that share their ends, or a uniform b-spline, of degree
/// 2 or 3; the first three fields of each are set. Empty if the number of points fits no curve.
std::vector<CurveSegment> bezier_segments(const std::vector<Vec3f>& points, int degree);
std::vector<CurveSegment> bspline_segments(const std::vector<Vec3f>& points, int degree);

/// Hit coordinates: u along the piece in [0,1]; the other one is not used.
class CurveShape final : public Shape {
 public:
  /// A point of a piece's Bezier curve with half the width there, as Embree wants it.
  struct Vertex {
    Vec3f p;
    float radius;
  };
  /// Straight parts into which the ray tracer may divide a piece without being off by more than a
  /// few hundredths of the width.
  static constexpr int kPartsPerPiece = 8;

  /// Segments without length are left out. Similar maps are applied to the points once and for all,
  /// others to rays and hits.
  CurveShape(const Transform& object_to_world, bool reverse_orientation, CurveType type,
             const std::vector<CurveSegment>& segments);

  bool merges_photons() const override { return false; }
  uint32_t primitive_count() const override { return static_cast<uint32_t>(ranges_.size()); }
  Bounds3f bounds(uint32_t piece) const override;
  /// By recursive subdivision in double.
  std::optional<ShapeHit> intersect(uint32_t piece, const Ray& ray, float t_min) const override;
  void fill(uint32_t piece, const Vec2f& hit_uv, const Ray& ray, float t,
            SurfaceInteraction& out) const override;

  /// Whether the pieces are in the space of the shape itself, so that the ray tracer may take their
  /// vertices, four a piece, and meet them as ribbons that face the ray. Else it asks intersect().
  bool is_traceable() const { return baked_; }
  const std::vector<Vertex>& vertices() const { return vertices_; }
  CurveType type() const { return type_; }
  /// Of a ray that meets the full width of the piece at parameter `s`: whether it meets the width
  /// that it sees, which is less where a ribbon has turned away.
  bool is_hit(uint32_t piece, float s, const Ray& ray) const;

  /// As pbrt-v4 estimates it: the length of the control polygon times the mean width.
  float area(uint32_t piece) const override;
  /// Curves cannot be sampled, as in pbrt-v4: no point is ever found.
  std::optional<ShapeSample> sample_area(uint32_t, const Vec2f&) const override { return {}; }
  std::optional<ShapeSample> sample_towards(uint32_t, const Vec3f&, const Vec2f&) const override {
    return {};
  }
  float pdf_towards(uint32_t, const Vec3f&, const Vec3f&, const Vec3f&) const override { return 0; }
  void normal_bounds(uint32_t, Vec3f* axis, float* cos_half_angle) const override;

 private:
  struct Range {
    float u0, u1;  ///< part of the segment that the piece covers
  };
  struct Ends {
    Vec3f normal0, normal1;  ///< of the segment
  };
  struct Line;     ///< a ray as curves see it
  struct Nearest;  ///< the point of a piece that is nearest to a ray

  void add(const CurveSegment& segment);
  Line line_of(const Ray& ray) const;
  std::array<Vec3d, 4> points_of(uint32_t piece) const;
  /// Width of the piece as the ray sees it, curve space, at parameter s of the piece.
  double seen_width(uint32_t piece, double s, const Line& line) const;
  Vec3d ribbon_normal(uint32_t piece, double s) const;
  /// From a nearly correct parameter.
  Nearest refine(uint32_t piece, double s, const Line& line) const;
  struct Search;
  void search(const Search& part, const Line& line, double z_min, Nearest* best) const;

  CurveType type_;
  bool baked_;     ///< points are in world space; else in object space
  bool mirrored_;  ///< baked with a map that swaps handedness
  bool flip_;
  Transform to_world_;  ///< from the space of the points; identity if baked
  Vec3f error_scale_;   ///< per world axis, error of p over the width in the space of the points
  std::vector<Vertex> vertices_;  ///< four a piece
  std::vector<Range> ranges_;
  std::vector<Ends> ends_;  ///< of ribbons
};

}  // namespace nephroid
