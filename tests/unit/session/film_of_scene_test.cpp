// Names of outputs, films of scenes and hashes of files.
#include "session/film_of_scene.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "core/errors.h"
#include "film/splats.h"
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

TEST(FilmOfScene, MemoryIsThatOfThePartsGroupsAndSplats) {
  // Just what this machine holds for a film of one route: anything more is refused.
  const FilmLayout one = FilmLayout::of_routes({"all"});
  const double memory =
      static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGESIZE));
  FilmDescription description;
  description.crop_x0 = description.crop_y0 = 0;
  description.crop_x1 = 1024;
  description.crop_y1 =
      static_cast<int>(memory / static_cast<double>(Film::bytes_per_pixel(one, false)) / 1024);
  EXPECT_NO_THROW(check_film_fits(description, one, 0, false));
  EXPECT_THROW(check_film_fits(description, one, 1, false), SceneError);
  FilmLayout two = one;
  two.parts.push_back({0, {}});
  EXPECT_THROW(check_film_fits(description, two, 0, true), UsageError);
  description.gbuffer = GBufferSpace::kWorld;
  EXPECT_THROW(check_film_fits(description, one, 0, false), SceneError);
}

TEST(FilmOfScene, TheFilmsMemoryIsCountedInFull) {
  // 16 bytes a sum, three sums for each part and each group, features and two counters.
  FilmLayout layout = FilmLayout::of_routes({"a", "b"});
  const size_t two = Film::bytes_per_pixel(layout, false);
  EXPECT_GE(two, 4u * 48 + 120 + 8);
  layout.parts.push_back({1, {}});
  EXPECT_EQ(Film::bytes_per_pixel(layout, false), two + 48);
  layout.groups[1] = 0;
  EXPECT_EQ(Film::bytes_per_pixel(layout, false), two);
  EXPECT_GE(Film::bytes_per_pixel(layout, true), two + 13 * 16);
  EXPECT_EQ(SplatBuffer::bytes_per_pixel(3), 144u);
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
