// Meshes from files: displacement with its texture and errors, and instances that share their
// geometry.
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>

#include "input/pbrt_parser.h"
#include "scene/scene.h"
#include "unit/film/scratch_directory.h"

namespace nephroid {
namespace {

class MeshLoading : public ::testing::Test {
 protected:
  /// A square from (0,0,0) to (1,1,0) as two triangles.
  void write_square(const std::string& name, bool with_uv) const {
    std::ofstream out(scratch.file(name));
    out << "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
           "property float z\n"
        << (with_uv ? "property float u\nproperty float v\n" : "")
        << "element face 2\nproperty list uchar int vertex_indices\nend_header\n";
    for (const char* p : {"0 0", "1 0", "1 1", "0 1"})
      out << p << " 0 " << (with_uv ? p : "") << "\n";
    out << "3 0 1 2\n3 0 2 3\n";
  }
  std::unique_ptr<Scene> load(const std::string& text) {
    const SceneDescription description =
        parse_pbrt_string(text, "t.pbrt", scratch.path().string(), diagnostics);
    return build_scene(description, {}, diagnostics);
  }
  std::string error_of(const std::string& text) {
    try {
      load(text);
    } catch (const SceneError& e) {
      return e.what();
    }
    return "no error";
  }
  std::string warnings() const {
    std::string all;
    for (const Warning& w : diagnostics.warnings()) all += w.message + "\n";
    return all;
  }
  ScratchDirectory scratch;
  Diagnostics diagnostics;
};

TEST_F(MeshLoading, DisplacementFollowsItsTexture) {
  write_square("a.ply", true);
  // Heights from 0 to 2 along u, in object space. In world space the mesh is twice as large.
  const std::string world =
      "WorldBegin LightSource \"infinite\"\n"
      "Texture \"h\" \"float\" \"bilerp\" \"float v01\" 0 \"float v10\" 2 \"float v11\" 2\n"
      "Scale 2 2 2 Shape \"plymesh\" \"string filename\" \"a.ply\" \"texture displacement\" \"h\" ";
  for (const std::string& text :
       {world + "\"float edgelength\" .25", world + "\"float displacement.edgelength\" .25",
        "Option \"float displacementedgescale\" .5\n" + world + "\"float edgelength\" .5"}) {
    const auto scene = load(text);
    const auto& mesh = dynamic_cast<const TriangleMesh&>(*scene->top.records.at(0).shape).data();
    // The square has an area of 4 and edges of 1/4: more triangles than 2 * 4 * 16.
    EXPECT_GT(mesh.triangles.size() / 3, 128u);
    EXPECT_LT(mesh.triangles.size() / 3, 1024u);
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
      EXPECT_NEAR(mesh.positions[i].x, 2 * mesh.uvs[i].x, 1e-6f);
      EXPECT_NEAR(mesh.positions[i].z, 4 * mesh.uvs[i].x, 1e-5f);
      // The slope's normal, of any length.
      const Vec3f n = normalize(mesh.normals[i]);
      EXPECT_NEAR(n.x, -2 / std::sqrt(5.0f), 1e-5f);
      EXPECT_NEAR(n.z, 1 / std::sqrt(5.0f), 1e-5f);
    }
  }
  EXPECT_EQ(warnings().find("displacement"), std::string::npos) << warnings();
}

TEST_F(MeshLoading, DisplacementSaysWhatIsMissing) {
  write_square("a.ply", true);
  write_square("b.ply", false);
  const auto shape = [](const std::string& file, const std::string& rest) {
    return "WorldBegin\nShape \"plymesh\" \"string filename\" \"" + file +
           "\" \"float displacement\" .5 " + rest;
  };
  EXPECT_EQ(error_of(shape("a.ply", "")), "no error");
  EXPECT_NE(error_of(shape("b.ply", "")).find("t.pbrt:2:1"), std::string::npos);
  EXPECT_NE(error_of(shape("b.ply", "")).find("needs texture coordinates"), std::string::npos);
  EXPECT_NE(error_of(shape("a.ply", "\"float edgelength\" 0")).find("positive number"),
            std::string::npos);
  EXPECT_NE(error_of(shape("a.ply", "\"float edgelength\" 1 \"texture displacement\" \"x\"")),
            "no error");
}

TEST_F(MeshLoading, FaultsOfFilesAreCountedOnce) {
  std::ofstream(scratch.file("a.ply"))
      << "ply\nformat ascii 1.0\nelement vertex 7\nproperty float x\nproperty float y\n"
         "property float z\nproperty float nx\nproperty float ny\nproperty float nz\n"
         "element face 4\nproperty list uchar int vertex_indices\nend_header\n"
         "0 0 0 nan nan nan\n2 0 0 nan nan nan\n2 1 0 nan nan nan\n1 1 0 nan nan nan\n"
         "1 2 0 nan nan nan\n0 2 0 nan nan nan\nnan nan inf nan nan nan\n"
         "6 0 1 2 3 4 5\n5 0 1 0 1 0\n2 0 1\n0\n";
  const auto scene = load(
      "Camera \"perspective\" WorldBegin LightSource \"infinite\"\n"
      "Shape \"plymesh\" \"string filename\" \"a.ply\"");
  EXPECT_EQ(
      warnings(),
      "shape \"plymesh\": 6 of 7 normals are not finite, the normals of the faces are used there\n"
      "shape \"plymesh\": 3 of 7 faces have no area and were removed\n");
  // The L is hit where it is, with its own normal.
  for (const Vec2f& at : {Vec2f(0.5f, 0.5f), Vec2f(1.9f, 0.9f), Vec2f(0.1f, 1.9f),
                          Vec2f(1.1f, 1.1f), Vec2f(1.9f, 1.9f)}) {
    Ray ray;
    ray.o = Vec3f(at.x, at.y, 5);
    ray.d = Vec3f(0, 0, -1);
    SurfaceInteraction hit;
    const bool inside = at.x < 1 || at.y < 1;
    ASSERT_EQ(scene->intersect(ray, hit), inside) << at;
    if (!inside) continue;
    EXPECT_EQ(hit.ng, Vec3f(0, 0, 1));
    EXPECT_EQ(hit.shading.z, Vec3f(0, 0, 1));
  }
}

TEST_F(MeshLoading, AThousandInstancesShareTheirMesh) {
  write_square("a.ply", true);
  std::string text =
      "WorldBegin LightSource \"infinite\"\nObjectBegin \"o\" Shape \"plymesh\" \"string "
      "filename\" \"a.ply\" ObjectEnd\n";
  for (int i = 0; i < 1000; ++i) text += "Translate 2 0 0 ObjectInstance \"o\"\n";
  const auto scene = load(text);
  EXPECT_EQ(scene->groups.size(), 1u);
  EXPECT_EQ(scene->shape_count, 1u);
  EXPECT_EQ(scene->primitive_count, 2u);
  ASSERT_EQ(scene->top.instances.size(), 1000u);
  for (const InstanceRecord& instance : scene->top.instances)
    EXPECT_EQ(instance.group, scene->groups[0].get());
  // The last instance is at its place.
  Ray ray;
  ray.o = Vec3f(2000.5f, 0.25f, 5);
  ray.d = Vec3f(0, 0, -1);
  SurfaceInteraction hit;
  ASSERT_TRUE(scene->intersect(ray, hit));
  EXPECT_NEAR(hit.uv.x, 0.5f, 1e-3f);
}

}  // namespace
}  // namespace nephroid
