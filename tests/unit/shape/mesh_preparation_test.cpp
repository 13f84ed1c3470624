// Preparation of a mesh before it becomes a shape: checks, quads, transforms.
#include "scene/shape/mesh_preparation.h"

#include <gtest/gtest.h>

#include "scene/shape/shape.h"

namespace nephroid {
namespace {

MeshData square_and_triangle() {
  MeshData mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}};
  mesh.triangles = {1, 4, 2};
  mesh.quads = {0, 1, 2, 3};
  mesh.face_indices = {7, 8};
  return mesh;
}

const SourceLocation kWhere{std::make_shared<const std::string>("scene.pbrt"), 12, 3};

std::string refusal(MeshData mesh) {
  Diagnostics diagnostics;
  try {
    validate_mesh(mesh, kWhere, "trianglemesh", diagnostics);
  } catch (const SceneError& e) {
    return e.what();
  }
  return "accepted";
}

TEST(MeshPreparation, GoodMeshesPassUnchanged) {
  MeshData mesh = square_and_triangle();
  Diagnostics diagnostics;
  validate_mesh(mesh, kWhere, "trianglemesh", diagnostics);
  EXPECT_EQ(mesh.triangles, square_and_triangle().triangles);
  EXPECT_EQ(mesh.quads, square_and_triangle().quads);
  EXPECT_TRUE(diagnostics.warnings().empty());
}

TEST(MeshPreparation, ErrorsNamePlaceAndValue) {
  MeshData mesh = square_and_triangle();
  mesh.triangles[1] = 5;
  EXPECT_EQ(refusal(mesh),
            "scene.pbrt:12:3: trianglemesh has the vertex index 5 in triangle 0, expected 0 to 4");
  mesh = square_and_triangle();
  mesh.quads[3] = static_cast<uint32_t>(-1);
  EXPECT_NE(refusal(mesh).find("vertex index -1 in quad 0"), std::string::npos);
  mesh = square_and_triangle();
  mesh.positions[3].y = std::numeric_limits<float>::quiet_NaN();
  EXPECT_NE(refusal(mesh).find("vertex 3 is (0, nan, 0)"), std::string::npos);
  mesh = square_and_triangle();
  mesh.normals.resize(4, Vec3f(0, 0, 1));
  EXPECT_NE(refusal(mesh).find("4 normals, expected 5"), std::string::npos);
  mesh = square_and_triangle();
  mesh.uvs.resize(6, Vec2f(0, 0));
  EXPECT_NE(refusal(mesh).find("6 texture coordinates, expected 5"), std::string::npos);
  mesh = square_and_triangle();
  mesh.uvs.resize(5, Vec2f(kInfinity, 0));
  EXPECT_NE(refusal(mesh).find("texture coordinate that is not finite, of vertex 0"),
            std::string::npos);
  mesh = square_and_triangle();
  mesh.triangles.push_back(0);
  EXPECT_NE(refusal(mesh).find("4 indices of triangles"), std::string::npos);
  mesh = square_and_triangle();
  mesh.face_indices.push_back(1);
  EXPECT_NE(refusal(mesh).find("3 face indices, expected 2"), std::string::npos);
}

TEST(MeshPreparation, FacesWithoutAreaAreRemovedAndCounted) {
  MeshData mesh = square_and_triangle();
  mesh.triangles = {0, 1, 4, 1, 4, 2, 3, 3, 2};
  mesh.quads = {0, 1, 4, 1, 0, 1, 2, 3};
  mesh.face_indices = {1, 2, 3, 4, 5};
  Diagnostics diagnostics;
  validate_mesh(mesh, kWhere, "mesh", diagnostics);
  EXPECT_EQ(mesh.triangles, (std::vector<uint32_t>{1, 4, 2}));
  EXPECT_EQ(mesh.quads, (std::vector<uint32_t>{0, 1, 2, 3}));
  EXPECT_EQ(mesh.face_indices, (std::vector<int>{2, 5}));
  ASSERT_EQ(diagnostics.warnings().size(), 1u);
  EXPECT_NE(diagnostics.warnings()[0].message.find("3 of 5 faces"), std::string::npos);

  mesh.triangles = {0, 1, 4};
  mesh.quads.clear();
  mesh.face_indices.clear();
  Diagnostics all;
  validate_mesh(mesh, kWhere, "mesh", all);
  EXPECT_TRUE(mesh.triangles.empty());
  EXPECT_EQ(all.warnings().size(), 1u);
  Diagnostics none;
  validate_mesh(mesh, kWhere, "mesh", none);
  EXPECT_TRUE(none.warnings().empty());
}

TEST(MeshPreparation, FewFacesWithoutAreaAreNormal) {
  MeshData mesh = square_and_triangle();
  mesh.quads.clear();
  mesh.face_indices.clear();
  mesh.triangles = {0, 1, 1};
  for (int i = 0; i < 9; ++i) mesh.triangles.insert(mesh.triangles.end(), {0, 1, 2});
  Diagnostics few;
  validate_mesh(mesh, kWhere, "mesh", few);
  EXPECT_TRUE(few.warnings().empty());
  ASSERT_EQ(few.notes().size(), 1u);
  EXPECT_EQ(few.notes()[0].message, "mesh: 1 of 10 faces has no area and was removed");
  mesh.triangles.insert(mesh.triangles.end(), {0, 1, 1, 2, 2, 1});
  Diagnostics many;
  validate_mesh(mesh, kWhere, "mesh", many);
  EXPECT_EQ(many.warnings().size(), 1u);
  EXPECT_TRUE(many.notes().empty());
}

TEST(MeshPreparation, NormalsThatAreNotFiniteLeaveTheFacesTheirOwn) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  MeshData mesh = square_and_triangle();
  mesh.positions.push_back({9, 9, 9});  // no face uses it
  mesh.normals.assign(6, Vec3f(0, 0.6f, 0.8f));
  for (const size_t i : {1u, 2u, 4u, 5u}) mesh.normals[i] = Vec3f(0, nan, kInfinity);
  Diagnostics diagnostics;
  zero_bad_normals(mesh, kWhere, "mesh", diagnostics);
  ASSERT_EQ(diagnostics.warnings().size(), 1u);
  EXPECT_EQ(diagnostics.warnings()[0].where.line, 12);
  EXPECT_NE(diagnostics.warnings()[0].message.find("3 of 6 normals are not finite"),
            std::string::npos);
  for (const size_t i : {1u, 2u, 4u, 5u}) EXPECT_EQ(mesh.normals[i], Vec3f(0, 0, 0));
  EXPECT_EQ(mesh.normals[0], Vec3f(0, 0.6f, 0.8f));
  // The triangle 1 4 2 has no normal left.
  SurfaceInteraction hit;
  TriangleMesh(triangles_of(mesh), false).fill(0, {0.3f, 0.3f}, Ray(), 0, hit);
  EXPECT_EQ(hit.ng, Vec3f(0, 0, 1));
  EXPECT_EQ(hit.shading.z, Vec3f(0, 0, 1));

  Diagnostics none;
  mesh = square_and_triangle();
  mesh.positions.push_back({9, 9, 9});
  mesh.normals.assign(6, Vec3f(0, 0, 1));
  mesh.normals[5].x = nan;
  zero_bad_normals(mesh, kWhere, "mesh", none);
  EXPECT_TRUE(none.warnings().empty());
  EXPECT_EQ(mesh.normals[5], Vec3f(0, 0, 0));
}

TEST(MeshPreparation, QuadsBecomeTrianglesOrPatches) {
  const MeshData split = split_quads(square_and_triangle());
  EXPECT_EQ(split.triangles, (std::vector<uint32_t>{1, 4, 2, 0, 1, 2, 0, 2, 3}));
  EXPECT_EQ(split.face_indices, (std::vector<int>{7, 8, 8}));
  EXPECT_TRUE(split.quads.empty());

  const MeshData quads = quads_of(square_and_triangle());
  EXPECT_EQ(quads.quads, (std::vector<uint32_t>{0, 1, 3, 2}));
  EXPECT_EQ(quads.face_indices, (std::vector<int>{8}));
  EXPECT_TRUE(quads.triangles.empty());
  EXPECT_NEAR(make_bilinear_mesh(quads, false)->area(0), 1.0f, 1e-6f);

  const MeshData triangles = triangles_of(square_and_triangle());
  EXPECT_EQ(triangles.triangles, (std::vector<uint32_t>{1, 4, 2}));
  EXPECT_EQ(triangles.face_indices, (std::vector<int>{7}));

  // A patch and the triangles of its ring face the same way.
  SurfaceInteraction a, b;
  make_bilinear_mesh(quads, false)->fill(0, {0.5f, 0.5f}, Ray(), 0, a);
  TriangleMesh(split, false).fill(1, {0.3f, 0.3f}, Ray(), 0, b);
  EXPECT_LT(length(a.ng - b.ng), 1e-6f);
}

TEST(MeshPreparation, TransformsKeepNormalsOrthogonalAndTheirRelativeLengths) {
  MeshData mesh = square_and_triangle();
  mesh.normals.resize(5, Vec3f(0, 0.6f, 0.8f));
  mesh.normals[2] *= 2.0f;
  mesh.tangents.resize(5, Vec3f(0, 0.8f, -0.6f));
  Mat44d m;
  m[0][0] = 100;
  m[1][1] = 200;
  m[2][2] = -50;
  m[3][0] = 1;
  transform_mesh(mesh, Transform(m));
  EXPECT_LT(length(mesh.positions[2] - Vec3f(101, 200, 0)), 1e-4f);
  for (size_t i = 0; i < 5; ++i)
    EXPECT_NEAR(dot(normalize(mesh.normals[i]), normalize(mesh.tangents[i])), 0.0f, 1e-6f);
  EXPECT_NEAR(length(mesh.normals[2]) / length(mesh.normals[1]), 2.0f, 1e-6f);
  MeshData other = square_and_triangle();
  other.normals.resize(5, Vec3f(0, 0.6f, 0.8f));
  m[0][0] = m[1][1] = m[2][2] = 1e-12;
  transform_mesh(other, Transform(m));
  EXPECT_NEAR(length(other.normals[0]), 1.0f, 1e-6f);
  reverse_normals(other);
  EXPECT_NEAR(other.normals[0].z, -0.8f, 1e-6f);
}

}  // namespace
}  // namespace nephroid
