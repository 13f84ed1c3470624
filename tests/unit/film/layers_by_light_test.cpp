// The text of layers by light in a picture's metadata.
#include "film/layers_by_light.h"

#include <gtest/gtest.h>

namespace nephroid {
namespace {

TEST(LayersByLight, TextAndBack) {
  const std::vector<LayerByLight> layers = {{"key", "", "key"}, {"caustic_key", "caustic", "key"}};
  const std::string text = layers_by_light_text(layers);
  EXPECT_EQ(text, "key = light key\ncaustic_key = route caustic, light key\n");
  EXPECT_EQ(parse_layers_by_light(text), layers);
  EXPECT_EQ(layers_by_light_text({}), "");
}

TEST(LayersByLight, LinesOfAnotherFormAreLeftOut) {
  EXPECT_EQ(parse_layers_by_light("key\nkey = lamp key\nkey = route caustic\n\na = light b"),
            (std::vector<LayerByLight>{{"a", "", "b"}}));
}

}  // namespace
}  // namespace nephroid
