// A whole render from a scene file to a film and a picture, without a command line.
#include "session/render.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "core/errors.h"
#include "unit/film/scratch_directory.h"

namespace nephroid {
namespace {

constexpr const char* kScene =
    R"(Camera "perspective" "float fov" 20
  Film "rgb" "integer xresolution" 6 "integer yresolution" 4
  Sampler "halton" "integer pixelsamples" 2 "integer seed" 9
  Integrator "volpath" "integer maxdepth" 4 "integer unheardof" 1
  WorldBegin LightSource "point" "point3 from" [0 0 -2] Translate 0 0 3 Shape "sphere")";

class RenderPage : public ::testing::Test {
 protected:
  RenderPage() {
    request_.scene = directory_.file("scene.pbrt");
    std::ofstream(request_.scene) << kScene;
    request_.routes.integrator = "path";
    warnings_.input = [this](const std::string& text) { about_input_.push_back(text); };
    warnings_.output = [this](const std::string& text) { about_output_.push_back(text); };
  }

  /// The value at the film's centre after a render.
  Rgb render() {
    const LoadedScene loaded = load_scene(request_);
    Render render(request_, loaded, warnings_);
    result_ = render.run(signals_);
    identity_ = render.identity();
    return render.film().value(3, 2);
  }

  ScratchDirectory directory_;
  RenderRequest request_;
  RenderWarnings warnings_;
  std::vector<std::string> about_input_, about_output_;
  SignalFlags signals_;
  RenderResult result_;
  RenderIdentity identity_;
};

TEST_F(RenderPage, TakesFromTheSceneWhatTheRequestLeavesOut) {
  EXPECT_GT(render().g, 0);
  EXPECT_EQ(result_.passes_done, 2u);
  EXPECT_EQ(identity_.seed, "9");
  EXPECT_EQ(identity_.film, "6x4, columns 0 to 6, rows 0 to 4");
  EXPECT_EQ(identity_.integrator, "path");
  EXPECT_EQ(identity_.options.substr(0, 12), "max-depth=4 ");
  EXPECT_EQ(std::filesystem::exists(directory_.file("scene.exr")), false);

  request_.seed = 5;
  request_.overrides.width = request_.overrides.height = 8;
  request_.settings = render_settings({{"max-depth", "2"}, {"specular-alpha", "0.2"}});
  request_.options.last_pass = 0;
  render();
  EXPECT_EQ(result_.passes_done, 1u);
  EXPECT_EQ(identity_.seed, "5");
  EXPECT_EQ(identity_.film, "8x8, columns 0 to 8, rows 0 to 8");
  EXPECT_EQ(identity_.options.substr(0, 12), "max-depth=2 ");
  EXPECT_EQ(load_scene(request_).scene->specular_band.high, 0.2f);
}

TEST_F(RenderPage, WarnsOfTheInput) {
  request_.settings = render_settings({{"hit-points", "3"}});
  render();
  ASSERT_EQ(about_input_.size(), 2u);
  EXPECT_NE(about_input_[0].find("unheardof"), std::string::npos) << about_input_[0];
  EXPECT_NE(about_input_[1].find("-D hit-points"), std::string::npos) << about_input_[1];
  EXPECT_TRUE(about_output_.empty());
}

TEST_F(RenderPage, StrictRefusesUnknownNamesBeforeItRenders) {
  const LoadedScene loaded = load_scene(request_);
  request_.strict = true;
  try {
    Render render(request_, loaded, warnings_);
    FAIL() << "the Integrator line has an unknown parameter";
  } catch (const SceneError& error) {
    EXPECT_EQ(error.status(), ExitStatus::kScene);
    EXPECT_EQ(std::string(error.what()),
              request_.scene +
                  ":4:45: unknown parameter \"unheardof\" of integrator \"volpath\", ignored\n"
                  "--strict: 1 unknown name in the scene, expected names of its format");
  }
  std::ofstream(request_.scene)
      << "Option \"sed\" 1\nWorldBegin\nLightSource \"infinite\" \"string image\" \"a\"\n"
         "Material \"diffuse\" \"rgb Kd\" [1 1 1]\nShape \"sphere\" \"float radus\" 1";
  const LoadedScene wrong = load_scene(request_);
  EXPECT_EQ(wrong.unknown_names.size(), 4u);
  EXPECT_THROW(Render(request_, wrong, warnings_), SceneError);
  request_.strict = false;
  about_input_.clear();
  Render(request_, wrong, warnings_);
  ASSERT_GE(about_input_.size(), 4u);
  EXPECT_TRUE(std::ranges::any_of(about_input_, [](const std::string& text) {
    return text.find("\"image\" of light \"infinite\", did you mean \"filename\"?") !=
           std::string::npos;
  }));
}

TEST_F(RenderPage, WhatIsKeptIsSaidInOneLine) {
  request_.options.output = directory_.file("out.exr");
  request_.resume = true;
  request_.options.last_pass = 0;
  render();
  ASSERT_EQ(about_output_.size(), 1u);
  EXPECT_NE(about_output_[0].find("yet, the render starts at its first pass"), std::string::npos);
  request_.resume = false;
  render();
  ASSERT_EQ(about_output_.size(), 2u);
  for (const char* const name : {"out.previous.exr", "out.previous.state", "out.previous.png"}) {
    EXPECT_NE(about_output_[1].find(name), std::string::npos) << about_output_[1];
    EXPECT_TRUE(std::filesystem::exists(directory_.file(name))) << name;
  }
}

TEST_F(RenderPage, ABlackPictureHasNoError) {
  std::ofstream(request_.scene) << R"(Camera "perspective"
    Film "rgb" "integer xresolution" 6 "integer yresolution" 4
    WorldBegin Translate 0 0 6 Shape "sphere" "float radius" 0.5 LightSource "point"
    Translate 0 0 -3 Shape "sphere")";
  request_.options.last_pass = 3;
  for (const char* integrator : {"path", "mixed"}) {
    request_.routes.integrator = integrator;
    render();
    EXPECT_FALSE(result_.error.has_value());
    ASSERT_TRUE(result_.error_text.has_value());
    EXPECT_EQ(result_.error_text->find("the picture is black, so that no error can be estimated"),
              0u)
        << *result_.error_text;
  }
  EXPECT_NE(result_.error_text->find("point1"), std::string::npos) << *result_.error_text;
}

TEST_F(RenderPage, ResumesWithTheBitsOfOneRun) {
  const Rgb whole = render();
  request_.options.output = directory_.file("out.exr");
  request_.options.last_pass = 0;
  render();
  request_.options.last_pass = 1;
  request_.resume = true;
  const Rgb resumed = render();
  EXPECT_EQ(result_.passes_of_run, 1u);
  EXPECT_EQ(result_.passes_done, 2u);
  EXPECT_EQ(resumed.r, whole.r);
  EXPECT_EQ(resumed.g, whole.g);
  EXPECT_EQ(resumed.b, whole.b);
  EXPECT_TRUE(about_output_.empty());

  request_.options.last_pass = 0;
  render();
  ASSERT_EQ(about_output_.size(), 1u);
  EXPECT_NE(about_output_[0].find("the others stay"), std::string::npos) << about_output_[0];
  request_.resume = false;
  render();
  ASSERT_EQ(about_output_.size(), 2u);
  EXPECT_NE(about_output_[1].find("it is kept as"), std::string::npos) << about_output_[1];
}

TEST_F(RenderPage, RefusesAnotherRenderAndTooLittleMemory) {
  request_.options.output = directory_.file("out.exr");
  render();
  request_.resume = true;
  request_.seed = 10;
  EXPECT_THROW(render(), UsageError);
  request_.seed.reset();
  EXPECT_NO_THROW(render());
  request_.overrides.import.floor = true;
  EXPECT_THROW(render(), UsageError);
  request_.overrides.import = {};
  request_.overrides.import.exposure = 1;
  EXPECT_THROW(render(), UsageError);
  request_.overrides.import = {};
  request_.resume = false;
  request_.memory = 1 << 20;
  EXPECT_THROW(render(), UsageError);
}

}  // namespace
}  // namespace nephroid
