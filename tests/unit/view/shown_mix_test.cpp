// The mix that a page shows, as what comparisons and snapshots are made of.
#include "view/shown_mix.h"

#include <gtest/gtest.h>

#include "core/errors.h"

namespace nephroid {
namespace {

const std::vector<LiveLayer> kLayers = {{"picture", LayerKind::kPicture, "RGB"},
                                        {"caustic", LayerKind::kRoute, "RGB"},
                                        {"rest", LayerKind::kRoute, "RGB"},
                                        {"key", LayerKind::kLight, "RGB"},
                                        {"albedo", LayerKind::kFeature, "RGB"}};

/// A picture of a pixel: the caustic is 0.25 in all channels, the rest is 0.5.
Picture one_pixel() {
  Picture picture;
  picture.full_width = picture.full_height = 1;
  picture.window = {0, 0, 1, 1};
  picture.channels = {"R",         "G",      "B",      "caustic.R", "caustic.G",
                      "caustic.B", "rest.R", "rest.G", "rest.B"};
  picture.pixels = {0.75f, 0.75f, 0.75f, 0.25f, 0.25f, 0.25f, 0.5f, 0.5f, 0.5f};
  return picture;
}

std::vector<float> mixed_pixel(const std::string& mix) {
  return mixed_colors(one_pixel(), parse_shown_mix(mix, kLayers)).pixels;
}

TEST(ShownMix, WithoutGainsItIsThePicture) {
  EXPECT_EQ(mixed_pixel(""), (std::vector<float>{0.75f, 0.75f, 0.75f}));
  EXPECT_EQ(mixed_pixel("{}"), (std::vector<float>{0.75f, 0.75f, 0.75f}));
}

TEST(ShownMix, GainsAndTintsMultiplyLayersAndOthersKeepOne) {
  EXPECT_EQ(mixed_pixel(R"({"caustic":2,"rest":0})"), (std::vector<float>{0.5f, 0.5f, 0.5f}));
  EXPECT_EQ(mixed_pixel(R"({"caustic":[4,2,0]})"), (std::vector<float>{1.5f, 1, 0.5f}));
}

TEST(ShownMix, RefusesLayersThatCannotBeMixed) {
  EXPECT_THROW(parse_shown_mix(R"({"albedo":1})", kLayers), UsageError);
  EXPECT_THROW(parse_shown_mix(R"({"caustic":1,"key":1})", kLayers), UsageError);
  EXPECT_THROW(mixed_pixel(R"({"key":2})"), UsageError);
}

TEST(ShownMix, OfAFilmIsThatOfItsLayers) {
  FilmSettings settings;
  settings.width = settings.height = 1;
  Film film(settings, FilmLayout::of_routes({"caustic", "rest"}));
  const Rgb colors[] = {{0.25f, 0.25f, 0.25f}, {0.5f, 0.5f, 0.5f}};
  for (int group = 0; group < 2; ++group) {
    film.add(group, 0, 0, std::span(&colors[group], 1));
    film.add_estimates(group, 1);
  }
  const Picture mixed = mixed_colors(film, parse_shown_mix(R"({"caustic":[4,2,0]})", kLayers));
  EXPECT_EQ(mixed.pixels, (std::vector<float>{1.5f, 1, 0.5f}));
  EXPECT_THROW(mixed_colors(film, parse_shown_mix(R"({"key":2})", kLayers)), UsageError);
}

}  // namespace
}  // namespace nephroid
