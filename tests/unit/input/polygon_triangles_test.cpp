// Triangulated polygons keep their area, winding and interior.
#include "input/polygon_triangles.h"

#include <gtest/gtest.h>

#include <chrono>
#include <set>

namespace nephroid {
namespace {

using Corners = std::vector<Vec3f>;

Vec3d area_vector(const Vec3f& a, const Vec3f& b, const Vec3f& c) {
  return (to_double(b) - to_double(a)).cross(to_double(c) - to_double(a)) * 0.5;
}
Vec3d area_vector(const Corners& ring) {
  Vec3d sum(0, 0, 0);
  for (size_t i = 1; i + 1 < ring.size(); ++i) sum += area_vector(ring[0], ring[i], ring[i + 1]);
  return sum;
}

/// Expects n - 2 triangles of the ring's corners that wind like the polygon and have its total
/// area: so none overlaps another or sticks out.
void expect_good_triangles(const Corners& ring, double tolerance = 1e-6) {
  const std::vector<uint32_t> t = triangulate_polygon(ring);
  ASSERT_EQ(t.size(), 3 * (ring.size() - 2));
  const Vec3d whole = area_vector(ring), normal = whole.normalized();
  double sum = 0.0;
  std::set<uint32_t> used;
  for (size_t i = 0; i < t.size(); i += 3) {
    ASSERT_LT(std::max({t[i], t[i + 1], t[i + 2]}), ring.size());
    const double area = area_vector(ring[t[i]], ring[t[i + 1]], ring[t[i + 2]]).dot(normal);
    EXPECT_GE(area, -tolerance * whole.length()) << "triangle " << i / 3;
    sum += std::abs(area);
    used.insert({t[i], t[i + 1], t[i + 2]});
  }
  EXPECT_NEAR(sum, whole.length(), tolerance * whole.length());
  EXPECT_EQ(used.size(), ring.size());
}

/// Tests the ring itself, reversed, from every corner, and rotated out of the xy plane.
void expect_good_from_everywhere(const Corners& ring) {
  const auto turned = [](const Vec3f& p) {
    return Vec3f(0.36f * p.x - 0.8f * p.y, 0.48f * p.x + 0.6f * p.y, 0.8f * p.x) * 7.0f +
           Vec3f(100, -50, 3);
  };
  for (size_t start = 0; start < ring.size(); ++start) {
    Corners from(ring.begin() + static_cast<std::ptrdiff_t>(start), ring.end());
    from.insert(from.end(), ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(start));
    SCOPED_TRACE(start);
    expect_good_triangles(from);
    expect_good_triangles(Corners(from.rbegin(), from.rend()));
    for (Vec3f& p : from) p = turned(p);
    expect_good_triangles(from, 1e-5);
  }
}

Corners star(int points, float inner) {
  Corners ring;
  for (int i = 0; i < 2 * points; ++i) {
    const float a = kPi * static_cast<float>(i) / static_cast<float>(points);
    ring.push_back(Vec3f(std::cos(a), std::sin(a), 0) * (i % 2 ? inner : 1.0f));
  }
  return ring;
}

TEST(PolygonTriangles, Convex) {
  expect_good_from_everywhere({{0, 0, 0}, {2, 0, 0}, {3, 1, 0}, {1, 3, 0}, {-1, 1, 0}});
  expect_good_from_everywhere({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  Corners circle;
  for (int i = 0; i < 40; ++i) {
    const float a = 2 * kPi * static_cast<float>(i) / 40;
    circle.push_back({std::cos(a), std::sin(a), 0});
  }
  expect_good_from_everywhere(circle);
}

TEST(PolygonTriangles, Concave) {
  expect_good_from_everywhere({{0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}});
  expect_good_from_everywhere(star(5, 0.3f));
  expect_good_from_everywhere(star(17, 0.02f));
  // A comb whose teeth cannot see each other.
  Corners comb = {{20, 5, 0}, {0, 5, 0}};
  for (int i = 0; i < 10; ++i) {
    const auto x = static_cast<float>(2 * i);
    comb.insert(comb.end(), {{x, 0, 0}, {x + 1, 0, 0}, {x + 1, 4, 0}, {x + 2, 4, 0}});
  }
  comb.pop_back();
  comb.push_back({20, 4, 0});
  expect_good_from_everywhere(comb);
}

TEST(PolygonTriangles, CornersOnAnEdge) {
  expect_good_from_everywhere({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}});
  expect_good_from_everywhere(
      {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}, {0, 2, 0}, {0, 1, 0}});
}

TEST(PolygonTriangles, AHoleBehindADoubleEdge) {
  // A square with a square hole, as written by programs without holes.
  const Corners ring = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {0, 0, 0},
                        {1, 1, 0}, {1, 3, 0}, {3, 3, 0}, {3, 1, 0}, {1, 1, 0}};
  EXPECT_NEAR(area_vector(ring).z, 12.0, 1e-9);
  expect_good_from_everywhere(ring);
}

TEST(PolygonTriangles, NearlyPlane) {
  Corners ring = star(9, 0.4f);
  for (size_t i = 0; i < ring.size(); ++i) ring[i].z = 0.02f * static_cast<float>(i % 3);
  const std::vector<uint32_t> t = triangulate_polygon(ring);
  ASSERT_EQ(t.size(), 3 * (ring.size() - 2));
  Vec3d sum(0, 0, 0);
  for (size_t i = 0; i < t.size(); i += 3) {
    const Vec3d area = area_vector(ring[t[i]], ring[t[i + 1]], ring[t[i + 2]]);
    EXPECT_GT(area.z, 0.0);
    sum += area;
  }
  EXPECT_LT((sum - area_vector(ring)).length(), 1e-6);
}

TEST(PolygonTriangles, WithoutAreaOrCrossingThemselvesTheyStillEnd) {
  EXPECT_TRUE(triangulate_polygon({}).empty());
  EXPECT_EQ(triangulate_polygon(Corners(6, Vec3f(1, 2, 3))).size(), 12u);
  EXPECT_EQ(
      triangulate_polygon(Corners{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {1, 0, 0}}).size(),
      9u);
  Corners pentagram;
  for (int i = 0; i < 5; ++i) {
    const float a = 4 * kPi * static_cast<float>(i) / 5;
    pentagram.push_back({std::cos(a), std::sin(a), 0});
  }
  EXPECT_EQ(triangulate_polygon(pentagram).size(), 9u);
}

TEST(PolygonTriangles, LargeOnesTakeNoTimeToSpeakOf) {
  const auto start = std::chrono::steady_clock::now();
  expect_good_triangles(star(2000, 0.9f), 1e-4);
  // Generous, for slow machines: it takes about a hundredth of this.
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
}

}  // namespace
}  // namespace nephroid
