// The files that a picture depends on, as recorded in its metadata.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "session/scene_loading.h"
#include "source_directory.h"
#include "unit/film/scratch_directory.h"

namespace nephroid {
namespace {

TEST(SceneHash, IsOfEveryFileThatWasRead) {
  const ScratchDirectory directory;
  const auto assets =
      std::filesystem::path(testing_support::source_directory()) / "tests/regression/features";
  std::vector<std::string> names;
  // One file for each reader, and for each directive that takes an image.
  const auto file = [&](const std::string& like, const std::string& name) {
    std::filesystem::copy_file(assets / like, directory.file(name));
    names.push_back(name);
    return "\"" + name + "\"";
  };
  const auto text = [&](const std::string& name, const std::string& content) {
    std::ofstream(directory.file(name)) << content;
    names.push_back(name);
    return "\"" + name + "\"";
  };
  const std::string scene =
      "Camera \"realistic\" \"string lensfile\" " + file("lens.dat", "lens.dat") +
      " \"string aperture\" " + file("picture.pfm", "aperture.pfm") +
      "\nFilm \"rgb\" \"integer xresolution\" 2 \"integer yresolution\" 2\n" + "Include " +
      text("options.pbrt", "Sampler \"independent\"") + "\nMakeNamedMedium \"m\" \"string type\" " +
      "\"nanovdb\" \"string filename\" " + file("puff.nvdb", "puff.nvdb") + "\nWorldBegin\n" +
      "LightSource \"infinite\" \"string filename\" " + file("picture.pfm", "sky.pfm") +
      "\nLightSource \"projection\" \"string filename\" " + file("picture.pfm", "slide.pfm") +
      "\nLightSource \"goniometric\" \"string filename\" " + file("picture.pfm", "lamp.pfm") +
      "\nLightSource \"point\" \"spectrum I\" " + text("lamp.spd", "400 1 500 2 600 3") +
      "\nTexture \"t\" \"spectrum\" \"imagemap\" \"string filename\" " +
      file("picture.pfm", "paint.pfm") + "\nMaterial \"diffuse\" \"texture reflectance\" \"t\" " +
      "\"string normalmap\" " + file("picture.pfm", "normals.pfm") +
      "\nShape \"plymesh\" \"string filename\" " + file("quad.ply", "quad.ply") +
      "\nMaterial \"measured\" \"string filename\" " + file("measured.bsdf", "measured.bsdf") +
      "\nAreaLightSource \"diffuse\" \"string filename\" " + file("picture.pfm", "screen.pfm") +
      "\nShape \"sphere\"\nImport " + text("more.pbrt", "Shape \"disk\"") + "\n";
  text("scene.pbrt", scene);

  SceneFiles expected(directory.path().string());
  expected.set_top(directory.file("scene.pbrt"));
  for (const std::string& name : names) expected.counted_path_of(name);
  const LoadedScene loaded = load_scene(directory.file("scene.pbrt"), {});
  EXPECT_EQ(loaded.description.files->hash(), expected.hash());
  // Each file changes the hash.
  for (const std::string& left_out : names) {
    SceneFiles less(directory.path().string());
    less.set_top(directory.file("scene.pbrt"));
    for (const std::string& name : names)
      if (name != left_out) less.counted_path_of(name);
    EXPECT_NE(less.hash(), expected.hash()) << left_out;
  }
}

}  // namespace
}  // namespace nephroid
