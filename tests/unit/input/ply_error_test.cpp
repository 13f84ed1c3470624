// Exact error messages on PLY files.
#include <gtest/gtest.h>

#include <limits>

#include "input/mesh_data.h"
#include "unit/input/parse_text.h"
#include "unit/input/ply_bytes.h"
#include "unit/input/temporary_directory.h"

namespace nephroid {
namespace {

using testing::error_of;
using testing::PlyBytes;
using testing::PlyEncoding;
using testing::TemporaryDirectory;

const std::string kVertices =
    "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
const std::string kFaces = "element face 1\nproperty list uchar int vertex_indices\n";

class PlyErrorTest : public ::testing::Test {
 protected:
  SceneFiles files;
  /// The message without the part that names the file.
  std::string error_in(const std::string& bytes) {
    const std::string path = directory_.write("m.ply", bytes);
    const std::string message = error_of([&] { read_ply(files, path, {}); });
    const std::string start = "cannot use \"" + path + "\": ";
    EXPECT_EQ(message.substr(0, start.size()), start);
    return message.size() > start.size() ? message.substr(start.size()) : message;
  }
  /// Three vertices and one face with these corners, as text and as bytes: both must give the same
  /// error.
  std::string error_of_face(const std::vector<double>& corners,
                            const std::string& list = "uchar int") {
    std::string messages[2];
    for (const PlyEncoding encoding : {PlyEncoding::kAscii, PlyEncoding::kBigEndian}) {
      PlyBytes ply(encoding);
      ply.header(kVertices + "element face 1\nproperty list " + list + " vertex_indices\n");
      for (int i = 0; i < 9; ++i) ply.add("float", i);
      const size_t space = list.find(' ');
      ply.add(list.substr(0, space), static_cast<double>(corners.size()));
      for (const double corner : corners) ply.add(list.substr(space + 1), corner);
      messages[encoding == PlyEncoding::kAscii] = error_in(ply.bytes());
    }
    EXPECT_EQ(messages[0], messages[1]);
    return messages[0];
  }
  TemporaryDirectory directory_;
};

TEST_F(PlyErrorTest, FacesHaveAtMostSoManyVertices) {
  const std::string list = "int int";
  EXPECT_EQ(error_of_face(std::vector<double>(16385, 0.0), list),
            "face 0 (counted from 0): it has 16385 vertices, expected at most 16384");
  const std::string start = "ply\nformat ascii 1.0\n" + kVertices +
                            "element face 1\nproperty list int int vertex_indices\nend_header\n"
                            "0 0 0 1 0 0 1 1 0 ";
  EXPECT_EQ(error_in(start + "-1 0 0"),
            "face 0 (counted from 0): it has -1 vertices, expected at most 16384");
  EXPECT_EQ(error_in(start + "2000000000 0 0"),
            "face 0 (counted from 0): it has 2000000000 vertices, expected at most 16384");
  EXPECT_EQ(error_of_face({0, 1, 2, 0, 3}),
            "face 0 (counted from 0): vertex index 3 is out of range, the file has 3 vertices");
}

TEST_F(PlyErrorTest, IndicesMustBeInRange) {
  EXPECT_EQ(error_of_face({0, 1, 3}),
            "face 0 (counted from 0): vertex index 3 is out of range, the file has 3 vertices");
  EXPECT_EQ(error_of_face({0, -1, 2}),
            "face 0 (counted from 0): vertex index -1 is out of range, the file has 3 vertices");
  EXPECT_EQ(error_of_face({0, 1, 4294967295.0}, "uchar uint"),
            "face 0 (counted from 0): vertex index 4294967295 is out of range, the file has 3 "
            "vertices");
  EXPECT_EQ(error_of_face({0, 1, 2}, "uchar float"),
            "the list \"vertex_indices\" is not of an integer type");
}

TEST_F(PlyErrorTest, VerticesMustBeFinite) {
  PlyBytes ply(PlyEncoding::kLittleEndian);
  ply.header(kVertices + kFaces);
  for (int i = 0; i < 9; ++i)
    ply.add("float", i == 7 ? std::numeric_limits<double>::quiet_NaN() : i);
  ply.add("uchar", 3).add("int", 0).add("int", 1).add("int", 2);
  EXPECT_EQ(error_in(ply.bytes()), "vertex 2 (counted from 0): \"y\" is not a finite float");
  const std::string header = "ply\nformat ascii 1.0\n" + kVertices + kFaces + "end_header\n";
  EXPECT_EQ(error_in(header + "0 0 0 1 nan 0 1 1 0 3 0 1 2"),
            "vertex 1 (counted from 0): \"y\" is not a finite float");
  EXPECT_EQ(error_in(header + "inf 0 0 1 0 0 1 1 0 3 0 1 2"),
            "vertex 0 (counted from 0): \"x\" is not a finite float");
}

TEST_F(PlyErrorTest, TextMustBeNumbers) {
  const std::string header = "ply\nformat ascii 1.0\n" + kVertices + kFaces + "end_header\n";
  EXPECT_EQ(error_in(header + "0 0 0 1 zero 0 1 1 0 3 0 1 2"),
            "vertex 1 (counted from 0): \"zero\" is not a number");
  EXPECT_EQ(error_in(header + "0 0 0 1 0 0 1 1 0 3 0 1.5 2"),
            "face 0 (counted from 0): \"1.5\" is not an integer");
}

TEST_F(PlyErrorTest, ShortFilesTellWhatIsMissing) {
  const std::string header =
      "ply\nformat binary_little_endian 1.0\n" + kVertices + kFaces + "end_header\n";
  EXPECT_EQ(error_in(header + std::string(20, '\0')),
            "the file is too short: 3 elements \"vertex\" need at least 36 bytes, 16 are missing");
  EXPECT_EQ(error_in(header + std::string(36, '\0') + "\x03" + std::string(7, '\0')),
            "the file is too short: it ends inside face 0 (counted from 0) of 1, at least 1 byte "
            "is missing");
  EXPECT_EQ(error_in("ply\nformat ascii 1.0\nelement junk 1\nproperty int a\n" + kVertices +
                     kFaces + "end_header\n"),
            "the file is too short: 1 element \"junk\" needs at least 2 bytes, 1 is missing");
  EXPECT_EQ(error_in("ply\nformat ascii 1.0\n" + kVertices + kFaces + "end_header\n0 0 0 1 0 0"),
            "the file is too short: 3 elements \"vertex\" need at least 18 bytes, 6 are missing");
}

// Sizes that a header merely claims cost neither memory nor time.
TEST_F(PlyErrorTest, HugeClaimsAreRefusedAtOnce) {
  const std::string coordinates = "property float x\nproperty float y\nproperty float z\n";
  for (const std::string format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    const std::string start = "ply\nformat " + format + " 1.0\n";
    EXPECT_NE(error_in(start + "element vertex 4000000000\n" + coordinates + kFaces +
                       "end_header\n0 0 0\n")
                  .find("the file is too short: 4000000000 elements \"vertex\""),
              std::string::npos);
    EXPECT_NE(error_in(start + "element vertex 0\n" + coordinates +
                       "element face 1000000000000\nproperty list uchar int vertex_indices\n"
                       "end_header\n")
                  .find("the file is too short: 1000000000000 elements \"face\""),
              std::string::npos);
    EXPECT_EQ(
        error_in(start + "element vertex 5000000000\n" + coordinates + kFaces + "end_header\n"),
        "it has more vertices than 32-bit indices can tell apart");
  }
  // A list that claims 2^32 - 1 entries.
  EXPECT_EQ(error_in("ply\nformat binary_little_endian 1.0\nelement junk 1\n"
                     "property list uint double a\n" +
                     kVertices + kFaces + "end_header\n\xFF\xFF\xFF\xFF" + std::string(60, '\0')),
            "the file is too short: it ends inside junk 0 (counted from 0) of 1, at least "
            "34359738300 bytes are missing");
  EXPECT_EQ(error_in("ply\nformat binary_little_endian 1.0\nelement junk 1\n"
                     "property list char double a\n" +
                     kVertices + kFaces + "end_header\n\xFF" + std::string(60, '\0')),
            "junk 0 (counted from 0): property \"a\" has a negative length");
}

TEST_F(PlyErrorTest, HeadersAreChecked) {
  const auto line4 = [&](const std::string& line) {
    return error_in("ply\nformat ascii 1.0\nelement vertex 3\n" + line + "\nend_header\n");
  };
  EXPECT_EQ(error_in("obj\n"), "it does not start with \"ply\", expected a PLY file");
  EXPECT_EQ(error_in(""), "it does not start with \"ply\", expected a PLY file");
  EXPECT_EQ(error_in("plyx\n"), "header line 1: found \"plyx\", expected \"ply\"");
  EXPECT_EQ(error_in("ply\nformat ascii 1.0\n"),
            "the file ends inside the header, expected end_header");
  EXPECT_EQ(error_in("ply\nend_header\n"),
            "header line 2: the header has no format line, expected one before end_header");
  EXPECT_EQ(error_in("ply\nformat binary 1.0\n"),
            "header line 2: unknown format \"binary\", expected ascii, binary_little_endian or "
            "binary_big_endian");
  EXPECT_EQ(line4("property half x"),
            "header line 4: unknown type \"half\", expected char, uchar, short, ushort, int, uint, "
            "float or double");
  EXPECT_EQ(line4("property list float int x"),
            "header line 4: the length of the list has a float type, expected an integer type");
  EXPECT_EQ(line4("property float"),
            "header line 4: the line ends too early, expected the name of a property");
  EXPECT_EQ(line4("element face many"),
            "header line 4: expected a number of elements, found \"many\"");
  EXPECT_EQ(line4("element face -1"), "header line 4: expected a number of elements, found \"-1\"");
  EXPECT_EQ(line4("element face 99999999999999"),
            "header line 4: expected a number of elements, found \"99999999999999\"");
  EXPECT_EQ(line4("element vertex 3"),
            "header line 4: element \"vertex\" is declared twice, expected once");
  EXPECT_EQ(line4("property int a\nproperty int a"),
            "header line 5: property \"a\" is declared twice, expected once");
  EXPECT_EQ(
      line4("vertices"),
      "header line 4: unknown keyword \"vertices\", expected format, element, property, comment or "
      "end_header");
  EXPECT_EQ(error_in("ply\nformat ascii 1.0\nproperty float x\n"),
            "header line 3: the property has no element, expected an element line before it");
}

TEST_F(PlyErrorTest, MeshesNeedVerticesAndFaces) {
  const std::string start = "ply\nformat ascii 1.0\n";
  EXPECT_EQ(error_in(start + kVertices + "end_header\n"), "it has no element \"face\"");
  EXPECT_EQ(error_in(start + kFaces + "end_header\n"), "it has no element \"vertex\"");
  EXPECT_EQ(error_in(start + "element vertex 1\nproperty float x\nproperty float y\n" + kFaces +
                     "end_header\n0 0 0 0 0 0"),
            "the element \"vertex\" lacks x, y or z as a single number");
  EXPECT_EQ(error_in(start + kVertices +
                     "element face 1\nproperty int a\nend_header\n"
                     "0 0 0 0 0 0 0 0 0 0 0"),
            "the element \"face\" has no list \"vertex_indices\"");
}

TEST_F(PlyErrorTest, TheSceneThatWantedTheFileIsNamed) {
  const SourceLocation wanted{std::make_shared<const std::string>("s.pbrt"), 4, 7};
  const std::string absent = directory_.path("absent.ply");
  EXPECT_EQ(error_of([&] { read_ply(files, absent, wanted); }),
            "s.pbrt:4:7: cannot read \"" + absent + "\": No such file or directory");
  const std::string bad = directory_.write("bad.ply", "x");
  EXPECT_EQ(error_of([&] { read_ply(files, bad, wanted); }),
            "s.pbrt:4:7: cannot use \"" + bad +
                "\": it does not start with \"ply\", expected a PLY file");
  EXPECT_THROW(read_ply(files, absent, {}), IoError);
  EXPECT_THROW(read_ply(files, directory_.path(), {}), IoError);
}

}  // namespace
}  // namespace nephroid
