// Mixes against hand-computed sums, what a mixed picture keeps, and what is refused.
#include "image/mix.h"

#include <gtest/gtest.h>

#include "core/errors.h"
#include "film/metadata_keys.h"

namespace nephroid {
namespace {

/// A picture of one row with these layers of three channels, one value a pixel and layer in R; G is
/// twice and B three times of it. The picture itself is the sum of routes.
struct LayerValues {
  std::string name;
  std::vector<float> values;
};
Picture layered_picture_of(const std::vector<LayerValues>& layers, Metadata metadata) {
  Picture picture;
  const size_t width = layers[0].values.size();
  picture.full_width = static_cast<int>(width);
  picture.full_height = 1;
  picture.window = {0, 0, picture.full_width, 1};
  for (const LayerValues& layer : layers)
    for (const char* const letter : {"R", "G", "B"})
      picture.channels.push_back(layer.name.empty() ? letter : layer.name + "." + letter);
  picture.channels.emplace_back("Z");
  for (size_t x = 0; x < width; ++x) {
    for (const LayerValues& layer : layers)
      for (const float factor : {1.0f, 2.0f, 3.0f})
        picture.pixels.push_back(factor * layer.values[x]);
    picture.pixels.push_back(7);
  }
  picture.metadata = std::move(metadata);
  return picture;
}

const std::string kRoutes = "caustic = C.*DS+L : photons\nrest = .* : path\n";

Picture by_light() {
  return layered_picture_of({{"", {3, 30}},
                             {"caustic", {1, 10}},
                             {"rest", {2, 20}},
                             {"key", {2.5f, 5}},
                             {"rim", {0.5f, 25}},
                             {"mine", {9, 9}},
                             {"albedo", {0.5f, 0.25f}},
                             {"stderr", {0.1f, 0.1f}}},
                            {{kRoutesKey, kRoutes},
                             {kLayersByLightKey, "key = light key\nrim = light rim\n"},
                             {"nephroid:seed", "4"},
                             {kChoicesKey, "estimated error: 0.1\n"}});
}

Picture by_both() {
  return layered_picture_of({{"", {3}},
                             {"caustic", {1}},
                             {"rest", {2}},
                             {"caustic_key", {1}},
                             {"rest_key", {1.5f}},
                             {"rest_rim", {0.5f}}},
                            {{kRoutesKey, kRoutes},
                             {kLayersByLightKey,
                              "caustic_key = route caustic, light key\n"
                              "rest_key = route rest, light key\n"
                              "rest_rim = route rest, light rim\n"}});
}

/// Red of a layer in each pixel; the picture's with "".
std::vector<float> values(const Picture& picture, const std::string& layer,
                          const std::string& letter = "R") {
  const int channel = picture.find_channel(layer.empty() ? letter : layer + "." + letter);
  std::vector<float> found;
  if (channel < 0) return found;
  for (size_t i = 0; i < picture.pixels.size(); i += picture.channels.size())
    found.push_back(picture.pixels[i + static_cast<size_t>(channel)]);
  return found;
}

using Values = std::vector<float>;

TEST(Mix, OfLightsIsTheirWeightedSum) {
  const Picture result = mixed(by_light(), {{{"key", {2, 2, 2}}}, {}});
  EXPECT_EQ(values(result, ""), (Values{5.5f, 35}));
  EXPECT_EQ(values(result, "", "B"), (Values{16.5f, 105}));
  // The layers that were added are scaled, so that they add up again.
  EXPECT_EQ(values(result, "key"), (Values{5, 10}));
  EXPECT_EQ(values(result, "rim"), (Values{0.5f, 25}));
  EXPECT_EQ(values(result, "albedo"), (Values{0.5f, 0.25f}));
  EXPECT_EQ(values(result, "", "Z"), (Values{7, 7}));
  // Nobody knows how these would change.
  for (const char* const layer : {"caustic", "rest", "mine", "stderr"})
    EXPECT_TRUE(values(result, layer).empty()) << layer;
  EXPECT_EQ(value_of(result.metadata, kMixKey), "light key = 2\nlight rim = 1\n");
  EXPECT_EQ(value_of(result.metadata, "nephroid:seed"), "4");
  EXPECT_EQ(value_of(result.metadata, kChoicesKey), "") << "the report is of the light before";
}

TEST(Mix, OfRoutesIsTheirWeightedSum) {
  const Picture result = mixed(by_light(), {{}, {{"caustic", {0, 0, 0}}}});
  EXPECT_EQ(values(result, ""), (Values{2, 20}));
  EXPECT_EQ(values(result, "caustic"), (Values{0, 0}));
  EXPECT_TRUE(values(result, "key").empty());
  EXPECT_EQ(value_of(result.metadata, kLayersByLightKey), "");
  EXPECT_EQ(value_of(result.metadata, kMixKey), "route caustic = 0\nroute rest = 1\n");
}

TEST(Mix, OfLightsAndRoutesMultipliesTheirGains) {
  const Picture result = mixed(by_both(), {{{"key", {2, 2, 2}}}, {{"rest", {10, 10, 10}}}});
  // 1 * 2 + 1.5 * 2 * 10 + 0.5 * 10
  EXPECT_EQ(values(result, ""), (Values{37}));
  EXPECT_EQ(values(result, "caustic"), (Values{2}));
  EXPECT_EQ(values(result, "rest"), (Values{35}));
  EXPECT_EQ(values(result, "rest_key"), (Values{30}));
  EXPECT_EQ(value_of(result.metadata, kMixKey),
            "light key = 2\nlight rim = 1\nroute caustic = 1\nroute rest = 10\n");
}

TEST(Mix, OfLightsAloneWorksWithBoth) {
  EXPECT_EQ(values(mixed(by_both(), {{{"rim", {4, 4, 4}}}, {}}), ""), (Values{4.5f}));
}

TEST(Mix, TintsEachComponent) {
  const Picture result = mixed(by_light(), {{{"rim", {0.5f, 1, 2}}}, {}});
  EXPECT_EQ(values(result, ""), (Values{2.75f, 17.5f}));
  EXPECT_EQ(values(result, "", "G"), (Values{6, 60}));
  EXPECT_EQ(values(result, "", "B"), (Values{10.5f, 165}));
  EXPECT_EQ(value_of(result.metadata, kMixKey),
            "light key = 1\nlight rim = 0.5, 1, 2 (tint: an RGB approximation)\n");
}

TEST(Mix, OfAMixListsTheGainsOfBoth) {
  const Picture once = mixed(by_both(), {{{"rim", {0.5f, 1, 2}}, {"key", {3, 3, 3}}}, {}});
  const Picture twice = mixed(once, {{{"rim", {2, 2, 2}}}, {{"caustic", {4, 4, 4}}}});
  EXPECT_EQ(value_of(twice.metadata, kMixKey),
            "light key = 3\nlight rim = 1, 2, 4 (tint: an RGB approximation)\n"
            "route caustic = 4\nroute rest = 1\n");
  // 1 * 3 * 4 + 1.5 * 3 + 0.5 * 0.5 * 2
  EXPECT_EQ(values(twice, ""), (Values{17}));
}

/// The message of a mix that is refused.
std::string refusal(const Picture& picture, const Mix& mix) {
  try {
    mixed(picture, mix);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "";
}

TEST(Mix, WhatIsMissingIsSaid) {
  const Picture plain = layered_picture_of({{"", {1}}, {"caustic", {1}}}, {{kRoutesKey, kRoutes}});
  const Mix light = {{{"key", {2, 2, 2}}}, {}}, route = {{}, {{"caustic", {2, 2, 2}}}};
  EXPECT_EQ(refusal(plain, light),
            "--light: the picture has no layers by light, expected one rendered with --layers "
            "lights or --layers both");
  EXPECT_NE(refusal(by_light(), {light.lights, route.routes}).find("--layers both"),
            std::string::npos);
  EXPECT_NE(refusal(layered_picture_of({{"", {1}}}, {}), route).find("no layers by route"),
            std::string::npos);
  EXPECT_EQ(refusal(by_light(), {{{"Key", {2, 2, 2}}}, {}}),
            "--light: the picture has no light 'Key', expected one of: key, rim, did you mean "
            "\"key\"?");
  EXPECT_EQ(refusal(by_light(), {{}, {{"rst", {2, 2, 2}}}}),
            "--route: the picture has no route 'rst', expected one of: caustic, rest, did you mean "
            "\"rest\"?");
  EXPECT_EQ(refusal(by_light(), {{light.lights[0], light.lights[0]}, {}}),
            "--light: 'key' is given twice, expected once");
}

TEST(Mix, LayersThatTheFileLacksCannotBeMixed) {
  Picture picture = by_light();
  picture.channels[9] = "gone.R";  // key.R
  const MixLayers layers = mix_layers(picture);
  EXPECT_EQ(layers.routes, (std::vector<std::string>{"caustic", "rest"}));
  EXPECT_EQ(layers.by_light, (std::vector<LayerByLight>{{"rim", "", "rim"}}));
}

TEST(Mix, ParsesGains) {
  const MixGain one = parse_mix_gain("--light", "key=0.25");
  EXPECT_EQ(one.name, "key");
  EXPECT_FALSE(one.is_tint());
  EXPECT_EQ(one.gain.b, 0.25f);
  const MixGain three = parse_mix_gain("--light", "key=1,0.5,0");
  EXPECT_TRUE(three.is_tint());
  EXPECT_EQ(three.gain.g, 0.5f);
  EXPECT_EQ(three.gain.b, 0.0f);
  for (const char* const text :
       {"key", "=2", "key=", "key=two", "key=-1", "key=1,2", "key=1,2,3,4", "key=inf", "key=nan"})
    EXPECT_THROW(parse_mix_gain("--light", text), UsageError) << text;
}

TEST(Mix, ClampedAndRejectedSamplesAreToldApart) {
  EXPECT_TRUE(inexact_mix_reasons(by_light().metadata).empty());
  EXPECT_EQ(inexact_mix_reasons({{kMaxComponentKey, "10"}, {kOutliersKey, "reject"}}).size(), 2u);
}

}  // namespace
}  // namespace nephroid
