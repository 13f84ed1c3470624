// Intersection, area and rectangle test of one bilinear patch (Reshetov 2019).
#include "scene/shape/bilinear_patch.h"

namespace nephroid {
namespace {

/// Hits this far beyond an edge, in u or v, still count, so that patches with a common edge leave
/// no gap.
constexpr double kEdgeTolerance = 1e-10;

bool in_unit_interval(double x) {
  return x >= -kEdgeTolerance && x <= 1.0 + kEdgeTolerance;
}

/// The real roots of a x^2 + b x + c, without cancellation; a can be 0.
int quadratic_roots(double a, double b, double c, double x[2]) {
  const double discriminant = b * b - 4.0 * a * c;
  if (discriminant < 0.0) return 0;
  const double q = -0.5 * (b + std::copysign(std::sqrt(discriminant), b));
  int count = 0;
  if (a != 0.0) x[count++] = q / a;
  if (q != 0.0) x[count++] = c / q;
  return count;
}

}  // namespace

BilinearPatch::Hits BilinearPatch::hits(const Vec3d& o, const Vec3d& d) const {
  // The line meets the ruling from (1-u) p00 + u p10 to (1-u) p01 + u p11 where the volume that
  // they span is zero: a quadratic in u.
  const Vec3d q00 = p00 - o, q10 = p10 - o, q01 = p01 - o, q11 = p11 - o;
  const double a = (q10 - q00).cross(q01 - q11).dot(d);
  const double c = q00.cross(d).dot(q01 - q00);
  const double b = q10.cross(d).dot(q11 - q10) - (a + c);
  double roots[2];
  const int count = quadratic_roots(a, b, c, roots);

  Hits found;
  for (int i = 0; i < count; ++i) {
    if (!in_unit_interval(roots[i])) continue;
    const double u = std::clamp(roots[i], 0.0, 1.0);
    // Closest points of the line and the ruling.
    const Vec3d start = q00 * (1.0 - u) + q10 * u;
    const Vec3d ruling = q01 * (1.0 - u) + q11 * u - start;
    const Vec3d n = d.cross(ruling);
    const double n2 = n.dot(n);
    if (!(n2 > 0.0)) continue;
    const double v = n.dot(start.cross(d)) / n2;
    if (!in_unit_interval(v)) continue;
    const double t = n.dot(start.cross(ruling)) / n2;
    found.hit[found.count++] = {t, u, std::clamp(v, 0.0, 1.0)};
  }
  return found;
}

double BilinearPatch::area() const {
  // Three-point Gauss-Legendre on cells; exact for parallelograms and plane convex patches.
  constexpr int kCells = 8;
  constexpr double kNode = 0.77459666924148337704;  // sqrt(3/5)
  constexpr double kNodes[3] = {0.5 - 0.5 * kNode, 0.5, 0.5 + 0.5 * kNode};
  constexpr double kWeights[3] = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
  double sum = 0.0;
  for (int i = 0; i < 3 * kCells; ++i)
    for (int j = 0; j < 3 * kCells; ++j)
      sum += kWeights[i % 3] * kWeights[j % 3] *
             cross((i / 3 + kNodes[i % 3]) / kCells, (j / 3 + kNodes[j % 3]) / kCells).length();
  return sum / (kCells * kCells);
}

bool BilinearPatch::is_rectangle() const {
  if (p00 == p01 || p01 == p11 || p11 == p10 || p10 == p00) return false;
  const Vec3d n = cross(0.0, 0.0);
  if (!(n.length() > 0.0)) return false;
  if (std::abs((p11 - p00).normalized().dot(n.normalized())) > 1e-5) return false;
  // A parallelogram with equal diagonals: all corners are equally far from the centre.
  const Vec3d center = (p00 + p10 + p01 + p11) * 0.25;
  const double d2 = (p00 - center).dot(p00 - center);
  for (const Vec3d& p : {p10, p01, p11})
    if (std::abs((p - center).dot(p - center) - d2) > 1e-4 * d2) return false;
  return true;
}

}  // namespace nephroid
