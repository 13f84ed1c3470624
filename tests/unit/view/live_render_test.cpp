// A render that follows its user: pictures, edits, pauses, questions at rest, changed files.
#include "view/live_render.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <future>
#include <thread>

#include "core/errors.h"
#include "unit/view/decoded_frame.h"
#include "unit/view/live_scene.h"
#include "view/first_reading.h"

namespace nephroid {
namespace {

using testing_support::comes;
using testing_support::has_picture;
using testing_support::kLiveScene;

using Live = testing_support::LiveTest;

TEST_F(Live, ShowsAPictureAndGoesOn) {
  LiveRender live(request());
  ASSERT_TRUE(has_picture(live));
  EXPECT_TRUE(comes(live, [](const LiveState& state) { return state.progress.passes_done >= 20; }));
  const LiveState state = live.state();
  EXPECT_EQ(state.status, LiveStatus::kRendering);
  EXPECT_EQ(state.width, 32);
  EXPECT_EQ(state.settings.integrator, "path");
  EXPECT_TRUE(live.frame({"picture"}, 0, 0).has_value());
}

TEST_F(Live, EndsByItsRules) {
  RenderRequest short_one = request();
  short_one.options.last_pass = 3;
  LiveRender live(short_one);
  EXPECT_TRUE(comes(live, [](const LiveState& s) { return s.status == LiveStatus::kDone; }));
  EXPECT_EQ(live.state().progress.passes_done, 4u);
  EXPECT_EQ(live.state().message, "all passes done");
}

/// The picture after four passes of a view with this request is that of a plain render.
TEST_F(Live, PicturesHaveTheBitsOfARender) {
  RenderRequest short_one = request();
  short_one.options.last_pass = 3;
  const LoadedScene loaded = load_scene(short_one);
  Render plain(short_one, loaded);
  SignalFlags signals;
  plain.run(signals);

  LiveRender live(short_one);
  ASSERT_TRUE(comes(live, [](const LiveState& s) { return s.status == LiveStatus::kDone; }));
  const auto expect_equal = [&] {
    live.at_rest([&](const RenderAtRest& rest) {
      const Film& a = plain.film();
      const Film& b = rest.render.film();
      for (int y = 0; y < 24; ++y)
        for (int x = 0; x < 32; ++x)
          for (int c = 0; c < 3; ++c) ASSERT_EQ(a.value(x, y)[c], b.value(x, y)[c]);
    });
  };
  expect_equal();
  // There and back again.
  CameraChange away, back;
  const Vec3d eye = live.state().camera.eye;
  away.eye = Vec3d(1, 1, -4);
  away.is_moving = true;
  back.eye = eye;
  live.move_camera(away);
  live.move_camera(back);
  ASSERT_TRUE(comes(live, [](const LiveState& s) { return s.status == LiveStatus::kDone; }));
  expect_equal();
}

TEST_F(Live, AMoveGivesPreviewsAndThenTheFullPicture) {
  LiveRender live(request());
  ASSERT_TRUE(has_picture(live));
  CameraChange change;
  change.eye = Vec3d(1, 0, -4);
  change.is_moving = true;
  const uint64_t moving = live.move_camera(change);
  EXPECT_TRUE(comes(live, [](const LiveState& s) { return s.is_preview; }));
  change.is_moving = false;
  const uint64_t resting = live.move_camera(change);
  EXPECT_GT(resting, moving);
  EXPECT_TRUE(
      comes(live, [](const LiveState& s) { return !s.is_preview && s.progress.passes_done > 0; }));
  EXPECT_EQ(live.state().camera.eye, Vec3d(1, 0, -4));
}

TEST_F(Live, APoseThatIsNoneChangesNothing) {
  LiveRender live(request());
  ASSERT_TRUE(has_picture(live));
  CameraChange change;
  change.target = live.state().camera.eye;
  const uint64_t generation = live.state().generation;
  EXPECT_THROW(live.move_camera(change), UsageError);
  EXPECT_EQ(live.state().generation, generation);
}

TEST_F(Live, SettingsBeginAnew) {
  LiveRender live(request());
  ASSERT_TRUE(has_picture(live));
  RenderChange change;
  change.resolution = {16, 8};
  change.layers = LayerChoice::kLights;
  live.change(change);
  EXPECT_TRUE(comes(live, [](const LiveState& s) { return s.width == 16 && s.version > 0; }));
  std::vector<std::string> lights;
  for (const LiveLayer& layer : live.state().layers)
    if (layer.kind == LayerKind::kLight) lights.push_back(layer.name);
  EXPECT_EQ(lights, (std::vector<std::string>{"key", "fill"}));
  change.integrator = "nothing";
  EXPECT_THROW(live.change(change), UsageError);
}

TEST_F(Live, APauseHoldsThePicture) {
  LiveRender live(request());
  ASSERT_TRUE(has_picture(live));
  RenderChange pause, go_on;
  pause.action = RenderAction::kPause;
  go_on.action = RenderAction::kResume;
  live.change(pause);
  ASSERT_TRUE(comes(live, [](const LiveState& s) { return s.status == LiveStatus::kPaused; }));
  const double seconds = live.state().progress.seconds;
  const ProbedPixel before = live.probe(16, 12);
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  EXPECT_EQ(live.probe(16, 12).samples, before.samples);
  const auto resumed = std::chrono::steady_clock::now();
  live.change(go_on);
  ASSERT_TRUE(comes(live, [&](const LiveState& s) { return s.progress.seconds > seconds; }));
  const double more = live.state().progress.seconds - seconds;
  const std::chrono::duration<double> since = std::chrono::steady_clock::now() - resumed;
  EXPECT_LT(more, since.count() + 0.1) << "the pause counts as time";
}

TEST_F(Live, AWrongSceneIsToldAndReadAgain) {
  write("WorldBegin\nShape \"spere\"\n");
  LiveRender live(request());
  ASSERT_TRUE(comes(live, [](const LiveState& s) { return s.status == LiveStatus::kFailed; }));
  EXPECT_NE(live.state().message.find("scene.pbrt:2:"), std::string::npos);
  EXPECT_EQ(live.state().failure, ExitStatus::kScene);
  EXPECT_THROW(live.probe(0, 0), UsageError);
  write(kLiveScene);
  live.reload();
  EXPECT_TRUE(has_picture(live));
  EXPECT_EQ(live.state().status, LiveStatus::kRendering);
}

TEST_F(Live, OnlyMistakesInFilesOfScenesAreWaitedFor) {
  EXPECT_TRUE(can_be_mended("s.pbrt", ExitStatus::kScene));
  EXPECT_TRUE(can_be_mended("S.PBRT.gz", ExitStatus::kScene));
  EXPECT_TRUE(can_be_mended("vase.glb", ExitStatus::kScene));
  EXPECT_FALSE(can_be_mended("nix.obj", ExitStatus::kInputOutput));
  EXPECT_FALSE(can_be_mended("s.pbrt", ExitStatus::kUsage));
  EXPECT_FALSE(can_be_mended("picture.exr", ExitStatus::kScene));
  EXPECT_FALSE(can_be_mended("-", ExitStatus::kScene));
}

TEST_F(Live, KnowsTheFilesOfItsScene) {
  write("ball.pbrt", "Shape \"sphere\"\n");
  write(std::string(kLiveScene) + "Include \"ball.pbrt\"\n");
  LiveRender live(request());
  ASSERT_TRUE(has_picture(live));
  std::vector<std::string> files;
  for (const auto& entry : live.files()) files.push_back(entry.first);
  EXPECT_EQ(files, (std::vector<std::string>{file("ball.pbrt"), path_}));
}

TEST_F(Live, WritesAPicture) {
  LiveRender live(request());
  ASSERT_TRUE(comes(live, [](const LiveState& s) { return s.progress.passes_done > 0; }));
  const std::string exr = file("out.exr");
  live.write(exr);
  const Picture picture = read_picture(exr);
  EXPECT_EQ(picture.width(), 32);
  EXPECT_GE(picture.find_channel("diffuse.R"), 0);
  EXPECT_TRUE(std::filesystem::exists(file("out.png")));
}

TEST_F(Live, GoesOnFromASavedRender) {
  const auto is_done = [](const LiveState& state) { return state.status == LiveStatus::kDone; };
  RenderRequest short_one = request();
  short_one.options.output = file("out.exr");
  short_one.options.last_pass = 3;
  {
    LiveRender live(short_one);
    ASSERT_TRUE(comes(live, is_done));
    live.at_rest([&](const RenderAtRest& rest) {
      EXPECT_FALSE(rest.is_edited);
      rest.render.save(short_one.options.output, true);
    });
  }
  short_one.options.last_pass = 5;
  short_one.resume = true;
  LiveRender live(short_one);
  ASSERT_TRUE(comes(live, is_done));
  live.at_rest([](const RenderAtRest& rest) { EXPECT_EQ(rest.render.film().estimates(0), 6u); });
}

TEST_F(Live, AMovedCameraIsAnEdit) {
  LiveRender live(request());
  ASSERT_TRUE(has_picture(live));
  CameraChange change;
  change.eye = Vec3d(1, 0, -4);
  const uint64_t generation = live.move_camera(change);
  bool is_edited = false;
  EXPECT_TRUE(comes(live, [&](const LiveState&) {
    uint64_t seen = 0;
    live.at_rest([&](const RenderAtRest& rest) {
      seen = rest.generation;
      is_edited = rest.is_edited;
    });
    return seen == generation;
  }));
  EXPECT_TRUE(is_edited);
}

TEST_F(Live, ACameraWithoutMovesSettles) {
  LiveRender live(request());
  ASSERT_TRUE(has_picture(live));
  EXPECT_FALSE(live.settle_camera(0)) << "it does not move";
  CameraChange change;
  change.eye = Vec3d(1, 0, -4);
  change.is_moving = true;
  live.move_camera(change);
  EXPECT_FALSE(live.settle_camera(3600));
  EXPECT_TRUE(live.settle_camera(0));
  EXPECT_TRUE(comes(live, [&](const LiveState&) {
    try {
      live.with_picture([](const RenderAtRest&) {});
      return true;
    } catch (const UsageError&) {
      return false;
    }
  }));
}

TEST_F(Live, ErrorsOfQuestionsReachWhoAsks) {
  LiveRender live(request());
  ASSERT_TRUE(has_picture(live));
  EXPECT_THROW(live.at_rest([](const RenderAtRest&) { throw IoError("no"); }), IoError);
  EXPECT_THROW(live.probe(32, 0), UsageError);
}

/// Else a page, or a test, that waits for the end of its edit sees that of the render before.
TEST_F(Live, AnEditBeginsWithItsOwnStatus) {
  LiveRender live(request(2));
  ASSERT_TRUE(testing_support::has_status(live, LiveStatus::kDone));
  std::promise<void> begun, may_end;
  std::thread holds_the_render([&] {
    live.at_rest([&](const RenderAtRest&) {
      begun.set_value();
      may_end.get_future().wait();
    });
  });
  begun.get_future().wait();
  RenderChange restart;
  restart.action = RenderAction::kRestart;
  live.change(restart);
  EXPECT_EQ(live.state().status, LiveStatus::kRendering);
  EXPECT_EQ(live.state().message, "");
  live.reload();
  EXPECT_EQ(live.state().status, LiveStatus::kLoading);
  may_end.set_value();
  holds_the_render.join();
  EXPECT_TRUE(testing_support::has_status(live, LiveStatus::kDone));
}

TEST_F(Live, PreviewsDoNotChangeTheSettings) {
  RenderRequest of_the_scene = request();
  of_the_scene.routes.integrator.clear();
  LiveRender live(of_the_scene);
  ASSERT_TRUE(has_picture(live));
  const std::string integrator = live.state().settings.integrator;
  EXPECT_NE(integrator, "path");
  CameraChange change;
  change.eye = Vec3d(1, 0, -4);
  change.is_moving = true;
  live.move_camera(change);
  ASSERT_TRUE(comes(live, [](const LiveState& s) { return s.is_preview; }));
  EXPECT_EQ(live.state().settings.integrator, integrator);
}

TEST_F(Live, LayersThatThereAreNotAreLeftOut) {
  LiveRender live(request(2));
  ASSERT_TRUE(testing_support::has_status(live, LiveStatus::kDone));
  const auto frame = live.frame({"picture", "nonsense"}, 0, 0);
  ASSERT_TRUE(frame.has_value());
  EXPECT_EQ(testing_support::decode(*frame).header["layers"].size(), 1u);
}

}  // namespace
}  // namespace nephroid
