// A film has the settings of its scene.
#include "film/film_settings.h"

#include <gtest/gtest.h>

namespace nephroid {
namespace {

TEST(FilmSettings, AreThoseOfTheDescription) {
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
  description.diagonal_mm = 24;
  description.gbuffer = GBufferSpace::kWorld;
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
  EXPECT_EQ(settings.diagonal_mm, 24);
  EXPECT_TRUE(settings.gbuffer);
}

}  // namespace
}  // namespace nephroid
