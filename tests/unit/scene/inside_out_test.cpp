// Warnings of glass that is inside out, and none for intended bubbles.
#include "scene/inside_out.h"

#include <gtest/gtest.h>

#include "input/pbrt_parser.h"

namespace nephroid {
namespace {

/// The warning that a scene is inside out, or empty.
std::string warning_of(const std::string& world) {
  Diagnostics diagnostics;
  const SceneDescription d = parse_pbrt_string(
      "LookAt 0 -9 0  0 0 0  0 0 1 Camera \"perspective\" WorldBegin\n"
      "LightSource \"infinite\"\n"
      "MakeNamedMaterial \"glass\" \"string type\" \"dielectric\"\n"
      "NamedMaterial \"glass\"\n" +
          world,
      "t.pbrt", ".", diagnostics);
  build_scene(d, {}, diagnostics);
  std::string all;
  for (const Warning& w : diagnostics.warnings())
    if (w.message.find("inside out") != std::string::npos) all += located(w.where, w.message);
  return all;
}

const std::string kSphere = "Shape \"sphere\"\n";
const std::string kReversed = "ReverseOrientation\n" + kSphere;

TEST(InsideOut, SphereIsNamedWithItsPlaceAndCause) {
  EXPECT_EQ(warning_of(kSphere), "");
  const std::string reversed = warning_of(kReversed);
  EXPECT_EQ(reversed.find("t.pbrt:6:1: this \"sphere\" of dielectric is inside out because of "
                          "ReverseOrientation"),
            0u)
      << reversed;
  const std::string two = warning_of(kReversed + "Translate 9 0 0 " + kSphere);
  EXPECT_NE(two.find("; also inside out: 1 more shape"), std::string::npos) << two;
  // A mirrored ball keeps its outside.
  EXPECT_EQ(warning_of("Scale -1 1 1\n" + kSphere), "");
  EXPECT_NE(warning_of("Scale -1 1 1\n" + kReversed), "");
}

TEST(InsideOut, OnlyOfClosedGlass) {
  EXPECT_EQ(warning_of("ReverseOrientation Shape \"sphere\" \"float zmax\" 0.5"), "");
  EXPECT_EQ(warning_of("ReverseOrientation Shape \"disk\""), "");
  EXPECT_EQ(warning_of("Material \"diffuse\" " + kReversed), "");
  EXPECT_EQ(warning_of("Material \"thindielectric\" " + kReversed), "");
  EXPECT_EQ(warning_of("Material \"dielectric\" \"float eta\" 0.7 " + kReversed), "");
  EXPECT_EQ(warning_of("Material \"dielectric\" \"float eta\" 1 " + kReversed), "");
  EXPECT_NE(warning_of("Material \"dielectric\" \"spectrum eta\" \"glass-BK7\" " + kReversed), "");
}

TEST(InsideOut, BubblesAreWanted) {
  // Inside a ball of glass, and that ball itself if it is reversed.
  const std::string ball = "Shape \"sphere\" \"float radius\" 3\n";
  EXPECT_EQ(warning_of(ball + kReversed), "");
  EXPECT_NE(warning_of("ReverseOrientation " + ball + kSphere), "");
  // Beside the ball.
  EXPECT_NE(warning_of(kReversed + "ReverseOrientation Translate 9 0 0 " + ball), "");
  // Below a water surface, in a medium, around the camera, and in an object that may be inside
  // glass.
  EXPECT_EQ(
      warning_of("Shape \"bilinearmesh\" \"point3 P\" [-9 -9 2 9 -9 2 -9 9 2 9 9 2]\n" + kReversed),
      "");
  EXPECT_EQ(warning_of("MakeNamedMedium \"water\" \"string type\" \"homogeneous\"\n"
                       "MediumInterface \"\" \"water\"\n" +
                       kReversed),
            "");
  EXPECT_EQ(warning_of("ReverseOrientation Shape \"sphere\" \"float radius\" 20"), "");
  const std::string object = "ObjectBegin \"o\"\n" + kReversed + "ObjectEnd\n";
  EXPECT_EQ(warning_of(object + "ObjectInstance \"o\" Translate 9 0 0 " + kSphere), "");
  EXPECT_NE(warning_of(object + "ObjectInstance \"o\""), "");
}

/// A box of triangles, counter-clockwise from outside if `is_right`, else clockwise.
std::string box(bool is_right, const std::string& more = "") {
  std::string text =
      "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0 1 1 0 0 0 1 1 0 1 "
      "0 1 1 1 1 1] \"integer indices\" [";
  const int faces[12][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                            {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  for (const auto& f : faces)
    text += std::to_string(f[0]) + " " + std::to_string(f[is_right ? 1 : 2]) + " " +
            std::to_string(f[is_right ? 2 : 1]) + " ";
  return text + "] " + more + "\n";
}

TEST(InsideOut, MeshesByTheirVolume) {
  EXPECT_EQ(warning_of(box(true)), "");
  EXPECT_NE(warning_of(box(false)).find("by its normals or the order of its vertices"),
            std::string::npos);
  EXPECT_EQ(warning_of("ReverseOrientation " + box(false)), "");
  EXPECT_NE(warning_of("ReverseOrientation " + box(true)), "");
  EXPECT_NE(warning_of("Translate 1000 0 0 " + box(false)), "");
  // Vertex normals take precedence over vertex order.
  const std::string out =
      "\"normal N\" [-1 -1 -1 1 -1 -1 -1 1 -1 1 1 -1 -1 -1 1 1 -1 1 -1 1 1 1 1 1]";
  const std::string in =
      "\"normal N\" [1 1 1 -1 1 1 1 -1 1 -1 -1 1 1 1 -1 -1 1 -1 1 -1 -1 -1 -1 -1]";
  EXPECT_EQ(warning_of(box(false, out)), "");
  EXPECT_NE(warning_of(box(true, in)), "");
}

TEST(InsideOut, OpenMeshesAreNotJudged) {
  // With a face missing, and with one flipped.
  const std::string start = "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0 0 0 1] ";
  EXPECT_NE(warning_of(start + "\"integer indices\" [0 1 2 0 3 1 0 2 3 1 3 2]"), "");
  EXPECT_EQ(warning_of(start + "\"integer indices\" [0 1 2 0 3 1 0 2 3]"), "");
  EXPECT_EQ(warning_of(start + "\"integer indices\" [0 1 2 0 3 1 0 2 3 1 2 3]"), "");
  // Vertices at the same position count as one.
  EXPECT_NE(warning_of("Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0 0 0 1 1 0 0] "
                       "\"integer indices\" [0 1 2 0 3 1 0 2 3 4 3 2]"),
            "");
}

TEST(InsideOut, MeshesOfQuads) {
  const std::string start =
      "Shape \"bilinearmesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0 1 1 0 0 0 1 1 0 1 0 1 1 1 1 1] "
      "\"integer indices\" [";
  const std::string outside = "0 2 1 3  4 5 6 7  0 1 4 5  2 6 3 7  0 4 2 6  1 3 5 7]";
  const std::string inside = "0 1 2 3  4 6 5 7  0 4 1 5  2 3 6 7  0 2 4 6  1 5 3 7]";
  EXPECT_EQ(warning_of(start + outside), "");
  EXPECT_NE(warning_of(start + inside), "");
  EXPECT_EQ(warning_of("ReverseOrientation " + start + inside), "");
}

}  // namespace
}  // namespace nephroid
