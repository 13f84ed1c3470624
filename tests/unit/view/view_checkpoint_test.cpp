// The files that a view with -o writes.
#include "view/view_checkpoint.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "core/errors.h"
#include "film/state_file.h"
#include "unit/view/live_scene.h"

namespace nephroid {
namespace {

namespace fs = std::filesystem;
using testing_support::has_status;

class Output : public testing_support::LiveTest {
 protected:
  RenderRequest with_output(uint32_t passes) const {
    RenderRequest wanted = request(passes);
    wanted.options.output = exr_;
    return wanted;
  }
  bool has(const std::string& name) const { return fs::exists(file(name)); }
  std::string content(const std::string& name) const {
    std::ifstream stream(file(name), std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  /// Passes of the picture that the state file holds.
  std::string passes() const { return passes_of(open_state(exr_, "test"), "test").text(); }
  static void move(LiveRender& live, double x) {
    CameraChange change;
    change.eye = Vec3d(x, 0, -4);
    live.move_camera(change);
    ASSERT_TRUE(has_status(live, LiveStatus::kDone));
  }

  std::string exr_ = file("out.exr");
};

TEST_F(Output, HasPictureAndState) {
  LiveRender live(with_output(3));
  ASSERT_TRUE(has_status(live, LiveStatus::kDone));
  EXPECT_FALSE(has("out.exr")) << "nothing is written unasked";
  ViewCheckpoint checkpoint(exr_);
  EXPECT_NE(checkpoint.write(live).find("with which --resume goes on"), std::string::npos);
  EXPECT_TRUE(has("out.exr") && has("out.png") && has("out.state"));
  EXPECT_EQ(passes(), "0..2");
  checkpoint.write(live);
  EXPECT_FALSE(has("out.previous.exr")) << "its own earlier picture is replaced";
}

TEST_F(Output, FilesOfAnotherRenderAreKept) {
  write("out.exr", "mine");
  write("out.png", "my PNG");
  LiveRender live(with_output(2));
  ASSERT_TRUE(has_status(live, LiveStatus::kDone));
  ViewCheckpoint(exr_).write(live);
  EXPECT_EQ(content("out.previous.exr"), "mine");
  EXPECT_EQ(content("out.previous.png"), "my PNG");
  EXPECT_EQ(read_picture(exr_).width(), testing_support::kLiveWidth);
}

TEST_F(Output, OfAResumedRenderReplacesWhatItGoesOnFrom) {
  {
    LiveRender live(with_output(2));
    ASSERT_TRUE(has_status(live, LiveStatus::kDone));
    ViewCheckpoint(exr_).write(live);
  }
  RenderRequest wanted = with_output(5);
  wanted.resume = true;
  LiveRender live(wanted);
  ASSERT_TRUE(has_status(live, LiveStatus::kDone));
  ViewCheckpoint(exr_).write(live);
  EXPECT_EQ(passes(), "0..4");
  EXPECT_FALSE(has("out.previous.exr"));
}

TEST_F(Output, OfAMovedCameraHasNoState) {
  LiveRender live(with_output(2));
  ASSERT_TRUE(has_status(live, LiveStatus::kDone));
  ViewCheckpoint checkpoint(exr_);
  checkpoint.write(live);
  const std::string before = content("out.exr");
  move(live, 1);
  EXPECT_NE(checkpoint.write(live).find("--resume cannot go on"), std::string::npos);
  EXPECT_TRUE(has("out.exr"));
  EXPECT_FALSE(has("out.state"));
  EXPECT_TRUE(content("out.previous.exr") == before) << "the picture of the scene's own camera";
  EXPECT_TRUE(has("out.previous.state"));
}

TEST_F(Output, OfChangedSettingsHasNoState) {
  LiveRender live(with_output(2));
  ASSERT_TRUE(has_status(live, LiveStatus::kDone));
  RenderChange change;
  change.resolution = {16, 12};
  live.change(change);
  ASSERT_TRUE(testing_support::comes(live, [](const LiveState& state) {
    return state.status == LiveStatus::kDone && state.width == 16;
  }));
  ViewCheckpoint(exr_).write(live);
  EXPECT_EQ(read_picture(exr_).width(), 16);
  EXPECT_FALSE(has("out.state"));
}

/// A long render is not lost because a restart or another scene has begun in its place.
TEST_F(Output, BeforeARestartIsKept) {
  LiveRender live(with_output(2));
  ASSERT_TRUE(has_status(live, LiveStatus::kDone));
  ViewCheckpoint checkpoint(exr_);
  checkpoint.write(live);
  const std::string before = content("out.exr");
  RenderChange restart;
  restart.action = RenderAction::kRestart;
  live.change(restart);
  ASSERT_TRUE(has_status(live, LiveStatus::kDone));
  checkpoint.write(live);
  EXPECT_TRUE(content("out.previous.exr") == before);
  EXPECT_TRUE(has("out.state"));
}

TEST_F(Output, BeforeTheViewStaysKept) {
  write("out.exr", "mine");
  LiveRender live(with_output(2));
  ASSERT_TRUE(has_status(live, LiveStatus::kDone));
  ViewCheckpoint checkpoint(exr_);
  checkpoint.write(live);
  for (int i = 1; i <= 2; ++i) {
    move(live, i);
    checkpoint.write(live);
    EXPECT_EQ(content("out.previous.exr"), "mine");
  }
}

TEST_F(Output, ThatCannotBeWrittenAtTheEndIsRescued) {
  fs::create_symlink(file("nowhere/out.exr"), exr_);
  RenderRequest wanted = with_output(2);
  fs::create_directory(file("rescue"));
  wanted.options.rescue_directory = file("rescue");
  LiveRender live(wanted);
  ASSERT_TRUE(has_status(live, LiveStatus::kDone));
  EXPECT_THROW(ViewCheckpoint(exr_).write_last(live), IoError);
  int rescued = 0;
  for (const auto& entry : fs::recursive_directory_iterator(file("rescue")))
    rescued += entry.path().filename() == "out.exr";
  EXPECT_EQ(rescued, 1);
}

TEST_F(Output, ThatCannotBeWrittenTwiceLeavesWhatWasKept) {
  // The state can be written, the picture not: its link leads nowhere.
  fs::create_symlink(file("nowhere/out.exr"), exr_);
  write("out.png", "mine");
  write("out.state", "mine, too");
  LiveRender live(with_output(2));
  ASSERT_TRUE(has_status(live, LiveStatus::kDone));
  ViewCheckpoint checkpoint(exr_);
  EXPECT_THROW(checkpoint.write(live), IoError);
  EXPECT_THROW(checkpoint.write(live), IoError);
  EXPECT_EQ(content("out.previous.png"), "mine");
  EXPECT_EQ(content("out.previous.state"), "mine, too");
}

TEST_F(Output, IsNotWrittenWithoutAPicture) {
  write("WorldBegin\nShape \"spere\"\n");
  LiveRender live(with_output(2));
  ASSERT_TRUE(has_status(live, LiveStatus::kFailed));
  EXPECT_NE(ViewCheckpoint(exr_).write(live).find("was not written"), std::string::npos);
  EXPECT_FALSE(has("out.exr"));
}

}  // namespace
}  // namespace nephroid
