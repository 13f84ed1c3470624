// Names of outputs, films of scenes and hashes of files.
#include "session/film_of_scene.h"

#include <gtest/gtest.h>

#include <fstream>

#include "core/errors.h"
#include "session/file_hash.h"
#include "unit/film/scratch_directory.h"

namespace nephroid {
namespace {

TEST(FilmOfScene, DefaultOutputIsHereAndExr) {
  FilmDescription film;
  film.filename = "cornell-box.exr";
  EXPECT_EQ(default_output(film, "x.pbrt"), "cornell-box.exr");
  film.filename = "pictures/tea.pot.png";
  EXPECT_EQ(default_output(film, "x.pbrt"), "tea.pot.exr");
  film.filename = "bare";
  EXPECT_EQ(default_output(film, "x.pbrt"), "bare.exr");
  film.filename = "";
  EXPECT_EQ(default_output(film, "scenes/x.pbrt"), "x.exr");
  EXPECT_EQ(default_output(film, "scenes/x.pbrt.gz"), "x.exr");
}

TEST(FilmOfScene, SettingsAreTheScenes) {
  FilmDescription description;
  description.width = 20;
  description.height = 10;
  description.crop_x0 = 1;
  description.crop_y0 = 2;
  description.crop_x1 = 19;
  description.crop_y1 = 8;
  description.imaging_ratio = 2;
  description.max_component = 5;
  description.filename = "f.exr";
  const FilmSettings settings = film_settings(description);
  EXPECT_EQ(settings.width, 20);
  EXPECT_EQ(settings.height, 10);
  EXPECT_EQ(settings.crop.x0, 1);
  EXPECT_EQ(settings.crop.y0, 2);
  EXPECT_EQ(settings.crop.x1, 19);
  EXPECT_EQ(settings.crop.y1, 8);
  EXPECT_EQ(settings.imaging_ratio, 2);
  EXPECT_EQ(settings.max_component, 5);
  EXPECT_EQ(settings.filename, "f.exr");
}

TEST(FileHash, KnownAnswers) {
  const ScratchDirectory directory;
  const auto hash_of = [&](const std::string& text) {
    std::ofstream(directory.file("f"), std::ios::binary) << text;
    return hash_file(directory.file("f"));
  };
  // The published values of 64-bit FNV-1a.
  EXPECT_EQ(hash_of(""), 0xcbf29ce484222325ull);
  EXPECT_EQ(hash_of("a"), 0xaf63dc4c8601ec8cull);
  EXPECT_EQ(hash_of("foobar"), 0x85944171f73967e8ull);
  EXPECT_NE(hash_of(std::string(100000, 'x')), hash_of(std::string(100001, 'x')));
  EXPECT_THROW(hash_file(directory.file("absent")), IoError);
}

}  // namespace
}  // namespace nephroid
