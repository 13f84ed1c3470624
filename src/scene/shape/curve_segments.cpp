// Bezier and b-spline curves of degree 2 and 3 as cubic Bezier segments; see curve.h. Control
// points are values of the curve's polar form (Ramshaw 1987). It must not know widths.
#include "scene/shape/curve.h"

namespace nephroid {
namespace {

Vec3f mix(const Vec3f& a, const Vec3f& b, float t) {
  return a * (1.0f - t) + b * t;
}

CurveSegment cubic(const Vec3f& a, const Vec3f& b, const Vec3f& c, const Vec3f& d) {
  CurveSegment s;
  s.points = {a, b, c, d};
  return s;
}

/// The same parabola as a cubic (degree elevation).
CurveSegment raised(const Vec3f& a, const Vec3f& b, const Vec3f& c) {
  return cubic(a, mix(a, b, 2.0f / 3.0f), mix(b, c, 1.0f / 3.0f), c);
}

}  // namespace

std::vector<CurveSegment> bezier_segments(const std::vector<Vec3f>& p, int degree) {
  const size_t step = degree;
  std::vector<CurveSegment> segments;
  if (p.size() < step + 1 || (p.size() - 1) % step != 0) return segments;
  for (size_t i = 0; i + step < p.size(); i += step)
    segments.push_back(degree == 2 ? raised(p[i], p[i + 1], p[i + 2])
                                   : cubic(p[i], p[i + 1], p[i + 2], p[i + 3]));
  return segments;
}

std::vector<CurveSegment> bspline_segments(const std::vector<Vec3f>& p, int degree) {
  const size_t step = degree;
  std::vector<CurveSegment> segments;
  for (size_t i = 0; i + step < p.size(); ++i) {
    if (degree == 2) {
      segments.push_back(
          raised(mix(p[i], p[i + 1], 0.5f), p[i + 1], mix(p[i + 1], p[i + 2], 0.5f)));
      continue;
    }
    // Points at thirds of the sides, and the midpoints between them.
    const Vec3f before = mix(p[i], p[i + 1], 2.0f / 3.0f), a = mix(p[i + 1], p[i + 2], 1.0f / 3.0f);
    const Vec3f b = mix(p[i + 1], p[i + 2], 2.0f / 3.0f),
                after = mix(p[i + 2], p[i + 3], 1.0f / 3.0f);
    segments.push_back(cubic(mix(before, a, 0.5f), a, b, mix(b, after, 0.5f)));
  }
  return segments;
}

}  // namespace nephroid
