// Displaced meshes: edge lengths, no cracks, positions of the vertices, and no lost data.
#include "scene/shape/displacement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace nephroid {
namespace {

/// The unit square at z = 0, as one quad facing up.
MeshData square() {
  MeshData mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  mesh.quads = {0, 1, 2, 3};
  return mesh;
}

Displacement constant(float height, float edge_length) {
  Displacement d;
  d.edge_length = edge_length;
  d.height = [height](const Vec3f&, const Vec2f&) { return height; };
  return d;
}

double area(const MeshData& mesh) {
  double sum = 0;
  for (size_t i = 0; i < mesh.triangles.size(); i += 3) {
    const Vec3f& p0 = mesh.positions[mesh.triangles[i]];
    sum += 0.5 * length(cross(mesh.positions[mesh.triangles[i + 1]] - p0,
                              mesh.positions[mesh.triangles[i + 2]] - p0));
  }
  return sum;
}

float longest_edge(const MeshData& mesh, const Transform& to_world) {
  float longest = 0;
  for (size_t i = 0; i < mesh.triangles.size(); ++i) {
    const size_t next = i % 3 == 2 ? i - 2 : i + 1;
    longest = std::max(longest, length(to_world.point(mesh.positions[mesh.triangles[i]]) -
                                       to_world.point(mesh.positions[mesh.triangles[next]])));
  }
  return longest;
}

TEST(Displacement, MovesASquareAlongItsNormal) {
  const MeshData mesh = *displace_mesh(square(), constant(0.25f, 0.2f));
  EXPECT_TRUE(mesh.quads.empty());
  EXPECT_NEAR(area(mesh), 1.0, 1e-5);
  ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
  ASSERT_EQ(mesh.uvs.size(), mesh.positions.size());
  for (size_t i = 0; i < mesh.positions.size(); ++i) {
    EXPECT_EQ(mesh.positions[i].z, 0.25f);
    EXPECT_EQ(mesh.positions[i].x, mesh.uvs[i].x);
    EXPECT_EQ(mesh.normals[i], Vec3f(0, 0, 1));
  }
}

TEST(Displacement, EdgesAreShortInTheWorldAndNotMuchShorter) {
  Mat44d stretched;
  stretched[0][0] = 3;
  stretched[1][1] = 2;
  Displacement d = constant(0, 0.1f);
  d.object_to_world = Transform(stretched);
  const MeshData mesh = *displace_mesh(square(), d);
  EXPECT_LT(longest_edge(mesh, d.object_to_world), 0.1f);
  // Area 6, triangles with legs between 0.05 and 0.1: far more triangles would be wasted.
  EXPECT_LT(mesh.triangles.size() / 3, 6 / (0.5 * 0.035 * 0.035));
  EXPECT_GT(mesh.triangles.size() / 3, 6 / (0.5 * 0.1 * 0.1));
}

TEST(Displacement, NeighboursShareTheirVertices) {
  // Triangles of very different sizes: each inner edge occurs once in either direction, so that
  // there is no gap.
  MeshData coarse;
  coarse.positions = {{0, 0, 0}, {4, 0, 0}, {0, 1, 0}, {4, 1, 0}, {2, -0.2f, 1}, {0, 5, 0}};
  coarse.uvs.resize(6, Vec2f(0, 0));
  coarse.triangles = {0, 1, 2, 2, 1, 3, 1, 0, 4, 2, 3, 5};
  Displacement d = constant(0, 0.3f);
  d.height = [](const Vec3f& p, const Vec2f&) { return 0.1f * std::sin(9 * p.x + 5 * p.y); };
  const MeshData mesh = *displace_mesh(coarse, d);
  std::map<std::pair<uint32_t, uint32_t>, int> directed;
  for (size_t i = 0; i < mesh.triangles.size(); ++i)
    ++directed[{mesh.triangles[i], mesh.triangles[i % 3 == 2 ? i - 2 : i + 1]}];
  int border = 0;
  for (const auto& [edge, count] : directed) {
    EXPECT_EQ(count, 1);
    border += directed.count({edge.second, edge.first}) ? 0 : 1;
  }
  // Euler: a disc without holes has V - E + F = 1 with E = (directed + border) / 2.
  const auto edges = (static_cast<int64_t>(directed.size()) + border) / 2;
  EXPECT_EQ(static_cast<int64_t>(mesh.positions.size()) - edges +
                static_cast<int64_t>(mesh.triangles.size() / 3),
            1);
}

TEST(Displacement, AnOctahedronWithTheRightHeightsBecomesASphere) {
  MeshData mesh;
  mesh.positions = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  mesh.normals = mesh.positions;
  mesh.uvs.resize(6, Vec2f(0, 0));
  mesh.triangles = {0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4, 1, 0, 5, 2, 1, 5, 3, 2, 5, 0, 3, 5};
  Displacement d = constant(0, 0.1f);
  // Midpoints get interpolated normals, which are not radial in general: the distance to the sphere
  // is bounded, not zero.
  d.height = [](const Vec3f& p, const Vec2f&) { return 1 - length(p); };
  const MeshData sphere = *displace_mesh(mesh, d);
  EXPECT_NEAR(area(sphere), 4 * kPi, 0.02 * 4 * kPi);
  for (size_t i = 0; i < sphere.positions.size(); ++i) {
    EXPECT_NEAR(length(sphere.positions[i]), 1.0f, 0.02f);
    // The new normals are the sphere's.
    EXPECT_GT(dot(sphere.normals[i], normalize(sphere.positions[i])), 0.98f);
  }
}

TEST(Displacement, FaceIndicesGoOnToTheParts) {
  MeshData mesh = square();
  mesh.positions.insert(mesh.positions.end(), {{0, 0, 5}, {1, 0, 5}, {0, 1, 5}});
  mesh.uvs.insert(mesh.uvs.end(), 3, Vec2f(0, 0));
  mesh.triangles = {4, 5, 6};
  mesh.face_indices = {7, 9};  // the triangle, then the quad
  const MeshData fine = *displace_mesh(mesh, constant(0, 0.3f));
  ASSERT_EQ(fine.face_indices.size(), fine.triangles.size() / 3);
  for (size_t i = 0; i < fine.face_indices.size(); ++i)
    EXPECT_EQ(fine.face_indices[i], fine.positions[fine.triangles[3 * i]].z > 1 ? 7 : 9);
}

TEST(Displacement, GivesUpBeforeItIsTooMuch) {
  EXPECT_FALSE(displace_mesh(square(), constant(0, 0.01f), 5000));
  EXPECT_TRUE(displace_mesh(square(), constant(0, 0.1f), 5000));
  Displacement nothing = constant(0, 1e-30f);
  EXPECT_FALSE(displace_mesh(square(), nothing, 5000));
}

}  // namespace
}  // namespace nephroid
