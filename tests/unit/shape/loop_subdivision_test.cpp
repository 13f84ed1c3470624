// Loop subdivision: counts, closed-form limits, normals, boundaries, bad input.
#include <gtest/gtest.h>

#include <stdexcept>

#include "scene/shape/shape.h"

namespace nephroid {
namespace {

const std::vector<Vec3f> kTetrahedron = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
const std::vector<uint32_t> kTetrahedronFaces = {0, 1, 2, 0, 2, 3, 0, 3, 1, 1, 3, 2};
const std::vector<Vec3f> kOctahedron = {{1, 0, 0},  {-1, 0, 0}, {0, 1, 0},
                                        {0, -1, 0}, {0, 0, 1},  {0, 0, -1}};
const std::vector<uint32_t> kOctahedronFaces = {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4,
                                                2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5};

TEST(LoopSubdivision, CountsFollowEuler) {
  for (int levels = 0; levels <= 4; ++levels) {
    const MeshData mesh = loop_subdivide(kTetrahedron, kTetrahedronFaces, levels);
    const size_t faces = 4u << (2 * levels);
    EXPECT_EQ(mesh.triangles.size(), 3 * faces);
    EXPECT_EQ(mesh.positions.size(), 2 + faces / 2);
    EXPECT_EQ(mesh.normals.size(), mesh.positions.size());
    EXPECT_TRUE(mesh.uvs.empty());
  }
}

TEST(LoopSubdivision, CornersOfATetrahedronMoveToOneFifth) {
  // Valence 3: limit = 2/5 p + 1/5 (sum of the others = -p). The level does not change a limit.
  for (int levels = 0; levels <= 4; ++levels) {
    const MeshData mesh = loop_subdivide(kTetrahedron, kTetrahedronFaces, levels);
    for (const Vec3f& corner : kTetrahedron) {
      float nearest = kInfinity;
      for (const Vec3f& p : mesh.positions) nearest = std::min(nearest, length(p - corner * 0.2f));
      EXPECT_LT(nearest, 1e-6f) << levels;
    }
  }
}

TEST(LoopSubdivision, StaysWithinTheHullAndKeepsSymmetry) {
  const MeshData mesh = loop_subdivide(kTetrahedron, kTetrahedronFaces, 4);
  Vec3f sum(0, 0, 0);
  for (const Vec3f& p : mesh.positions) {
    // This tetrahedron's faces are x + y + z >= -1 and its mirror images.
    EXPECT_GE(p.x + p.y + p.z, -1.0f);
    EXPECT_GE(p.x - p.y - p.z, -1.0f);
    EXPECT_GE(-p.x + p.y - p.z, -1.0f);
    EXPECT_GE(-p.x - p.y + p.z, -1.0f);
    sum += p;
  }
  EXPECT_LT(length(sum) / static_cast<float>(mesh.positions.size()), 1e-6f);
}

TEST(LoopSubdivision, OctahedronCornerHasItsKnownLimitAndNormal) {
  // Valence 4: neighbour weight 3/32, limit weight 1 / (4 + 3 / (8 * 3/32)) = 1/8. The ring sums to
  // 0.
  for (int levels : {0, 3}) {
    const MeshData mesh = loop_subdivide(kOctahedron, kOctahedronFaces, levels);
    bool found = false;
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
      if (length(mesh.positions[i] - Vec3f(0, 0, 0.5f)) > 1e-6f) continue;
      found = true;
      // These faces are counter-clockwise from outside; the normals point inwards.
      EXPECT_LT(length(normalize(mesh.normals[i]) - Vec3f(0, 0, -1)), 1e-6f);
    }
    EXPECT_TRUE(found) << levels;
  }
}

TEST(LoopSubdivision, NormalsAgreeWithTheFacesUpToTheCommonSide) {
  const MeshData mesh = loop_subdivide(kOctahedron, kOctahedronFaces, 4);
  for (size_t i = 0; i < mesh.triangles.size(); i += 3) {
    const uint32_t* v = &mesh.triangles[i];
    const auto& p = mesh.positions;
    const Vec3f n = normalize(cross(p[v[1]] - p[v[0]], p[v[2]] - p[v[0]]));
    EXPECT_GT(dot(n, p[v[0]]), 0.0f);
    for (int k = 0; k < 3; ++k) EXPECT_LT(dot(n, normalize(mesh.normals[v[k]])), -0.95f);
  }
}

/// An n x n grid of squares at z = 2, each split in two.
void make_grid(int n, std::vector<Vec3f>& positions, std::vector<uint32_t>& faces) {
  for (int y = 0; y <= n; ++y)
    for (int x = 0; x <= n; ++x) positions.emplace_back(float(x), float(y), 2.0f);
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      const uint32_t a = static_cast<uint32_t>(y * (n + 1) + x), b = a + 1;
      const uint32_t c = a + static_cast<uint32_t>(n + 1), d = c + 1;
      for (const uint32_t v : {a, b, d, a, d, c}) faces.push_back(v);
    }
}

TEST(LoopSubdivision, PlanesStayPlaneWithNormalsAtEveryBoundary) {
  std::vector<Vec3f> positions;
  std::vector<uint32_t> faces;
  make_grid(3, positions, faces);
  const MeshData mesh = loop_subdivide(positions, faces, 2);
  EXPECT_EQ(mesh.triangles.size(), 3u * 18u * 16u);
  Bounds3f box;
  for (size_t i = 0; i < mesh.positions.size(); ++i) {
    EXPECT_NEAR(mesh.positions[i].z, 2.0f, 1e-6f);
    EXPECT_LT(length(normalize(mesh.normals[i]) - Vec3f(0, 0, -1)), 1e-5f);
    box.extendBy(mesh.positions[i]);
  }
  // In the middle of a side the boundary is straight. A corner moves to 1/8 of both neighbours,
  // then from (1/8,1/8) to (5/32,5/32), then by 1/5 of the two at (5/16,1/16) and (1/16,5/16).
  EXPECT_NEAR(box.min.x, 0.0f, 1e-6f);
  EXPECT_NEAR(box.max.y, 3.0f, 1e-6f);
  float corner = kInfinity;
  const Vec3f expected(0.16875f, 0.16875f, 2);
  for (const Vec3f& p : mesh.positions) corner = std::min(corner, length(p - expected));
  EXPECT_LT(corner, 1e-6f);
}

TEST(LoopSubdivision, VerticesThatNoFaceUsesAreDropped) {
  std::vector<Vec3f> positions = kTetrahedron;
  positions.insert(positions.begin(), Vec3f(50, 50, 50));
  std::vector<uint32_t> faces = kTetrahedronFaces;
  for (uint32_t& v : faces) ++v;
  EXPECT_EQ(loop_subdivide(positions, faces, 1).positions.size(), 10u);
  EXPECT_TRUE(loop_subdivide(positions, {}, 3).triangles.empty());
}

TEST(LoopSubdivision, BadInputIsRefusedWithAReason) {
  const auto reason = [](const std::vector<Vec3f>& p, const std::vector<uint32_t>& f, int levels) {
    try {
      loop_subdivide(p, f, levels);
    } catch (const std::invalid_argument& e) {
      return std::string(e.what());
    }
    return std::string("accepted");
  };
  const std::vector<Vec3f> p(6, Vec3f(0, 0, 0));
  EXPECT_NE(reason(p, {0, 1, 6}, 1).find("vertex index 6 is out of range"), std::string::npos);
  EXPECT_NE(reason(p, {0, 1}, 1).find("multiple of 3"), std::string::npos);
  EXPECT_NE(reason(p, {0, 1, 1}, 1).find("twice"), std::string::npos);
  EXPECT_NE(reason(p, {0, 1, 2, 1, 0, 3, 0, 1, 4}, 1).find("3 faces"), std::string::npos);
  EXPECT_NE(reason(p, {0, 1, 2, 0, 1, 3}, 1).find("same direction"), std::string::npos);
  EXPECT_NE(reason(p, {0, 1, 2, 0, 3, 4}, 1).find("share no edge"), std::string::npos);
  EXPECT_NE(reason(kTetrahedron, kTetrahedronFaces, -1).find("expected 0 or more"),
            std::string::npos);
  EXPECT_NE(reason(kTetrahedron, kTetrahedronFaces, 40).find("too many"), std::string::npos);
  std::vector<Vec3f> bad = kTetrahedron;
  bad[2].y = kInfinity;
  EXPECT_NE(reason(bad, kTetrahedronFaces, 1).find("not finite"), std::string::npos);
}

}  // namespace
}  // namespace nephroid
