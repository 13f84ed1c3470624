// Scenes whose files change, are missing or wrong while they are viewed.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>

#include "core/errors.h"
#include "unit/view/live_scene.h"
#include "view/watched_files.h"

namespace nephroid {
namespace {

using testing_support::comes;
using testing_support::has_picture;
using testing_support::has_status;
using testing_support::kLiveScene;

class Reload : public testing_support::LiveTest {
 protected:
  /// As the program does once a second.
  static bool reload_if_changed(LiveRender& live) {
    const bool changed = have_changed(live.files());
    if (changed) live.reload();
    return changed;
  }
  static void move_camera(LiveRender& live) {
    CameraChange change;
    change.eye = Vec3d(1, 0, -4);
    live.move_camera(change);
  }
  static std::string including(const std::string& name) {
    return kLiveScene + ("Include \"" + name + "\"\n");
  }
};

TEST_F(Reload, AMissingFileThatAppearsBringsThePicture) {
  write(including("ball.pbrt"));
  LiveRender live(request());
  ASSERT_TRUE(has_status(live, LiveStatus::kFailed));
  EXPECT_FALSE(reload_if_changed(live));
  write("ball.pbrt", "Shape \"sphere\"\n");
  EXPECT_TRUE(reload_if_changed(live));
  EXPECT_TRUE(has_picture(live));
}

TEST_F(Reload, MendingAnyFileOfAWrongSceneBringsThePicture) {
  write("good.pbrt", "Shape \"sphere\"\n");
  write("wrong.pbrt", "Shape \"spere\"\n");
  write(including("good.pbrt") + "Include \"wrong.pbrt\"\n");
  LiveRender live(request());
  ASSERT_TRUE(has_status(live, LiveStatus::kFailed));
  EXPECT_TRUE(live.files().contains(path_));
  EXPECT_TRUE(live.files().contains(file("good.pbrt"))) << "read before the wrong one";
  EXPECT_FALSE(reload_if_changed(live));
  write("wrong.pbrt", "Shape \"sphere\" \"float radius\" 0.5\n");
  EXPECT_TRUE(reload_if_changed(live));
  EXPECT_TRUE(has_picture(live));
}

TEST_F(Reload, AMissingImageThatAppearsBringsThePicture) {
  write(std::string(kLiveScene) +
        "Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"paint.pfm\"\n"
        "Material \"diffuse\" \"texture reflectance\" \"t\"\nShape \"disk\"\n");
  LiveRender live(request());
  ASSERT_TRUE(has_status(live, LiveStatus::kFailed));
  EXPECT_FALSE(reload_if_changed(live));
  write("paint.pfm", std::string("PF\n1 1\n-1.0\n") + std::string(12, '\0'));
  EXPECT_TRUE(reload_if_changed(live));
  EXPECT_TRUE(has_picture(live)) << live.state().message;
}

TEST_F(Reload, AMissingSceneThatAppearsBringsThePicture) {
  std::filesystem::remove(path_);
  LiveRender live(request());
  ASSERT_TRUE(has_status(live, LiveStatus::kFailed));
  write(kLiveScene);
  EXPECT_TRUE(reload_if_changed(live));
  EXPECT_TRUE(has_picture(live));
}

/// Reading a pipe waits for its writer, so the test decides how long the scene is being read.
TEST_F(Reload, AChangeWhileTheSceneIsReadIsNoticedAfterwards) {
  ASSERT_EQ(::mkfifo(file("slow.pbrt").c_str(), 0600), 0);
  write("early.pbrt", "Shape \"sphere\"\n");
  write(including("early.pbrt") + "Include \"slow.pbrt\"\n");
  LiveRender live(request());
  // The pipe can be opened as soon as the scene has read the file before it.
  std::ofstream pipe(file("slow.pbrt"));
  EXPECT_EQ(live.state().status, LiveStatus::kLoading);
  EXPECT_TRUE(live.files().empty());
  EXPECT_THROW(live.probe(0, 0), UsageError) << "it does not wait for a scene";
  write("early.pbrt", "Shape \"sphere\" \"float radius\" 0.5\n");
  pipe << "Shape \"disk\"\n";
  pipe.close();
  ASSERT_TRUE(has_picture(live));
  EXPECT_TRUE(have_changed(live.files()));
}

TEST_F(Reload, ASceneFromAPipeIsNotReadAgain) {
  std::filesystem::remove(path_);
  ASSERT_EQ(::mkfifo(path_.c_str(), 0600), 0);
  write("ball.pbrt", "Shape \"sphere\"\n");
  LiveRender live(request());
  write(including(file("ball.pbrt")));
  ASSERT_TRUE(has_picture(live)) << live.state().message;
  EXPECT_TRUE(live.files().empty());
}

TEST_F(Reload, AnEditedCameraStays) {
  LiveRender live(request());
  ASSERT_TRUE(has_picture(live));
  move_camera(live);
  live.reload();
  ASSERT_TRUE(has_status(live, LiveStatus::kRendering));
  EXPECT_EQ(live.state().camera.eye, Vec3d(1, 0, -4));
}

TEST_F(Reload, ACameraThatTheNewTypeCannotBeGivesWayToThatOfTheScene) {
  LiveRender live(request());
  ASSERT_TRUE(has_picture(live));
  move_camera(live);
  ASSERT_TRUE(comes(live, [](const LiveState& state) { return state.camera.fov.has_value(); }));
  std::string orthographic = kLiveScene;
  const std::string perspective = "\"perspective\" \"float fov\" 40";
  orthographic.replace(orthographic.find(perspective), perspective.size(), "\"orthographic\"");
  write(orthographic);
  live.reload();
  EXPECT_TRUE(comes(live, [](const LiveState& state) {
    return state.camera_type == "orthographic" && state.status == LiveStatus::kRendering;
  })) << live.state().message;
  EXPECT_EQ(live.state().camera.eye, Vec3d(0, 0, -4));
}

}  // namespace
}  // namespace nephroid
