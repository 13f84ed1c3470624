// Include and Import: search paths, scopes and errors.
#include <gtest/gtest.h>

#include <filesystem>

#include "unit/input/gzip_bytes.h"
#include "unit/input/parse_text.h"
#include "unit/input/temporary_directory.h"

namespace nephroid {
namespace {

using testing::error_of;
using testing::gzip;
using testing::TemporaryDirectory;

class IncludeTest : public ::testing::Test {
 protected:
  SceneDescription parse_file(const std::string& name) {
    return parse_pbrt_file(directory_.path(name), diagnostics_);
  }
  std::string file_error(const std::string& name) {
    return error_of([&] { parse_file(name); });
  }
  std::string at(const std::string& place) const { return directory_.path(place); }

  TemporaryDirectory directory_;
  Diagnostics diagnostics_;
};

TEST_F(IncludeTest, ReadsFilesRelativeToTheScene) {
  directory_.write("scene.pbrt",
                   "Include \"parts/top.pbrt\" WorldBegin\nInclude \"parts/a.pbrt\"\n"
                   "Shape \"sphere\"");
  directory_.write("parts/top.pbrt", "Film \"rgb\"");
  directory_.write("parts/a.pbrt", "Translate 1 2 3\nInclude \"parts/b.pbrt\" Shape \"disk\"");
  directory_.write("parts/b.pbrt", "\nShape \"cylinder\"");
  const SceneDescription scene = parse_file("scene.pbrt");
  EXPECT_EQ(scene.file, at("scene.pbrt"));
  EXPECT_EQ(scene.files->directory(), directory_.path());
  EXPECT_EQ(scene.film->where.to_string(), at("parts/top.pbrt:1:1"));
  ASSERT_EQ(scene.shapes.size(), 3u);
  EXPECT_EQ(scene.shapes[0].where.to_string(), at("parts/b.pbrt:2:1"));
  EXPECT_EQ(scene.shapes[1].where.to_string(), at("parts/a.pbrt:2:24"));
  EXPECT_EQ(scene.shapes[2].where.to_string(), at("scene.pbrt:3:1"));
  EXPECT_EQ(scene.shapes[2].transform.start[3][0], 1);  // Include has no scope of its own
}

TEST_F(IncludeTest, TextInMemoryIncludesFromItsDirectory) {
  directory_.write("a.pbrt", "Shape \"sphere\"");
  const SceneDescription scene =
      parse_pbrt_string("WorldBegin Include \"a.pbrt\"", "text", directory_.path(), diagnostics_);
  EXPECT_EQ(scene.shapes.size(), 1u);
  EXPECT_EQ(scene.files->directory(), directory_.path());
}

TEST_F(IncludeTest, AbsolutePathsAreTakenAsTheyAre) {
  const std::string path = directory_.write("a.pbrt", "Shape \"sphere\"");
  EXPECT_EQ(
      parse_pbrt_string("WorldBegin Include \"" + path + "\"", "text", "/nowhere", diagnostics_)
          .shapes.size(),
      1u);
}

TEST_F(IncludeTest, ScopesMayCrossIncludedFiles) {
  directory_.write("scene.pbrt", "WorldBegin Include \"open.pbrt\" Shape \"sphere\" AttributeEnd");
  directory_.write("open.pbrt", "AttributeBegin");
  EXPECT_EQ(parse_file("scene.pbrt").shapes.size(), 1u);
}

TEST_F(IncludeTest, ParametersMayGoOnBehindTheIncludedFile) {
  directory_.write("scene.pbrt", "WorldBegin Include \"a.pbrt\" \"float radius\" 5");
  directory_.write("a.pbrt", "Shape \"sphere\"");
  EXPECT_EQ(parse_file("scene.pbrt").shapes.at(0).parameters.get_float("radius", 0), 5);
}

TEST_F(IncludeTest, UnpacksGzip) {
  directory_.write("scene.pbrt.gz", gzip("WorldBegin\nInclude \"a.pbrt.gz\" Import \"b.pbrt.gz\""));
  directory_.write("a.pbrt.gz", gzip("Shape \"sphere\""));
  directory_.write("b.pbrt.gz", gzip("Shape \"disk\""));
  EXPECT_EQ(parse_file("scene.pbrt.gz").shapes.size(), 2u);
}

TEST_F(IncludeTest, ImportsAreScoped) {
  directory_.write("scene.pbrt",
                   "WorldBegin CoordinateSystem \"here\" Material \"conductor\" Import \"a.pbrt\" "
                   "Shape \"sphere\" CoordSysTransform \"here\" Shape \"sphere\" "
                   "NamedMaterial \"m\" Shape \"sphere\" ObjectInstance \"o\"");
  directory_.write("a.pbrt",
                   "Translate 1 2 3 ReverseOrientation CoordinateSystem \"here\" Shape \"sphere\" "
                   "Material \"diffuse\" MakeNamedMaterial \"m\" \"string type\" \"diffuse\" "
                   "ObjectBegin \"o\" Shape \"sphere\" ObjectEnd");
  const SceneDescription scene = parse_file("scene.pbrt");
  ASSERT_EQ(scene.shapes.size(), 4u);
  EXPECT_EQ(scene.shapes[0].transform.start[3][2], 3);
  EXPECT_TRUE(scene.shapes[0].reverse_orientation);
  EXPECT_EQ(scene.shapes[0].material.index, 0);
  EXPECT_EQ(scene.shapes[1].transform.start, Mat44d());
  EXPECT_FALSE(scene.shapes[1].reverse_orientation);
  EXPECT_EQ(scene.shapes[1].material.index, 0);
  EXPECT_EQ(scene.shapes[2].transform.start, Mat44d());
  EXPECT_EQ(scene.shapes[3].material.name, "m");
}

TEST_F(IncludeTest, ImportsInsideOfAnObjectBelongToIt) {
  directory_.write("scene.pbrt", "WorldBegin ObjectBegin \"o\" Import \"a.pbrt\" ObjectEnd");
  directory_.write("a.pbrt", "Shape \"sphere\" Include \"b.pbrt\"");
  directory_.write("b.pbrt", "Shape \"disk\"");
  EXPECT_EQ(parse_file("scene.pbrt").objects.at("o").shapes.size(), 2u);
}

TEST_F(IncludeTest, ImportsCloseWhatTheyOpen) {
  directory_.write("open.pbrt", "\n AttributeBegin");
  directory_.write("close.pbrt", " AttributeEnd");
  directory_.write("end.pbrt", " ObjectEnd");
  directory_.write("1.pbrt", "WorldBegin Import \"open.pbrt\" AttributeEnd");
  EXPECT_EQ(file_error("1.pbrt"), at("open.pbrt:2:2: AttributeBegin without AttributeEnd"));
  directory_.write("2.pbrt", "WorldBegin AttributeBegin Import \"close.pbrt\"");
  EXPECT_EQ(file_error("2.pbrt"), at("close.pbrt:1:2: AttributeEnd without AttributeBegin"));
  directory_.write("3.pbrt", "WorldBegin ObjectBegin \"o\" Import \"end.pbrt\"");
  EXPECT_EQ(file_error("3.pbrt"), at("end.pbrt:1:2: ObjectEnd without ObjectBegin"));
}

TEST_F(IncludeTest, MissingFilesAreErrorsWhereTheyAreNamed) {
  directory_.write("scene.pbrt", "WorldBegin\n  Include \"absent.pbrt\"");
  EXPECT_EQ(file_error("scene.pbrt"), at("scene.pbrt") + ":2:11: cannot read \"" +
                                          at("absent.pbrt") + "\": No such file or directory");
  directory_.write("scene.pbrt", "WorldBegin Import \"\"");
  EXPECT_EQ(file_error("scene.pbrt"),
            at("scene.pbrt:1:19: the file name is empty, expected a scene file"));
  directory_.write("scene.pbrt", "Include \"sub\"");
  std::filesystem::create_directory(at("sub"));
  EXPECT_EQ(file_error("scene.pbrt"),
            at("scene.pbrt") + ":1:9: cannot read \"" + at("sub") + "\": it is a directory");
  EXPECT_THROW(parse_file("scene.pbrt"), SceneError);
}

TEST_F(IncludeTest, AMissingSceneIsAnIoError) {
  EXPECT_THROW(parse_file("absent.pbrt"), IoError);
  EXPECT_EQ(file_error("absent.pbrt"),
            "cannot read \"" + at("absent.pbrt") + "\": No such file or directory");
  EXPECT_EQ(error_of([&] { parse_pbrt_file(directory_.path(), diagnostics_); }),
            "cannot read \"" + directory_.path() + "\": it is a directory");
}

TEST_F(IncludeTest, CyclesShowTheirChain) {
  directory_.write("a.pbrt", "WorldBegin\nInclude \"b.pbrt\"");
  directory_.write("b.pbrt", "\n\n Import \"./a.pbrt\"");
  EXPECT_EQ(file_error("a.pbrt"), at("b.pbrt") + ":3:9: the file includes itself: " + at("a.pbrt") +
                                      " -> " + at("b.pbrt") + " -> " + at("./a.pbrt"));
  directory_.write("self.pbrt", "Include \"self.pbrt\"");
  EXPECT_EQ(file_error("self.pbrt"), at("self.pbrt") + ":1:9: the file includes itself: " +
                                         at("self.pbrt") + " -> " + at("self.pbrt"));
}

TEST_F(IncludeTest, TheSameFileTwiceIsNoCycle) {
  directory_.write("scene.pbrt", "WorldBegin Include \"a.pbrt\" Include \"a.pbrt\"");
  directory_.write("a.pbrt", "Shape \"sphere\"");
  EXPECT_EQ(parse_file("scene.pbrt").shapes.size(), 2u);
}

TEST_F(IncludeTest, TheNumberOfFilesIsLimited) {
  // Each file includes the next one twice.
  constexpr int kLast = 40;
  for (int i = 0; i < kLast; ++i) {
    const std::string next = "Include \"" + std::to_string(i + 1) + ".pbrt\"\n";
    directory_.write(std::to_string(i) + ".pbrt", (i == 0 ? "WorldBegin\n" : "") + next + next);
  }
  directory_.write(std::to_string(kLast) + ".pbrt", "");
  EXPECT_NE(file_error("0.pbrt").find("more than 65536 files are included in all"),
            std::string::npos);
}

TEST_F(IncludeTest, DepthIsLimited) {
  const auto chain = [this](int depth) {
    directory_.write("0.pbrt", "WorldBegin Include \"1.pbrt\"");
    for (int i = 1; i < depth; ++i)
      directory_.write(std::to_string(i) + ".pbrt", std::string(i % 2 ? "Import" : "Include") +
                                                        " \"" + std::to_string(i + 1) + ".pbrt\"");
    directory_.write(std::to_string(depth) + ".pbrt", "Shape \"sphere\"");
  };
  chain(64);
  EXPECT_EQ(parse_file("0.pbrt").shapes.size(), 1u);
  chain(65);
  const std::string message = file_error("0.pbrt");
  const std::string start =
      at("64.pbrt") +
      ":1:9: files are included more than 64 deep, expected fewer levels: " + at("0.pbrt") +
      " -> " + at("1.pbrt") + " -> ";
  EXPECT_EQ(message.substr(0, start.size()), start);
  EXPECT_TRUE(message.ends_with(" -> " + at("64.pbrt") + " -> " + at("65.pbrt"))) << message;
}

}  // namespace
}  // namespace nephroid
