// Curves: bases become the right Bezier segments, and rays hit them where a brute-force search
// finds the curve. Hits follow the format. Transforming points or rays gives the same result.
#include "scene/shape/curve.h"

#include <gtest/gtest.h>

#include "unit/shape/shape_checks.h"

namespace nephroid {
namespace {

using testing::Random;

Vec3f bezier_point(const CurveSegment& s, float u) {
  const float v = 1 - u;
  return s.points[0] * (v * v * v) + s.points[1] * (3 * u * v * v) + s.points[2] * (3 * u * u * v) +
         s.points[3] * (u * u * u);
}

std::vector<Vec3f> some_points(size_t count, uint64_t seed) {
  Random random(seed);
  std::vector<Vec3f> points;
  for (size_t i = 0; i < count; ++i)
    points.push_back(Vec3f(0.3f * static_cast<float>(i), 0, 0) + random.in_box(0.4f));
  return points;
}

/// Basis function of the uniform b-spline by the Cox-de Boor recursion, knots at integers.
double basis(int degree, double x) {
  if (degree == 0) return x >= 0 && x < 1 ? 1.0 : 0.0;
  return (x * basis(degree - 1, x) + (degree + 1 - x) * basis(degree - 1, x - 1)) / degree;
}

TEST(CurveSegments, BsplinesAreThoseOfCoxAndDeBoor) {
  for (const int degree : {2, 3}) {
    const std::vector<Vec3f> p = some_points(7, 3);
    const auto segments = bspline_segments(p, degree);
    ASSERT_EQ(segments.size(), p.size() - static_cast<size_t>(degree));
    for (size_t k = 0; k < segments.size(); ++k) {
      for (const double u : {0.0, 0.3, 0.999}) {
        Vec3d expected(0, 0, 0);
        for (size_t i = 0; i < p.size(); ++i) {
          const double b =
              basis(degree, static_cast<double>(k) + u + degree - static_cast<double>(i));
          expected += Vec3d(p[i].x, p[i].y, p[i].z) * b;
        }
        const Vec3f found = bezier_point(segments[k], static_cast<float>(u));
        for (int j = 0; j < 3; ++j) EXPECT_NEAR(found[j], expected[j], 1e-5);
      }
    }
  }
}

TEST(CurveSegments, BezierSegmentsShareTheirEndsAndParabolasAreRaised) {
  const std::vector<Vec3f> p = some_points(7, 5);
  const auto cubics = bezier_segments(p, 3), parabolas = bezier_segments(p, 2);
  ASSERT_EQ(cubics.size(), 2u);
  ASSERT_EQ(parabolas.size(), 3u);
  EXPECT_EQ(cubics[1].points[0], p[3]);
  EXPECT_EQ(cubics[1].points[3], p[6]);
  for (const float u : {0.0f, 0.4f, 1.0f}) {
    const Vec3f expected = p[2] * sqr(1 - u) + p[3] * (2 * u * (1 - u)) + p[4] * sqr(u);
    EXPECT_LT(length(bezier_point(parabolas[1], u) - expected), 1e-6f);
  }
  EXPECT_TRUE(bezier_segments(some_points(6, 1), 3).empty());
  EXPECT_TRUE(bezier_segments(some_points(1, 1), 2).empty());
  EXPECT_TRUE(bezier_segments({}, 3).empty());
  EXPECT_TRUE(bspline_segments(some_points(3, 1), 3).empty());
}

CurveSegment bent(float width0, float width1) {
  CurveSegment s;
  s.points = {Vec3f(-1, 0, 0), Vec3f(-0.5f, 1.2f, 0.3f), Vec3f(0.4f, -1.0f, 0.5f),
              Vec3f(1, 0.2f, 0)};
  s.width0 = width0;
  s.width1 = width1;
  s.normal0 = normalize(Vec3f(0, 0.2f, 1));
  s.normal1 = normalize(Vec3f(0.1f, 1, 0.4f));
  return s;
}

/// First hit among all pieces.
std::optional<ShapeHit> first_hit(const Shape& shape, const Ray& ray, uint32_t* piece) {
  std::optional<ShapeHit> first;
  for (uint32_t i = 0; i < shape.primitive_count(); ++i) {
    Ray rest = ray;
    if (first) rest.t_max = first->t;
    if (const auto hit = shape.intersect(i, rest, 0.0f)) {
      first = hit;
      *piece = i;
    }
  }
  return first;
}

Ray random_ray(Random& random) {
  Ray ray;
  const Vec3f target = bezier_point(bent(0, 0), random.unit()) + random.in_box(0.15f);
  ray.d = random.direction() * random.in(0.3f, 3.0f);
  ray.o = target - ray.d * (4.0f / length(ray.d));
  return ray;
}

TEST(Curves, RaysMeetThemWhereBruteForceFindsTheCurve) {
  const CurveSegment s = bent(0.3f, 0.1f);
  for (const CurveType type : {CurveType::kFlat, CurveType::kCylinder}) {
    const CurveShape shape(Transform(), false, type, {s});
    Random random(11);
    int hits = 0, misses = 0, unclear = 0, elsewhere = 0;
    for (int i = 0; i < 4000; ++i) {
      const Ray ray = random_ray(random);
      const Vec3f d = normalize(ray.d);
      // At each minimum of the distance to the ray: its ratio to the half width there. Below 1 it
      // is a hit.
      constexpr int kSteps = 1000;
      double distance[kSteps + 1], least = kInfinity, front = kInfinity;
      bool at_edge = false;
      for (int k = 0; k <= kSteps; ++k) {
        const Vec3f to = bezier_point(s, static_cast<float>(k) / kSteps) - ray.o;
        distance[k] = length(to - d * dot(to, d));
      }
      for (int k = 1; k < kSteps; ++k) {
        if (distance[k] > distance[k - 1] || distance[k] > distance[k + 1]) continue;
        const float u = static_cast<float>(k) / kSteps;
        const double ratio = distance[k] / (0.5 * lerp(u, s.width0, s.width1));
        least = std::min(least, ratio);
        at_edge |= std::abs(ratio - 1.0) < 0.02;
        if (ratio < 1.0) front = std::min<double>(front, dot(bezier_point(s, u) - ray.o, d));
      }
      uint32_t piece = 0;
      const auto hit = first_hit(shape, ray, &piece);
      if (at_edge) {
        ++unclear;
        continue;
      }
      EXPECT_EQ(hit.has_value(), least < 1.0) << least;
      (hit ? hits : misses) += 1;
      if (hit && !(std::abs(hit->t * length(ray.d) - front) < 0.01)) ++elsewhere;
    }
    EXPECT_GT(hits, 500);
    EXPECT_GT(misses, 500);
    EXPECT_LT(unclear, 400);
    // A curve along the ray may turn back within the tolerance for straight pieces.
    EXPECT_LE(elsewhere, hits / 200);
  }
}

TEST(Curves, RibbonsLookNarrowerTheMoreTheyTurnAway) {
  // A straight ribbon along x, with normal z.
  CurveSegment s;
  s.points = {Vec3f(-1, 0, 0), Vec3f(-1 / 3.0f, 0, 0), Vec3f(1 / 3.0f, 0, 0), Vec3f(1, 0, 0)};
  s.width0 = s.width1 = 0.2f;
  s.normal0 = s.normal1 = Vec3f(0, 0, 1);
  const CurveShape shape(Transform(), false, CurveType::kRibbon, {s});
  for (const float degrees : {0.0f, 30.0f, 60.0f, 85.0f, 120.0f}) {
    const float a = degrees * kPi / 180.0f;
    const Vec3f d(0, std::sin(a), std::cos(a)), across(0, std::cos(a), -std::sin(a));
    const float half = 0.1f * std::abs(std::cos(a));
    for (const float part : {0.98f, 1.02f}) {
      Ray ray;
      ray.o = Vec3f(0.2f, 0, 0) + across * (half * part) - d * 3.0f;
      ray.d = d;
      EXPECT_EQ(shape.intersect(0, ray, 0).has_value(), part < 1) << degrees;
      EXPECT_EQ(shape.is_hit(0, 0.6f, ray), part < 1) << degrees;
    }
  }
  // Twisted by 90 degrees from end to end: 45 degrees in the middle.
  s.normal1 = Vec3f(0, 1, 0);
  const CurveShape twisted(Transform(), false, CurveType::kRibbon, {s});
  Ray ray;
  ray.d = Vec3f(0, 0, 1);
  for (const float part : {0.98f, 1.02f}) {
    ray.o = Vec3f(0, 0.1f * std::sqrt(0.5f) * part, -2);
    uint32_t piece;
    EXPECT_EQ(first_hit(twisted, ray, &piece).has_value(), part < 1);
  }
}

TEST(Curves, HitsAreDescribedAsTheFormatSays) {
  const CurveSegment s = bent(0.3f, 0.1f);
  for (const CurveType type : {CurveType::kFlat, CurveType::kCylinder, CurveType::kRibbon}) {
    const CurveShape shape(Transform(), false, type, {s});
    Random random(13);
    int looked_at = 0;
    for (int i = 0; i < 3000; ++i) {
      const Ray ray = random_ray(random);
      uint32_t piece = 0;
      const auto hit = first_hit(shape, ray, &piece);
      if (!hit) continue;
      ++looked_at;
      SurfaceInteraction at;
      shape.fill(piece, hit->uv, ray, hit->t, at);
      const Vec3f d = normalize(ray.d), curve = bezier_point(s, at.uv.x), off = at.p - curve;
      // The point is on the ray, in the plane across the ray through the curve's nearest point.
      EXPECT_LT(length(cross(at.p - ray.o, d)), 1e-5f);
      EXPECT_NEAR(dot(off, d), 0.0f, 1e-5f);
      const float h = 1e-3f;
      const Vec3f dpdu = (bezier_point(s, at.uv.x + h) - bezier_point(s, at.uv.x - h)) / (2 * h);
      EXPECT_LT(length(at.dpdu - dpdu), 2e-3f * length(dpdu));
      // v runs from edge to edge, to the left of the curve as seen from the ray.
      float width = lerp(at.uv.x, s.width0, s.width1);
      if (type == CurveType::kRibbon) width = length(at.dpdv);
      const Vec3f left = normalize(cross(d, at.dpdu));
      EXPECT_NEAR(at.uv.y, 0.5f + dot(off, left) / width, 0.02f);
      EXPECT_NEAR(length(at.dpdv), width, 1e-5f);
      EXPECT_NEAR(dot(normalize(at.dpdu), normalize(at.dpdv)), 0.0f, 1e-4f);
      EXPECT_NEAR(length(at.ng), 1.0f, 1e-5f);
      EXPECT_GT(dot(at.ng, normalize(cross(at.dpdu, at.dpdv))), 0.9999f);
      for (int j = 0; j < 3; ++j) EXPECT_NEAR(at.p_error[j], width, 1e-5f);
      if (type == CurveType::kFlat) {
        EXPECT_NEAR(std::abs(dot(normalize(at.dpdv), d)), 0.0f, 1e-4f);
      } else if (type == CurveType::kCylinder) {
        // The normal leans outwards by the sine of the angle on the cylinder.
        EXPECT_NEAR(dot(at.ng, left), std::sin((at.uv.y - 0.5f) * kPi), 2e-3f);
      } else {
        const float angle = std::acos(dot(s.normal0, s.normal1));
        const Vec3f n = s.normal0 * (std::sin((1 - at.uv.x) * angle) / std::sin(angle)) +
                        s.normal1 * (std::sin(at.uv.x * angle) / std::sin(angle));
        EXPECT_GT(dot(n, at.ng), 0.0f);
        EXPECT_NEAR(dot(at.ng, normalize(cross(n, at.dpdu))), 0.0f, 1e-4f);
        EXPECT_NEAR(width, lerp(at.uv.x, s.width0, s.width1) * std::abs(dot(n, d)), 1e-4f);
      }
    }
    EXPECT_GT(looked_at, 300);
  }
}

TEST(Curves, MapsOfPointsAndMapsOfRaysAgree) {
  // Similarity transforms are baked into the points. One stretched by a few parts in 100 000 is
  // not.
  Mat44d similar = Random(17).rotation();
  similar = Mat44d().setScale(Imath::V3d(2.5, 2.5, -2.5)) * similar;
  similar[3][0] = 0.7;
  const Mat44d stretched = Mat44d().setScale(Imath::V3d(1.00003, 1, 1)) * similar;
  for (const CurveType type : {CurveType::kFlat, CurveType::kCylinder, CurveType::kRibbon}) {
    for (const bool reverse : {false, true}) {
      const CurveShape baked(Transform(similar), reverse, type, {bent(0.3f, 0.1f)});
      const CurveShape other(Transform(stretched), reverse, type, {bent(0.3f, 0.1f)});
      ASSERT_TRUE(baked.is_traceable() && !other.is_traceable());
      ASSERT_EQ(baked.primitive_count(), other.primitive_count());
      Random random(19);
      int compared = 0, differ = 0;
      for (int i = 0; i < 2000; ++i) {
        const Ray local = random_ray(random);
        Ray ray = local;
        ray.o = Transform(similar).point(local.o);
        ray.d = Transform(similar).vector(local.d);
        uint32_t piece_a = 0, piece_b = 0;
        const auto a = first_hit(baked, ray, &piece_a), b = first_hit(other, ray, &piece_b);
        if (a.has_value() != b.has_value() || piece_a != piece_b) {
          ++differ;
          continue;
        }
        if (!a) continue;
        SurfaceInteraction at, bt;
        baked.fill(piece_a, a->uv, ray, a->t, at);
        other.fill(piece_b, b->uv, ray, b->t, bt);
        if (std::abs(at.uv.x - bt.uv.x) > 0.01f) {
          ++differ;  // the ray is parallel to the curve
          continue;
        }
        ++compared;
        EXPECT_LT(length(at.p - bt.p), 2e-3f);
        EXPECT_NEAR(at.uv.y, bt.uv.y, 5e-3f);
        EXPECT_GT(dot(at.ng, bt.ng), 0.998f);
        EXPECT_GT(dot(normalize(at.dpdu), normalize(bt.dpdu)), 0.998f);
        EXPECT_GT(dot(normalize(at.dpdv), normalize(bt.dpdv)), 0.998f);
        EXPECT_LT(length(at.p_error - bt.p_error), 5e-3f * length(bt.p_error) + 1e-3f);
      }
      EXPECT_GT(compared, 150);
      EXPECT_LT(differ, 10);
    }
  }
}

TEST(Curves, LightLeavesTheCurveOnBothSides) {
  // A straight curve is never hit again, neither by reflected nor by transmitted rays.
  CurveSegment s;
  s.points = {Vec3f(-1, 0, 0), Vec3f(-1 / 3.0f, 0, 0), Vec3f(1 / 3.0f, 0, 0), Vec3f(1, 0, 0)};
  s.width0 = 0.02f;
  s.width1 = 0.04f;
  for (const CurveType type : {CurveType::kFlat, CurveType::kCylinder}) {
    const CurveShape shape(Transform(), false, type, {s});
    Random random(23);
    int left = 0, again = 0;
    for (int i = 0; i < 5000; ++i) {
      Ray ray;
      ray.d = random.direction();
      ray.o = Vec3f(random.in(-0.8f, 0.8f), 0, 0) + random.in_box(0.02f) - ray.d * 2.0f;
      const auto hit = shape.intersect(0, ray, 0.0f);
      if (!hit) continue;
      SurfaceInteraction at;
      shape.fill(0, hit->uv, ray, hit->t, at);
      Ray away;
      away.d = random.direction();
      away.o = at.spawn_origin(away.d);
      ++left;
      again += shape.intersect(0, away, 0.0f).has_value();
    }
    EXPECT_GT(left, 1000);
    EXPECT_EQ(again, 0);
  }
}

TEST(Curves, PiecesAreNearlyStraightAndBounded) {
  const CurveShape wide(Transform(), false, CurveType::kFlat, {bent(0.3f, 0.3f)});
  const CurveShape thin(Transform(), false, CurveType::kFlat, {bent(0.003f, 0.003f)});
  EXPECT_GT(thin.primitive_count(), 2 * wide.primitive_count());
  CurveSegment point;
  point.points.fill(Vec3f(1, 2, 3));
  EXPECT_EQ(CurveShape(Transform(), false, CurveType::kFlat, {point}).primitive_count(), 0u);
  // Hits are inside the bounds of their piece.
  Random random(29);
  for (int i = 0; i < 1000; ++i) {
    const Ray ray = random_ray(random);
    for (uint32_t k = 0; k < wide.primitive_count(); ++k) {
      const auto hit = wide.intersect(k, ray, 0.0f);
      if (!hit) continue;
      const Bounds3f box = wide.bounds(k);
      const Vec3f p = ray.o + ray.d * hit->t;
      for (int j = 0; j < 3; ++j) {
        EXPECT_GE(p[j], box.min[j] - 1e-5f);
        EXPECT_LE(p[j], box.max[j] + 1e-5f);
      }
    }
  }
}

}  // namespace
}  // namespace nephroid
