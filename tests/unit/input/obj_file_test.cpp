// Geometry of OBJ files: parts, indices, polygons, and messages on wrong or unusual lines.
#include "input/obj/obj_file.h"

#include <gtest/gtest.h>

#include "unit/input/parse_text.h"
#include "unit/input/temporary_directory.h"

namespace nephroid {
namespace {

using testing::error_of;
using testing::TemporaryDirectory;

constexpr const char* kObjSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

class ObjFileTest : public ::testing::Test {
 protected:
  ObjFile read(const std::string& text) {
    SceneFiles files;
    return read_obj(files, directory_.write("m.obj", text), {}, diagnostics);
  }
  /// The message without the file's name.
  std::string error_in(const std::string& text) {
    const std::string message = error_of([&] { read(text); });
    const std::string start = directory_.path("m.obj");
    return message.starts_with(start) ? message.substr(start.size()) : message;
  }
  std::string warnings_of(const std::string& text) {
    read(text);
    return warnings();
  }
  std::string warnings() const {
    std::string all;
    for (const Warning& warning : diagnostics.warnings())
      all += std::to_string(warning.where.line) + ": " + warning.message + "\n";
    return all;
  }
  TemporaryDirectory directory_;
  Diagnostics diagnostics;
};

TEST_F(ObjFileTest, CornersWithTheSameIndicesShareAVertex) {
  const ObjFile file = read(std::string(kObjSquare) +
                            "vt 0 0\nvt 1 .5\nvn 0 0 1\n"
                            "f 1/1/1 2/1/1 3/2/1\nf 1/1/1 3/2/1 4/1/1\nf 1/2/1 2/1/1 3/2/1\n");
  ASSERT_EQ(file.parts.size(), 1u);
  const MeshData& mesh = file.parts[0].mesh;
  EXPECT_EQ(mesh.positions.size(), 5u);  // vertex 1 has two texture coordinates
  EXPECT_EQ(mesh.triangles, (std::vector<uint32_t>{0, 1, 2, 0, 2, 3, 4, 1, 2}));
  EXPECT_EQ(mesh.uvs[2], Vec2f(1, 0.5f));
  EXPECT_EQ(mesh.normals[4], Vec3f(0, 0, 1));
}

TEST_F(ObjFileTest, NegativeIndicesCountBackFromTheLine) {
  const ObjFile file =
      read("v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 5 5 5\nf -4 -3 -1\n");
  const MeshData& mesh = file.parts.at(0).mesh;
  EXPECT_EQ(mesh.positions, (std::vector<Vec3f>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 5, 5}}));
  EXPECT_EQ(mesh.triangles, (std::vector<uint32_t>{0, 1, 2, 0, 1, 3}));
}

TEST_F(ObjFileTest, PolygonsKeepTheirAreaConvexOrNot) {
  // An arrowhead whose fan from the first corner would leave it.
  const ObjFile file = read("v 0 0 0\nv 4 0 0\nv 4 4 0\nv 3 1 0\nv 0 4 0\nf 1 2 3 4 5\n");
  const MeshData& mesh = file.parts.at(0).mesh;
  ASSERT_EQ(mesh.triangles.size(), 9u);
  double area = 0;
  for (size_t i = 0; i < 9; i += 3) {
    const Vec3f a = mesh.positions[mesh.triangles[i]], b = mesh.positions[mesh.triangles[i + 1]],
                c = mesh.positions[mesh.triangles[i + 2]];
    const double part = cross(b - a, c - a).z / 2;
    EXPECT_GE(part, 0);
    area += part;
  }
  EXPECT_DOUBLE_EQ(area, 10);  // shoelace formula
}

// The check of the mesh removes such faces and counts them.
TEST_F(ObjFileTest, FacesOfOneOrTwoCornersHaveNoArea) {
  const ObjFile file = read(std::string(kObjSquare) + "f 1 2\nf 3\n");
  EXPECT_EQ(file.parts.at(0).mesh.triangles, (std::vector<uint32_t>{0, 1, 1, 2, 2, 2}));
}

TEST_F(ObjFileTest, NormalsThatAreNotFiniteLeaveTheFacesTheirOwn) {
  const std::string text =
      std::string(kObjSquare) + "vn nan 0 1\nvn 0 0 1\nvn 0 inf 0\nf 1//1 2//2 3//3\n";
  EXPECT_EQ(read(text).parts.at(0).mesh.normals,
            (std::vector<Vec3f>{Vec3f(0, 0, 0), Vec3f(0, 0, 1), Vec3f(0, 0, 0)}));
  EXPECT_EQ(
      warnings(),
      "5: 2 lines \"vn with nan or inf\" are ignored, this is the first: faces have their own "
      "normal there\n");
}

TEST_F(ObjFileTest, APartIsAnObjectAGroupAndAMaterial) {
  const ObjFile file =
      read(std::string(kObjSquare) +
           "vn 0 0 1\no cup\ng rim top\nusemtl red clay\nf 1 2 3\nusemtl b\nf 1 2 4\n"
           "usemtl red clay\nf 2 3 4\nf 1//1 2//1 3//1\n");
  ASSERT_EQ(file.parts.size(), 3u);
  EXPECT_EQ(file.parts[0].object, "cup");
  EXPECT_EQ(file.parts[0].group, "rim top");
  EXPECT_EQ(file.parts[0].material, "red clay");
  EXPECT_EQ(file.parts[0].where.line, 9);
  EXPECT_EQ(file.parts[0].mesh.triangles.size(), 6u);
  EXPECT_EQ(file.parts[1].material, "b");
  EXPECT_EQ(file.parts[2].mesh.normals.size(), 3u);  // these faces have normals, the others do not
}

TEST_F(ObjFileTest, AFaceUsesOnlyWhatAllItsCornersHave) {
  const ObjFile file = read(std::string(kObjSquare) + "vt 0 0\nf 1/1 2/1 3\n");
  EXPECT_TRUE(file.parts.at(0).mesh.uvs.empty());
}

TEST_F(ObjFileTest, LinesMayContinueAndNamesMayHoldBlanks) {
  const ObjFile file = read(std::string("\xef\xbb\xbf# made by hand\r\n") + kObjSquare +
                            "mtllib my clay.mtl other.mtl\r\nf 1 \\\r\n 2 \\\n3 # a face\n");
  ASSERT_EQ(file.libraries.size(), 2u);
  EXPECT_EQ(file.libraries[0].name, "my clay.mtl");
  EXPECT_EQ(file.libraries[1].where.line, 6);
  EXPECT_EQ(file.parts.at(0).where.line, 7);
}

TEST_F(ObjFileTest, NamesMayHoldHashes) {
  const ObjFile file = read(std::string(kObjSquare) +
                            "usemtl Material #1\nf 1 2 3 #2\nusemtl red #not blue\nf 2 3 4\n");
  ASSERT_EQ(file.parts.size(), 2u);
  EXPECT_EQ(file.parts[0].material, "Material #1");
  EXPECT_EQ(file.parts[1].material, "red");
}

TEST_F(ObjFileTest, JoinedMeshHasAllParts) {
  const MeshData mesh = joined_mesh(
      read(std::string(kObjSquare) + "vt .5 .5\nvn 0 0 1\nf 1 2 3\nf 1/1/1 2/1/1 3/1/1\n"));
  EXPECT_EQ(mesh.triangles, (std::vector<uint32_t>{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(mesh.normals.at(0), Vec3f(0, 0, 0));
  EXPECT_EQ(mesh.normals.at(3), Vec3f(0, 0, 1));
  EXPECT_EQ(mesh.uvs.at(0), Vec2f(0, 0));
  EXPECT_EQ(mesh.uvs.at(5), Vec2f(0.5f, 0.5f));
}

TEST_F(ObjFileTest, WrongLinesAreErrors) {
  const std::string square = kObjSquare;
  EXPECT_EQ(error_in("v 0 0\n"), ":1: the line has 2 numbers, expected at least 3");
  EXPECT_EQ(error_in("v 0 0 x\n"), ":1: \"x\" is not a number, expected one as in 1.5 or 2e-3");
  EXPECT_EQ(error_in("vn 0 0 1 1\n"), ":1: the line has too many numbers, expected at most 3");
  EXPECT_EQ(error_in("v 0 0 0 0 0 0 0 0 0\n"),
            ":1: the line has too many numbers, expected at most 8");
  EXPECT_EQ(error_in(square + "f\n"), ":5: the face has no corners, expected at least 3");
  EXPECT_EQ(error_in(square + "f 1 2 5\n"),
            ":5: vertex index 5 is out of range, there are 4 so far, counted from 1 (or back "
            "from -1)");
  EXPECT_EQ(error_in(square + "f 0 1 2\n").substr(0, 28), ":5: vertex index 0 is out of");
  EXPECT_EQ(error_in(square + "f -5 1 2\n").substr(0, 29), ":5: vertex index -5 is out of");
  EXPECT_EQ(error_in(square + "f 1/1 2/1 3/1\n").substr(0, 29), ":5: texture index 1 is out of");
  EXPECT_EQ(error_in(square + "f 1//1 2//1 3//1\n").substr(0, 28), ":5: normal index 1 is out of");
  EXPECT_EQ(error_in(square + "f 1.5 2 3\n"),
            ":5: \"1.5\" is not an index, expected an integer as in 1/2/3");
  EXPECT_EQ(error_in(square + "f 1/1/1/1 2 3\n"),
            ":5: \"1/1/1/1\" has more than three indices, expected at most three as in 1/2/3");
  EXPECT_EQ(error_in("v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
            ":4: vertex 1 is not finite, expected finite numbers");
  EXPECT_EQ(error_in(square + "vt inf 0\nf 1/1 2/1 3/1\n"),
            ":6: texture coordinate 1 is not finite, expected finite numbers");
}

TEST_F(ObjFileTest, FacesHaveAtMostSoManyCorners) {
  std::string face = "f";
  for (int i = 0; i < 16385; ++i) face += " 1";
  EXPECT_EQ(error_in(std::string(kObjSquare) + face + "\n"),
            ":5: the face has too many corners, expected at most 16384");
}

TEST_F(ObjFileTest, IgnoredLinesAreWarnedOfOncePerKeyword) {
  EXPECT_EQ(warnings_of("v 0 0 0 1 0 0\nv 1 0 0 .5\nv 0 1 0\nl 1 2\nl 2 3\ns 1\nf 1 2 3\ns off\n"
                        "f 3 2 1\nwarp 3\n"),
            "4: 2 lines \"l\" are ignored, this is the first: it has no area\n"
            "7: \"s\" is ignored: smoothing groups make no normals, so these faces are flat; "
            "export with normals\n"
            "1: \"v with a colour\" is ignored: vertex colours have no effect on a material\n"
            "2: \"v with a weight\" is ignored: weights are for free-form curves and surfaces\n"
            "10: \"warp\" is ignored: the format has no such keyword\n");
}

TEST_F(ObjFileTest, AMissingFileIsAnErrorOfWhoeverNamesIt) {
  SceneFiles files;
  EXPECT_THROW(read_obj(files, directory_.path("no.obj"), {}, diagnostics), IoError);
  const SourceLocation named{std::make_shared<const std::string>("s.xml"), 3, 1};
  EXPECT_THROW(read_obj(files, directory_.path("no.obj"), named, diagnostics), SceneError);
}

}  // namespace
}  // namespace nephroid
