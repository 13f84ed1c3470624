// Resuming and merging with the real program: the result has the bits of a single run, data of
// another render are refused by name, and an unwritable log ends nothing.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>

#include "film/image_io.h"
#include "regression/scene_folder.h"
#include "source_directory.h"

namespace nephroid::testing_support {
namespace {

class CheckpointCommand : public ::testing::Test {
 protected:
  /// Renders the small caustic room and expects that status.
  ProgramRun render(const std::string& output, const std::vector<std::string>& more,
                    int status = 0) {
    std::vector<std::string> arguments{"render", kRoom, "--resolution", "24x16", "-t",
                                       "2",      "-D",  "photons=2000", "-o",    output + ".exr"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    ProgramRun run = run_program(folder_.path(), arguments);
    EXPECT_EQ(run.status, status) << run.errors;
    return run;
  }
  Picture picture(const std::string& name) const {
    return read_picture(folder_.path(name + ".exr"));
  }
  void expect_same(const std::string& a, const std::string& b) const {
    const Picture first = picture(a), second = picture(b);
    EXPECT_EQ(first.channels, second.channels);
    EXPECT_TRUE(first.pixels == second.pixels) << a << " and " << b;
  }
  static void expect_said(const ProgramRun& run, const std::string& text) {
    EXPECT_NE(run.errors.find(text), std::string::npos) << run.errors;
  }

  const std::string kRoom = source_directory() + "/scenes/caustic-room/scene.pbrt";
  const testing::TemporaryDirectory folder_;
};

TEST_F(CheckpointCommand, WhatIsResumedIsOneRun) {
  for (const std::string integrator : {"mixed", "sppm"}) {
    const auto passes = [&](const std::string& range) {
      return std::vector<std::string>{"--integrator", integrator, "--passes", range, "--resume"};
    };
    render(integrator + "-whole", passes("4"));
    render(integrator + "-parts", passes("1"));
    render(integrator + "-parts", passes("3"));
    render(integrator + "-parts", passes("4"));
    expect_same(integrator + "-whole", integrator + "-parts");
  }
}

TEST_F(CheckpointCommand, ResumingNamesAnEarlierPictureThatIsKept) {
  render("kept.previous", {"--passes", "1", "--quiet"});
  expect_said(render("kept", {"--passes", "1", "--resume", "--quiet"}),
              "; to go on from kept.previous.exr, stop, and give its files their old names");
}

TEST_F(CheckpointCommand, ResumingNothingIsSaid) {
  expect_said(render("new", {"--passes", "1", "--resume", "--quiet"}),
              "there is no new.exr yet, the render starts at its first pass");
  EXPECT_EQ(render("new", {"--passes", "2", "--resume", "--quiet"}).errors, "");
}

TEST_F(CheckpointCommand, ACropWithoutPixelsIsThatOfTheCommandLine) {
  expect_said(render("a", {"--crop", "0.34,0.35,0.1,0.2"}, kUsage),
              "--crop: the window contains no pixel of");
}

TEST_F(CheckpointCommand, WhatIsReplacedIsSaid) {
  const std::string said =
      "a.exr has passes 0..2 of this very render, with which --resume would go on; it is kept as "
      "a.previous.exr";
  EXPECT_EQ(render("a", {"--passes", "3"}).errors.find("is kept"), std::string::npos);
  expect_said(render("a", {"--passes", "1", "--quiet"}), said);
  render("a", {"--passes", "3", "--resume"});
  expect_said(render("a", {"--passes", "1", "--seed", "5"}),
              "a.exr has passes 0..2 of another render; it is kept as a.previous.exr, with "
              "a.previous.state and a.previous.png, in place of what was kept before");
  // A picture without a state keeps no older state.
  render("a", {"--passes", "1", "--no-state"});
  render("a", {"--passes", "1"});
  EXPECT_TRUE(std::filesystem::exists(folder_.path("a.previous.exr")));
  EXPECT_FALSE(std::filesystem::exists(folder_.path("a.previous.state")));
}

TEST_F(CheckpointCommand, MergingKeepsWhatItReplaces) {
  render("a", {"--passes", "0..0"});
  render("b", {"--passes", "1..1"});
  render("c", {"--passes", "3", "--seed", "7"});
  const ProgramRun merged = run_program(folder_.path(), {"merge", "a.exr", "b.exr", "-o", "c.exr"});
  EXPECT_EQ(merged.status, 0) << merged.errors;
  expect_said(merged, "c.exr has passes 0..2 of another render; it is kept as c.previous.exr");
  EXPECT_EQ(value_of(picture("c.previous").metadata, "nephroid:passes"), "0..2");
  EXPECT_EQ(value_of(picture("c").metadata, "nephroid:passes"), "0..1");
}

TEST_F(CheckpointCommand, WhatIsMergedIsOneRun) {
  render("whole", {"--passes", "4"});
  render("a", {"--passes", "0..0"});
  render("b", {"--passes", "1..2"});
  render("c", {"--passes", "3..3"});
  const ProgramRun merged =
      run_program(folder_.path(), {"merge", "c.exr", "a.exr", "b.exr", "-o", "sum.exr"});
  EXPECT_EQ(merged.status, 0) << merged.errors;
  expect_same("whole", "sum");
  EXPECT_EQ(value_of(picture("sum").metadata, "nephroid:passes"), "0..3");
}

TEST_F(CheckpointCommand, ATaskTakesWhatAnotherHasLearned) {
  const auto has_learned = [&](const std::string& name) {
    const std::string choices = value_of(picture(name).metadata, "nephroid:choices");
    EXPECT_NE(choices.find(" % to learn"), std::string::npos) << choices;
    return choices.find(" 0 % to learn") == std::string::npos;
  };
  const std::vector<std::string> task{"--passes", "1..2", "--float", "--quiet", "--resume"};
  render("a", {"--passes", "0..0"});
  render("alone", task);
  std::vector<std::string> taught = task;
  taught.insert(taught.end(), {"--learned-from", "a.exr"});
  EXPECT_EQ(render("b", taught).errors,
            "nephroid: warning: --resume: there is no b.exr yet, the render starts at its first "
            "pass\n");
  EXPECT_EQ(render("b", taught).errors, "");
  expect_same("alone", "b");
  EXPECT_TRUE(has_learned("alone"));
  EXPECT_FALSE(has_learned("b"));
  expect_said(render("c", {"--passes", "1", "--seed", "3", "--learned-from", "a.exr"}, kUsage),
              "cannot take what it has learned: it belongs to a different render");
  expect_said(render("c", {"--passes", "1", "--learned-from", ""}, kUsage),
              "--learned-from: '' is not valid, expected a picture");
  expect_said(render("c", {"--passes", "1", "--learned-from", "none.exr"}),
              "; this render learns by itself");
}

TEST_F(CheckpointCommand, AnotherRenderIsRefusedWithWhatDiffers) {
  render("a", {"--passes", "1"});
  expect_said(render("a", {"--passes", "2", "--resume", "--seed", "3"}, kUsage), "seed 0, here 3");
  expect_said(render("a", {"--passes", "2", "--resume", "-D", "max-depth=3"}, kUsage),
              "max-depth 32, here 3");
  expect_said(render("a", {"--passes", "2", "--resume", "--crop", "0,0.5,0,1"}, kUsage),
              "film 24x16, columns 0 to 24, rows 0 to 16, here 24x16, columns 0 to 12");
  SceneFolder other;
  other.render({"--passes", "1"});
  other.write("scene.pbrt", kHead + kTriangle + "# the same to look at, another file\n");
  expect_said(other.render({"--passes", "2", "--resume"}), "the scene, or a file that it reads");
}

TEST_F(CheckpointCommand, NoStateLeavesAPictureAlone) {
  render("a", {"--passes", "1", "--no-state"});
  expect_said(render("a", {"--passes", "2", "--resume"}, kInputOutput), "there is no a.state");
}

TEST_F(CheckpointCommand, ANoiseTargetThatIsMetIsMet) {
  const std::vector<std::string> line{"--integrator", "path", "--noise", "0.5", "--resume"};
  render("a", line);
  const Picture first = picture("a");
  render("a", line);
  EXPECT_EQ(value_of(picture("a").metadata, "nephroid:passes"),
            value_of(first.metadata, "nephroid:passes"));
  EXPECT_TRUE(picture("a").pixels == first.pixels);
}

TEST_F(CheckpointCommand, WhatIsNotFiniteIsSaidAndStrictAboutIt) {
  // The light is finite, but the film's sensitivity makes it overflow.
  const SceneFolder folder(
      "Film \"rgb\" \"integer xresolution\" 8 \"integer yresolution\" 8 \"float iso\" 1e30\n"
      "LookAt 0 0 -3  0 0 0  0 1 0\nCamera \"perspective\"\nWorldBegin\n"
      "LightSource \"point\" \"rgb I\" [1e25 1e25 1e25] \"point3 from\" [0 0 -3]\n" +
      kTriangle);
  for (const char* integrator : {"path", "mixed", "sppm"}) {
    const std::vector<std::string> line{"--passes", "2", "--integrator", integrator};
    const ProgramRun plain = folder.render(line);
    EXPECT_EQ(plain.status, 0) << plain.errors;
    expect_said(plain, "were not finite and were left out");
    std::vector<std::string> strict = line;
    strict.push_back("--strict");
    EXPECT_EQ(folder.render(strict).status, 1) << integrator;
  }
}

TEST_F(CheckpointCommand, ALogOnAFullDiskEndsNothing) {
  const auto status = [&](const std::string& log) {
    const std::string line = "cd '" + folder_.path() + "' && '" NEPHROID_PROGRAM "' render '" +
                             kRoom + "' --resolution 24x16 --passes 2 -o a.exr 2>" + log;
    const int result = std::system(line.c_str());
    return WIFEXITED(result) ? WEXITSTATUS(result) : -1;
  };
  EXPECT_EQ(status("/dev/full"), 0);
  EXPECT_EQ(status("&-"), 0);
  EXPECT_EQ(picture("a").width(), 24);
}

}  // namespace
}  // namespace nephroid::testing_support
