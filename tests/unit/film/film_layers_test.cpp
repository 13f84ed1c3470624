// Layers by name hold what the picture file holds.
#include "film/film_layers.h"

#include <gtest/gtest.h>

#include "film/film_output.h"
#include "unit/film/one_part.h"

namespace nephroid {
namespace {

using testing_support::add_one;

Film small_film() {
  FilmSettings settings;
  settings.width = 3;
  settings.height = 2;
  Film film(settings, FilmLayout::of_routes({"caustic", "diffuse"}));
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 3; ++x) {
      const auto value = static_cast<float>(1 + x + 10 * y);
      for (int group = 0; group < film.layout().group_count(); ++group)
        add_one(film, group, x, y, {value, 2 * value, 3 * value});
      film.add_features(x, y, {0.1f, 0.2f, value / 64}, {0, 0, 1}, value);
    }
  for (int group = 0; group < film.layout().group_count(); ++group) film.add_estimates(group, 1);
  film.add_feature_estimates(1);
  return film;
}

TEST(FilmLayers, AreThoseOfThePicture) {
  const Film film = small_film();
  const Picture picture = film_picture(film, {});
  for (const FilmLayer& layer : film_layers(film)) {
    const std::vector<float> pixels = layer_pixels(film, layer);
    const size_t channels = layer.channels.size();
    ASSERT_EQ(pixels.size(), 6 * channels) << layer.name;
    for (size_t c = 0; c < channels; ++c) {
      const std::string letter(1, layer.channels[c]);
      const std::string name = layer.name == "picture" ? letter
                               : channels == 1         ? layer.name
                                                       : layer.name + "." + letter;
      const int in_picture = picture.find_channel(name);
      ASSERT_GE(in_picture, 0) << name;
      for (size_t i = 0; i < 6; ++i)
        EXPECT_EQ(pixels[i * channels + c],
                  picture.pixels[i * picture.channels.size() + static_cast<size_t>(in_picture)])
            << name;
    }
  }
}

TEST(FilmLayers, AreFoundByNameInTheAskedOrder) {
  const Film film = small_film();
  const std::vector<FilmLayer> layers = film_layers(film, {"Z", "unknown", "caustic"});
  ASSERT_EQ(layers.size(), 2u);
  EXPECT_EQ(layers[0].name, "Z");
  EXPECT_EQ(layers[1].name, "caustic");
}

}  // namespace
}  // namespace nephroid
