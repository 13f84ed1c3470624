#include "input/scene_files.h"

#include <gtest/gtest.h>

#include "core/errors.h"
#include "unit/input/gzip_bytes.h"
#include "unit/input/temporary_directory.h"

namespace nephroid {
namespace {

using testing::TemporaryDirectory;

TEST(SceneFiles, NamesAreRelativeToTheDirectory) {
  EXPECT_EQ(SceneFiles("a/b").path_of("c/d.ply"), "a/b/c/d.ply");
  EXPECT_EQ(SceneFiles("a/b").path_of("/c/d.ply"), "/c/d.ply");
  EXPECT_EQ(SceneFiles(".").path_of("c/d.ply"), "c/d.ply");
  EXPECT_EQ(SceneFiles("").directory(), ".");
}

TEST(SceneFiles, NamesInPipesCountFromTheCurrentDirectory) {
  EXPECT_EQ(directory_of_scene("a/b.pbrt"), "a");
  EXPECT_EQ(directory_of_scene("-"), ".");
  EXPECT_EQ(directory_of_scene("/dev/stdin"), ".") << "a file, if one is redirected";
  EXPECT_EQ(directory_of_scene("/dev/fd/3"), ".");
}

/// Hash of a scene of two files in a directory, read in either order.
uint64_t hash_of_scene(const TemporaryDirectory& directory, const std::string& top,
                       const std::string& mesh, bool mesh_first = false) {
  SceneFiles files(directory.path());
  files.set_top(directory.write("scene.pbrt", top));
  const std::string path = directory.write("m.ply", mesh);
  if (mesh_first) files.read(path);
  EXPECT_EQ(files.read(files.path_of("scene.pbrt")), top);
  if (!mesh_first) {
    EXPECT_EQ(files.counted_path_of("m.ply"), path);
  }
  return files.hash();
}

TEST(SceneFiles, TheHashIsOfWhatWasReadWhereverItLies) {
  const TemporaryDirectory here, there;
  const uint64_t hash = hash_of_scene(here, "top", "mesh");
  EXPECT_EQ(hash_of_scene(there, "top", "mesh"), hash);
  EXPECT_EQ(hash_of_scene(here, "top", "mesh", true), hash);
  EXPECT_NE(hash_of_scene(here, "Top", "mesh"), hash);
  EXPECT_NE(hash_of_scene(here, "top", "Mesh"), hash);
  EXPECT_NE(hash_of_scene(here, "mesh", "top"), hash);
  SceneFiles less(here.path());
  less.set_top(here.path("scene.pbrt"));
  EXPECT_NE(less.hash(), hash);
}

TEST(SceneFiles, NamesCountButThatOfTheScene) {
  const TemporaryDirectory directory;
  const auto hash = [&](const std::string& name, bool top) {
    SceneFiles files(directory.path());
    const std::string path = directory.write(name, "content");
    if (top) files.set_top(path);
    files.read(path);
    return files.hash();
  };
  EXPECT_EQ(hash("a", true), hash("b", true));
  EXPECT_NE(hash("a", false), hash("b", false));
}

TEST(SceneFiles, WhatCannotBeReadIsSaidByWhoReadsIt) {
  const TemporaryDirectory directory;
  SceneFiles files(directory.path());
  const uint64_t none = files.hash();
  EXPECT_EQ(files.counted_path_of("absent"), directory.path("absent"));
  EXPECT_EQ(files.hash(), none);
  EXPECT_THROW(files.read(directory.path("absent")), IoError);
  EXPECT_THROW(hash_file(directory.path("absent")), IoError);
}

TEST(SceneFiles, PackedFilesAreReadAsWhatIsInThem) {
  const TemporaryDirectory directory;
  SceneFiles files(directory.path());
  EXPECT_EQ(files.read(directory.write("a.gz", testing::gzip("content"))), "content");
}

}  // namespace
}  // namespace nephroid
