// `render --layers` and `mix` with the real program: a mix is what a render with other lamps is,
// and mistakes are named.
#include <gtest/gtest.h>

#include <numeric>

#include "film/image_io.h"
#include "regression/scene_folder.h"

namespace nephroid::testing_support {
namespace {

/// Two lamps; `key` is the intensity of one.
std::string scene_with(const std::string& key, const std::string& film = "") {
  return "Film \"rgb\" \"integer xresolution\" 8 \"integer yresolution\" 8 " + film +
         "\nLookAt 0 0 -3  0 0 0  0 1 0\nCamera \"perspective\"\nWorldBegin\n"
         "LightSource \"point\" \"rgb I\" [300 200 100] \"float scale\" " +
         key +
         " \"string name\" \"key\" \"point3 from\" [1 1 -3]\n"
         "LightSource \"infinite\" \"rgb L\" [0.1 0.2 0.3]\n" +
         kTriangle;
}

std::vector<float> channel(const Picture& picture, const std::string& name) {
  std::vector<float> values;
  const int channel = picture.find_channel(name);
  if (channel < 0) return values;
  for (size_t i = 0; i < picture.pixels.size(); i += picture.channels.size())
    values.push_back(picture.pixels[i + static_cast<size_t>(channel)]);
  return values;
}

class MixCommandTest : public ::testing::Test {
 protected:
  MixCommandTest() : folder_(scene_with("1")) {}

  void render(const std::string& output, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments{"--float", "--integrator", "path", "-o", output};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramRun run = folder_.render(arguments);
    EXPECT_EQ(run.status, 0) << run.errors;
  }
  ProgramRun mix(const std::vector<std::string>& more) const {
    std::vector<std::string> arguments{"mix"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_program(folder_.path(""), arguments);
  }
  static void expect_said(const ProgramRun& run, int status, const std::string& text) {
    EXPECT_EQ(run.status, status) << run.errors;
    EXPECT_NE(run.errors.find(text), std::string::npos) << run.errors;
  }

  SceneFolder folder_;
};

TEST_F(MixCommandTest, IsARenderWithOtherLamps) {
  render("a.exr", {"--layers", "lights", "--passes", "16"});
  const ProgramRun run = mix({"a.exr", "--light", "key=3", "-o", "b.exr", "--float"});
  EXPECT_EQ(run.status, 0) << run.errors;
  folder_.write("scene.pbrt", scene_with("3"));
  render("c.exr", {"--layers", "lights", "--passes", "16"});
  const Picture before = read_picture(folder_.path("a.exr"));
  const Picture mixed = read_picture(folder_.path("b.exr"));
  const std::vector<float> key = channel(before, "key.R"), sky = channel(before, "infinite1.R");
  const std::vector<float> red = channel(mixed, "R");
  for (size_t i = 0; i < red.size(); ++i) EXPECT_FLOAT_EQ(red[i], 3 * key[i] + sky[i]);
  const auto sum = [](const std::vector<float>& of) {
    return std::accumulate(of.begin(), of.end(), 0.0);
  };
  const double rendered = sum(channel(read_picture(folder_.path("c.exr")), "R"));
  EXPECT_GT(rendered, 1.5 * sum(channel(before, "R")));
  // Both have the noise of 1024 paths.
  EXPECT_NEAR(sum(red), rendered, 0.15 * rendered);
  EXPECT_EQ(value_of(mixed.metadata, "nephroid:mix"), "light key = 3\nlight infinite1 = 1\n");
  EXPECT_TRUE(names_in(folder_.path("")).contains("b.png"));
  EXPECT_FALSE(names_in(folder_.path("")).contains("b.state"));
}

TEST_F(MixCommandTest, MistakesAreNamed) {
  render("a.exr");
  expect_said(mix({"a.exr", "--light", "key=3", "-o", "b.exr"}), kUsage,
              "a.exr: --light: the picture has no layers by light, expected one rendered with "
              "--layers lights");
  expect_said(mix({"a.exr", "-o", "b.exr"}), kUsage, "neither --light nor --route given");
  expect_said(mix({"a.exr", "--route", "diffuse=2"}), kUsage, "mix: no --output given");
  expect_said(mix({"a.exr", "--route", "diffuse=2", "-o", "a.exr"}), kUsage,
              "'a.exr' is the picture to mix, expected another name");
  expect_said(mix({"none.exr", "--route", "diffuse=2", "-o", "b.exr"}), kInputOutput, "none.exr");
  expect_said(folder_.render({"--layers", "light"}), kUsage,
              "--layers: 'light' is not valid, expected routes, lights or both");
  expect_said(folder_.render({"--layers", "lights", "--aov", "key=.*"}), kUsage,
              "--aov: 'key' is the name of a layer by light");
  EXPECT_FALSE(names_in(folder_.path("")).contains("b.exr"));
}

TEST_F(MixCommandTest, WarnsOfClampedSamplesAndRejectedOutliers) {
  folder_.write("scene.pbrt", scene_with("1", "\"float maxcomponentvalue\" 2"));
  render("a.exr", {"--outliers", "reject", "--passes", "1"});
  const ProgramRun run = mix({"a.exr", "--route", "diffuse=2", "-o", "b.exr"});
  expect_said(run, 0, "samples are clamped");
  expect_said(run, 0, "outliers are rejected");
}

TEST_F(MixCommandTest, MergedPicturesKeepTheirLayers) {
  render("a.exr", {"--layers", "both", "--passes", "0..0"});
  render("b.exr", {"--layers", "both", "--passes", "1..1"});
  const ProgramRun merged =
      run_program(folder_.path(""), {"merge", "a.exr", "b.exr", "-o", "c.exr"});
  EXPECT_EQ(merged.status, 0) << merged.errors;
  expect_said(mix({"c.exr", "--light", "key=3", "--route", "diffuse=0", "-o", "d.exr"}), 0, "");
  const Picture dark = read_picture(folder_.path("d.exr"));
  EXPECT_EQ(dark.pixels[static_cast<size_t>(dark.find_channel("R"))], 0);
}

}  // namespace
}  // namespace nephroid::testing_support
