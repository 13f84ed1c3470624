// PLY files in all encodings and with all types of values.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "input/mesh_data.h"
#include "unit/input/gzip_bytes.h"
#include "unit/input/parse_text.h"
#include "unit/input/ply_bytes.h"
#include "unit/input/temporary_directory.h"

namespace nephroid {
namespace {

using testing::gzip;
using testing::PlyBytes;
using testing::PlyEncoding;
using testing::TemporaryDirectory;

using Indices = std::vector<uint32_t>;

class PlyTest : public ::testing::TestWithParam<PlyEncoding> {
 protected:
  MeshData read(const std::string& bytes, const std::string& name = "m.ply") {
    SceneFiles files;
    return read_ply(files, directory_.write(name, bytes), {});
  }
  TemporaryDirectory directory_;
};

INSTANTIATE_TEST_SUITE_P(AllEncodings, PlyTest,
                         ::testing::Values(PlyEncoding::kAscii, PlyEncoding::kLittleEndian,
                                           PlyEncoding::kBigEndian));

/// Four vertices of a unit square, with a triangle and a quad.
std::string square(PlyEncoding encoding) {
  PlyBytes ply(encoding);
  ply.header(
      "comment made by hand\nelement vertex 4\nproperty float x\nproperty float y\n"
      "property float z\nelement face 2\nproperty list uchar int vertex_indices\n");
  for (const auto& [x, y] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}})
    ply.add("float", x).add("float", y).add("float", 0.5);
  ply.add("uchar", 3).add("int", 0).add("int", 1).add("int", 2);
  ply.add("uchar", 4).add("int", 0).add("int", 1).add("int", 2).add("int", 3);
  return ply.bytes();
}

void expect_square(const MeshData& mesh) {
  EXPECT_EQ(mesh.positions,
            std::vector<Vec3f>({{0, 0, 0.5f}, {1, 0, 0.5f}, {1, 1, 0.5f}, {0, 1, 0.5f}}));
  EXPECT_EQ(mesh.triangles, Indices({0, 1, 2}));
  EXPECT_EQ(mesh.quads, Indices({0, 1, 2, 3}));
  EXPECT_TRUE(mesh.normals.empty() && mesh.uvs.empty() && mesh.face_indices.empty());
}

TEST_P(PlyTest, ReadsTrianglesAndQuads) {
  expect_square(read(square(GetParam())));
}

/// Six vertices with normals and texture coordinates; `faces` are lists of corners with a tag.
std::string hexagon(PlyEncoding encoding,
                    const std::vector<std::pair<std::vector<int>, int>>& faces) {
  PlyBytes ply(encoding);
  ply.header(
      "element vertex 6\nproperty float x\nproperty float y\nproperty float z\n"
      "property float nx\nproperty float ny\nproperty float nz\nproperty float u\n"
      "property float v\nelement face " +
      std::to_string(faces.size()) +
      "\nproperty list uchar int vertex_indices\nproperty int face_indices\n");
  // An L: its corner 3 is concave.
  for (const auto& [x, y] : {std::pair(0, 0), {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}) {
    ply.add("float", x).add("float", y).add("float", 0);
    ply.add("float", 0).add("float", 0).add("float", 1);
    ply.add("float", x).add("float", y);
  }
  for (const auto& face : faces) {
    ply.add("uchar", static_cast<double>(face.first.size()));
    for (const int corner : face.first) ply.add("int", corner);
    ply.add("int", face.second);
  }
  return ply.bytes();
}

TEST_P(PlyTest, CutsLargeFacesIntoTriangles) {
  const MeshData mesh = read(
      hexagon(GetParam(),
              {{{0, 1, 2, 3, 4, 5}, 7}, {{0, 1, 2}, 8}, {{0, 1, 2, 3}, 9}, {{5, 4, 3, 3}, 10}}));
  // The file's triangles come first. Quads stay quads, also those with three distinct corners.
  ASSERT_EQ(mesh.triangles.size(), 3u * 5);
  EXPECT_EQ(Indices(mesh.triangles.begin(), mesh.triangles.begin() + 3), Indices({0, 1, 2}));
  EXPECT_EQ(mesh.quads, Indices({0, 1, 2, 3, 5, 4, 3, 3}));
  EXPECT_EQ(mesh.face_indices, std::vector<int>({8, 7, 7, 7, 7, 9, 10}));
  EXPECT_EQ(mesh.positions.size(), 6u);
  EXPECT_EQ(mesh.normals.size(), 6u);
  EXPECT_EQ(mesh.uvs[3], Vec2f(1, 1));
  double area = 0;
  for (size_t i = 3; i < mesh.triangles.size(); i += 3) {
    const Vec3f& a = mesh.positions[mesh.triangles[i]];
    const Vec3f n =
        cross(mesh.positions[mesh.triangles[i + 1]] - a, mesh.positions[mesh.triangles[i + 2]] - a);
    EXPECT_GT(n.z, 0.0f);
    area += n.z / 2;
  }
  EXPECT_NEAR(area, 3.0, 1e-6);
}

TEST_P(PlyTest, FacesWithFewerThanThreeDistinctVerticesHaveNoArea) {
  const MeshData mesh = read(hexagon(GetParam(), {{{0, 1, 2}, 1},
                                                  {{}, 2},
                                                  {{4}, 3},
                                                  {{3, 4}, 4},
                                                  {{3, 4, 3, 4, 3}, 5},
                                                  {{0, 0, 1, 1, 2, 0}, 6}}));
  EXPECT_EQ(mesh.triangles, Indices({0, 1, 2, 0, 0, 0, 4, 4, 4, 3, 3, 3, 3, 3, 3, 0, 1, 2}));
  EXPECT_EQ(mesh.face_indices, std::vector<int>({1, 2, 3, 4, 5, 6}));
}

TEST_P(PlyTest, ValuesOfVerticesThatNoFaceUsesDoNotMatter) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  PlyBytes ply(GetParam());
  ply.header(
      "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
      "property float nx\nproperty float ny\nproperty float nz\nproperty float u\n"
      "property float v\nelement face 1\nproperty list uchar int vertex_indices\n");
  for (int i = 0; i < 3; ++i)
    for (const double value :
         {i == 0 ? 1.0 : 0.0, i == 1 ? 1.0 : 0.0, 0.0, nan, 0.0, 0.0, 0.5, 0.5})
      ply.add("float", value);
  for (int i = 0; i < 8; ++i) ply.add("float", i == 1 ? HUGE_VAL : nan);
  ply.add("uchar", 3).add("int", 0).add("int", 1).add("int", 2);
  const MeshData mesh = read(ply.bytes());
  EXPECT_EQ(mesh.positions.at(3), Vec3f(0, 0, 0));
  EXPECT_EQ(mesh.uvs.at(3), Vec2f(0, 0));
  EXPECT_EQ(mesh.uvs.at(2), Vec2f(0.5f, 0.5f));
  // Normals are checked with the mesh, not here.
  EXPECT_TRUE(std::isnan(mesh.normals.at(0).x));
}

TEST_P(PlyTest, UnpacksGzip) {
  expect_square(read(gzip(square(GetParam())), "m.ply.gz"));
}

TEST_P(PlyTest, TakesCarriageReturnsInTheHeader) {
  std::string bytes = square(GetParam());
  const size_t body = bytes.find("end_header\n") + 11;
  std::string header;
  for (const char c : bytes.substr(0, body)) header += c == '\n' ? "\r\n" : std::string(1, c);
  expect_square(read(header + bytes.substr(body)));
}

TEST_P(PlyTest, ReadsEveryScalarType) {
  struct Case {
    const char* type;
    std::array<double, 3> values;
  };
  const Case cases[] = {{"char", {-128, 0, 127}},
                        {"int8", {-128, 1, 127}},
                        {"uchar", {0, 128, 255}},
                        {"uint8", {0, 128, 255}},
                        {"short", {-32768, 1, 32767}},
                        {"int16", {-32768, 1, 32767}},
                        {"ushort", {0, 1, 65535}},
                        {"uint16", {0, 1, 65535}},
                        {"int", {-2147483648.0, 1, 16777216}},
                        {"int32", {-5, 1, 16777216}},
                        {"uint", {0, 1, 4294967040.0}},
                        {"uint32", {0, 1, 4294967040.0}},
                        {"float", {-0.1f, 1e-30f, 3e38f}},
                        {"float32", {-0.5, 0, 3}},
                        {"double", {0.1, 1e-30, 3e38}},
                        {"float64", {-0.5, 0, 3}}};
  for (const Case& c : cases) {
    const std::string type = c.type;
    PlyBytes ply(GetParam());
    ply.header("element vertex 1\nproperty " + type + " x\nproperty " + type + " y\nproperty " +
               type + " z\nelement face 0\nproperty list uint8 int32 vertex_indices\n");
    for (const double value : c.values) ply.add(type, value);
    const MeshData mesh = read(ply.bytes());
    ASSERT_EQ(mesh.positions.size(), 1u) << type;
    for (int i = 0; i < 3; ++i)
      EXPECT_EQ(mesh.positions[0][i], static_cast<float>(c.values[static_cast<size_t>(i)])) << type;
  }
}

TEST_P(PlyTest, ReadsEveryListType) {
  for (const std::string count : {"char", "uchar", "int16", "uint16", "int", "uint"}) {
    for (const std::string index : {"int8", "uint8", "short", "ushort", "int32", "uint32"}) {
      PlyBytes ply(GetParam());
      ply.header(
          "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
          "element face 1\nproperty list " +
          count + " " + index + " vertex_index\n");
      for (int i = 0; i < 9; ++i) ply.add("float", i);
      ply.add(count, 3).add(index, 2).add(index, 0).add(index, 1);
      EXPECT_EQ(read(ply.bytes()).triangles, Indices({2, 0, 1})) << count << " " << index;
    }
  }
}

TEST_P(PlyTest, ReadsNormalsTexturesAndPassesOverTheRest) {
  const std::pair<const char*, const char*> uv_names[] = {
      {"u", "v"}, {"s", "t"}, {"texture_u", "texture_v"}, {"texture_s", "texture_t"}};
  for (const auto& [u, v] : uv_names) {
    PlyBytes ply(GetParam());
    ply.header(
        std::string("obj_info nothing\nelement camera 2\nproperty list uchar double junk\n"
                    "property short id\nelement vertex 3\nproperty double z\nproperty uchar red\n"
                    "property float nx\nproperty float ny\nproperty float nz\n"
                    "property list ushort short weights\nproperty float x\nproperty float y\n"
                    "property float ") +
        u + "\nproperty float " + v +
        "\nelement empty 5\nelement face 1\nproperty float quality\n"
        "property list uchar float extra\nproperty list uchar uint vertex_indices\n"
        "element tail 1\nproperty int x\n");
    for (int i = 0; i < 2; ++i) {
      ply.add("uchar", i);
      for (int j = 0; j < i; ++j) ply.add("double", 7);
      ply.add("short", -1);
    }
    for (int i = 0; i < 3; ++i) {
      ply.add("double", i + 0.25).add("uchar", 200);
      ply.add("float", 0).add("float", i).add("float", 1);
      ply.add("ushort", 2).add("short", 1).add("short", 2);
      ply.add("float", 10 + i).add("float", 20 + i).add("float", 0.5 * i).add("float", 1);
    }
    ply.add("float", 9).add("uchar", 1).add("float", 9);
    ply.add("uchar", 3).add("uint", 0).add("uint", 1).add("uint", 2).add("int", 5);
    const MeshData mesh = read(ply.bytes());
    EXPECT_EQ(mesh.positions,
              std::vector<Vec3f>({{10, 20, 0.25f}, {11, 21, 1.25f}, {12, 22, 2.25f}}));
    EXPECT_EQ(mesh.normals, std::vector<Vec3f>({{0, 0, 1}, {0, 1, 1}, {0, 2, 1}}));
    EXPECT_EQ(mesh.uvs, std::vector<Vec2f>({{0, 1}, {0.5f, 1}, {1, 1}}));
    EXPECT_EQ(mesh.triangles, Indices({0, 1, 2}));
  }
}

TEST_P(PlyTest, FaceIndicesComeInTheOrderTrianglesThenQuads) {
  PlyBytes ply(GetParam());
  ply.header(
      "element vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 4\n"
      "property list uchar int vertex_indices\nproperty int face_indices\n");
  for (int i = 0; i < 12; ++i) ply.add("float", i);
  for (int face = 0; face < 4; ++face) {
    const int corners = face % 2 == 0 ? 4 : 3;
    ply.add("uchar", corners);
    for (int i = 0; i < corners; ++i) ply.add("int", i);
    ply.add("int", 100 + face);
  }
  const MeshData mesh = read(ply.bytes());
  EXPECT_EQ(mesh.triangles.size(), 6u);
  EXPECT_EQ(mesh.quads.size(), 8u);
  EXPECT_EQ(mesh.face_indices, std::vector<int>({101, 103, 100, 102}));
}

TEST_P(PlyTest, FacesMayComeBeforeVertices) {
  PlyBytes ply(GetParam());
  ply.header(
      "element face 1\nproperty list uchar int vertex_indices\nelement vertex 3\n"
      "property float x\nproperty float y\nproperty float z\n");
  ply.add("uchar", 3).add("int", 2).add("int", 1).add("int", 0);
  for (int i = 0; i < 9; ++i) ply.add("float", i);
  const MeshData mesh = read(ply.bytes());
  EXPECT_EQ(mesh.triangles, Indices({2, 1, 0}));
  EXPECT_EQ(mesh.positions.size(), 3u);
}

// A file that is cut off at any byte gives an error that says so.
TEST_P(PlyTest, EveryTruncationIsAnError) {
  const std::string whole = square(GetParam());
  const size_t body = whole.find("end_header\n") + 11;
  // A text ends with a blank that may be missing.
  const size_t end = whole.size() - (GetParam() == PlyEncoding::kAscii ? 1 : 0);
  for (size_t size = body; size < end; ++size) {
    try {
      read(whole.substr(0, size));
      ADD_FAILURE() << "no error at " << size << " of " << whole.size();
    } catch (const SceneError& error) {
      EXPECT_NE(std::string(error.what()).find("the file is too short"), std::string::npos)
          << error.what();
      EXPECT_NE(std::string(error.what()).find("missing"), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace nephroid
