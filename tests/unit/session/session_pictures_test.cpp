// Pictures that the render loop writes at the end, periodically and on demand: their metadata, and
// errors in writing them.
#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/errors.h"
#include "film/state_file.h"
#include "session/report/choices_report.h"
#include "unit/film/scratch_directory.h"
#include "unit/session/scripted_session.h"

namespace nephroid {
namespace {

using SessionPictures = testing_support::ScriptedSession;

/// The passes in the metadata of a picture, "" if there is none.
std::string passes_in(const std::string& path) {
  if (!std::filesystem::exists(path)) return "";
  return value_of(read_picture(path).metadata, "nephroid:passes");
}

std::string contents(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

/// A render whose picture goes to the directory, written before the end only on demand.
RenderOptions options_in(const ScratchDirectory& directory) {
  RenderOptions options;
  options.output = directory.file("out.exr");
  options.checkpoint_interval = 1e9;
  return options;
}

TEST_F(SessionPictures, IntermediatePicturesAreWrittenNowAndThen) {
  const ScratchDirectory directory;
  RenderOptions options = options_in(directory);
  options.checkpoint_interval = 3;
  options.last_pass = 7;
  std::vector<std::string> seen;
  script_.during_pass = [&](const PassKey&) { seen.push_back(passes_in(options.output)); };
  run(options);
  // Pass i ends at i + 1 seconds. For the scripted clock, writing costs nothing.
  EXPECT_EQ(seen, (std::vector<std::string>{"", "", "", "0..2", "0..2", "0..2", "0..5", "0..5"}));
  EXPECT_EQ(passes_in(options.output), "0..7");
}

// Between checkpoints the PNG shows the progress.
TEST_F(SessionPictures, PreviewsAreMoreFrequent) {
  const ScratchDirectory directory;
  RenderOptions options = options_in(directory);
  options.preview_interval = 2;
  options.checkpoint_interval = 5;
  options.last_pass = 7;
  std::vector<std::pair<bool, bool>> seen;
  script_.during_pass = [&](const PassKey&) {
    const std::string png = directory.file("out.png");
    seen.emplace_back(std::filesystem::exists(options.output), std::filesystem::exists(png));
    std::filesystem::remove(png);
  };
  run(options);
  // Pass i ends at i + 1 seconds. The first preview comes at once, others at 3 and 7 seconds, a
  // checkpoint with its own preview at 5.
  const std::vector<std::pair<bool, bool>> wanted = {{false, false}, {false, true},  {false, false},
                                                     {false, true},  {false, false}, {true, true},
                                                     {true, false},  {true, true}};
  EXPECT_EQ(seen, wanted);
}

// Passes of earlier runs are not rendered again, in any ranges, and their time counts.
TEST_F(SessionPictures, GoesOnWhereEarlierRunsWere) {
  const ScratchDirectory directory;
  RenderOptions options = options_in(directory);
  options.last_pass = 9;
  options.begin_with.passes = *PassRanges::parse("0..2,5..6");
  options.begin_with.seconds = 100;
  options.begin_with.history = "5 passes in 100.000 s\n";
  RenderResult result = run(options);
  std::vector<uint32_t> rendered;
  for (const PassKey& key : script_.passes) rendered.push_back(key.pass);
  EXPECT_EQ(rendered, (std::vector<uint32_t>{3, 4, 7, 8, 9}));
  EXPECT_EQ(result.passes_of_run, 5u);
  EXPECT_EQ(result.passes_done, 10u);
  EXPECT_EQ(passes_in(options.output), "0..9");
  // All passes exist: nothing is rendered, but the picture is still written.
  script_.passes.clear();
  std::filesystem::remove(options.output);
  options.begin_with.passes = *PassRanges::parse("0..9");
  options.begin_with.choices = "what the earlier runs chose\n";
  result = run(options);
  EXPECT_EQ(value_of(read_picture(options.output).metadata, "nephroid:choices"),
            options.begin_with.choices);
  EXPECT_EQ(result.passes_of_run, 0u);
  EXPECT_TRUE(script_.passes.empty());
  EXPECT_EQ(passes_in(options.output), "0..9");
  // A pass that earlier runs began, but that this one does not want, changes nothing.
  options.begin_with.open_pass = 12;
  run(options);
  const Metadata metadata = read_picture(options.output).metadata;
  EXPECT_EQ(value_of(metadata, "nephroid:choices"), options.begin_with.choices);
  EXPECT_EQ(value_of(metadata, "nephroid:history"), options.begin_with.history);
  EXPECT_EQ(value_of(metadata, "nephroid:seconds"), "100.000");
  options.begin_with.open_pass.reset();
  // Three more seconds are three more passes.
  options.last_pass.reset();
  options.time_limit = 103;
  EXPECT_EQ(run(options).passes_of_run, 3u);
  options.begin_with.seconds = 100;
  options.time_limit = 100;
  EXPECT_EQ(run(options).passes_of_run, 0u);
  // Dependent passes cannot fill a gap.
  script_.descriptor.capabilities.independent_passes = false;
  options.begin_with.passes = *PassRanges::parse("0..2,5..6");
  EXPECT_THROW(run(options), UsageError);
}

// Only the final picture lacks a state: earlier ones may be needed to resume.
TEST_F(SessionPictures, OnlyTheLastPictureIsLeftWithoutState) {
  const ScratchDirectory directory;
  RenderOptions options = options_in(directory);
  options.keeps_state = false;
  options.checkpoint_interval = 2;
  options.last_pass = 3;
  const auto has_state = [&] { return std::filesystem::exists(directory.file("out.state")); };
  script_.during_pass = [&](const PassKey& key) {
    if (key.pass >= 2) {
      EXPECT_TRUE(has_state());
    }
  };
  run(options);
  EXPECT_FALSE(has_state());
  script_.during_pass = [&](const PassKey& key) {
    if (key.pass == 1) signals_.stop = SIGTERM;
  };
  EXPECT_EQ(run(options).reason, StopReason::kSignal);
  EXPECT_TRUE(has_state());
}

// One older version is kept of another render's files.
TEST_F(SessionPictures, PictureAndStateOfAnotherRenderAreKept) {
  const ScratchDirectory directory;
  RenderOptions options = options_in(directory);
  const std::string kept = directory.file("out.previous.exr");
  const std::string kept_png = directory.file("out.previous.png");
  options.last_pass = 3;
  run(options);
  EXPECT_FALSE(std::filesystem::exists(kept));
  const std::string png = contents(directory.file("out.png"));
  options.last_pass = 1;
  options.checkpoint_interval = 1;
  run(options);
  EXPECT_EQ(passes_in(kept), "0..3") << "not the intermediate picture of the second render";
  EXPECT_EQ(passes_in(options.output), "0..1");
  EXPECT_EQ(passes_of(open_state(kept, "read it"), "read it").text(), "0..3");
  EXPECT_EQ(contents(kept_png), png) << "not an intermediate one";
  options.begin_with.passes = *PassRanges::parse("0..1");
  options.last_pass = 2;
  run(options);
  EXPECT_EQ(passes_in(kept), "0..3") << "who goes on replaces only what it goes on from";
}

// Also a picture without a state, or one of another program.
TEST_F(SessionPictures, WhatHasNoStateIsKeptToo) {
  const ScratchDirectory directory;
  RenderOptions options = options_in(directory);
  options.last_pass = 0;
  std::ofstream(directory.file("out.exr")) << "somebody's picture";
  std::ofstream(directory.file("out.png")) << "its PNG";
  run(options);
  EXPECT_EQ(contents(directory.file("out.previous.exr")), "somebody's picture");
  EXPECT_EQ(contents(directory.file("out.previous.png")), "its PNG");
  EXPECT_EQ(passes_in(options.output), "0..0");
}

// A render that ends before its first picture leaves a PNG, which must not replace an older one.
TEST_F(SessionPictures, APngAloneReplacesNoKeptOne) {
  const ScratchDirectory directory;
  const std::string output = directory.file("out.exr");
  std::ofstream(directory.file("out.png")) << "PNG";
  ASSERT_EQ(files_to_keep(output).size(), 1u);
  EXPECT_EQ(files_to_keep(output)[0].kept, directory.file("out.previous.png"));
  std::ofstream(directory.file("out.previous.png")) << "older PNG";
  EXPECT_TRUE(files_to_keep(output).empty());
}

TEST_F(SessionPictures, PictureOnDemand) {
  const ScratchDirectory directory;
  RenderOptions options = options_in(directory);
  std::vector<std::string> seen;
  script_.during_pass = [&](const PassKey& key) {
    seen.push_back(passes_in(options.output));
    if (key.pass == 1) signals_.write = true;
  };
  options.last_pass = 3;
  EXPECT_EQ(run(options).reason, StopReason::kPasses);
  EXPECT_EQ(seen, (std::vector<std::string>{"", "", "0..1", "0..1"}));
  EXPECT_FALSE(signals_.write);
}

TEST_F(SessionPictures, WritingStretchesItsIntervalToItsCost) {
  const ScratchDirectory directory;
  RenderOptions options = options_in(directory);
  options.checkpoint_interval = 1;
  options.last_pass = 999;
  // Each write takes two seconds. Writes become rarer, so that they take a small share of the time,
  // although the interval has passed.
  script_.pass_seconds = 0.5;
  int writes = 0;
  std::filesystem::file_time_type last{};
  RenderSession session(scene_, set_, *film_, options);
  session.use_clock([&] {
    const bool exists = std::filesystem::exists(options.output);
    const auto time = exists ? std::filesystem::last_write_time(options.output)
                             : std::filesystem::file_time_type{};
    if (time != last) {
      // A picture has just been written: let it take two seconds.
      last = time;
      ++writes;
      script_.now += 2;
    }
    return script_.now;
  });
  const RenderResult result = session.run(signals_);
  EXPECT_GE(writes, 3);
  EXPECT_LE(2.0 * writes, 0.02 * result.seconds + 4);
}

TEST_F(SessionPictures, FailedIntermediatePictureIsAWarning) {
  const ScratchDirectory directory;
  RenderOptions options = options_in(directory);
  script_.during_pass = [&](const PassKey& key) {
    // A directory takes the picture's place during one pass.
    if (key.pass == 1) {
      std::filesystem::create_directory(options.output);
      signals_.write = true;
    }
    if (key.pass == 2) std::filesystem::remove(options.output);
  };
  options.last_pass = 3;
  EXPECT_EQ(run(options).passes_done, 4u);
  ASSERT_EQ(warnings_.size(), 1u);
  EXPECT_NE(warnings_[0].find("it is a directory"), std::string::npos);
  EXPECT_EQ(passes_in(options.output), "0..3");
}

TEST_F(SessionPictures, FailedLastPictureIsAnError) {
  const ScratchDirectory directory;
  RenderOptions options = options_in(directory);
  script_.during_pass = [&](const PassKey& key) {
    if (key.pass == 5) std::filesystem::create_directory(options.output);
  };
  EXPECT_THROW(run(options), IoError);
}

/// The message of the IoError, "" if there is none.
template <class F>
std::string io_error_of(F&& f) {
  try {
    f();
  } catch (const IoError& error) {
    return error.what();
  }
  return "";
}

TEST_F(SessionPictures, TheLastPictureIsRescuedWhereItsDirectoryVanished) {
  const ScratchDirectory directory, elsewhere;
  std::filesystem::create_directory(directory.file("pictures"));
  RenderOptions options;
  options.output = directory.file("pictures/out.exr");
  options.checkpoint_interval = 2;
  options.rescue_directory = elsewhere.path().string();
  script_.during_pass = [&](const PassKey& key) {
    if (key.pass == 1) std::filesystem::remove_all(directory.file("pictures"));
  };
  const std::string message = io_error_of([&] { run(options); });
  const size_t said = message.find("the picture was written to ");
  ASSERT_NE(said, std::string::npos) << message;
  EXPECT_EQ(message.find(state_path_beside(options.output)), 0u) << message;
  EXPECT_EQ(passes_in(message.substr(said + 27)), "0..5");
  EXPECT_EQ(script_.passes.size(), 6u);  // rendering went on
  EXPECT_FALSE(warnings_.empty());
}

TEST_F(SessionPictures, WhatCannotBeRescuedIsTheFirstError) {
  const ScratchDirectory directory;
  std::filesystem::create_directory(directory.file("pictures"));
  RenderOptions options;
  options.output = directory.file("pictures/out.exr");
  options.rescue_directory = directory.file("nowhere");
  script_.during_pass = [&](const PassKey&) {
    std::filesystem::remove_all(directory.file("pictures"));
  };
  const std::string message = io_error_of([&] { run(options); });
  EXPECT_EQ(message.find(state_path_beside(options.output)), 0u) << message;
  EXPECT_EQ(message.find("the picture was written to"), std::string::npos);
}

TEST_F(SessionPictures, UnwritableOutputIsSaidBeforeTheFirstPass) {
  const ScratchDirectory directory;
  RenderOptions options;
  options.output = directory.file("nowhere/out.exr");
  EXPECT_THROW(run(options), IoError);
  options.output = directory.path().string();
  EXPECT_THROW(run(options), IoError);
  std::filesystem::create_directory(directory.file("taken.png"));
  options.output = directory.file("taken.exr");
  EXPECT_THROW(run(options), IoError);
  EXPECT_TRUE(script_.passes.empty());
}

TEST_F(SessionPictures, MetadataOfTheCallerAndTheSession) {
  const ScratchDirectory directory;
  RenderOptions options = options_in(directory);
  options.seed = 77;
  options.identity.scene_hash = "abc";
  run(options);
  const Metadata metadata = read_picture(options.output).metadata;
  const auto has = [&](const std::string& key, const std::string& value) {
    return std::find(metadata.begin(), metadata.end(), std::pair(key, value)) != metadata.end();
  };
  EXPECT_TRUE(has("nephroid:scene_hash", "abc"));
  EXPECT_TRUE(has("nephroid:seed", "77"));
  EXPECT_TRUE(has("nephroid:passes", "0..5"));
  EXPECT_TRUE(has("nephroid:seconds", "6.000"));
  EXPECT_TRUE(has("nephroid:history", "6 passes in 6.000 s\n"));
  EXPECT_TRUE(has("nephroid:estimates:diffuse", "6"));
  EXPECT_TRUE(has("nephroid:choices",
                  "photons: 50 paths per pass, 60 photons kept in all, 10 % of paths kept any\n"
                  "merge radius: 8 pixels in the first pass to 1.33 in the last\n"
                  "rays: 80 % of camera paths, 20 % of light paths, 0 % to learn\n" +
                      *error_report(*film_) + "\n"));
  EXPECT_TRUE(std::filesystem::exists(directory.file("out.png")));
}

TEST_F(SessionPictures, RoutesOfOneGroupHaveItsEstimates) {
  const ScratchDirectory directory;
  set_.layout.routes = {"diffuse", "none", "caustic"};
  set_.layout.groups = {0, 1, 0};  // no estimator renders group 1
  film_ = std::make_unique<Film>(film_->settings(), set_.layout);
  const RenderOptions options = options_in(directory);
  run(options);
  const Metadata metadata = read_picture(options.output).metadata;
  const auto estimates = [&](const std::string& route) {
    return value_of(metadata, "nephroid:estimates:" + route);
  };
  EXPECT_EQ(estimates("diffuse"), "6");
  EXPECT_EQ(estimates("caustic"), "6");
  EXPECT_EQ(estimates("none"), "0");
}

}  // namespace
}  // namespace nephroid
