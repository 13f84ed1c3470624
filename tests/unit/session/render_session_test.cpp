// The loop, driven by an estimator that does what the test says and a clock that the test turns.
#include "session/render_session.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "core/errors.h"
#include "scene/scene.h"
#include "session/noise.h"
#include "unit/film/one_part.h"
#include "unit/film/scratch_directory.h"

namespace nephroid {
namespace {

using testing_support::add_one;

/// Everything that a fake pass may do, shared between test and estimator.
struct Script {
  double now = 0;
  double pass_seconds = 1;
  std::vector<PassKey> passes;                      ///< that were rendered
  std::function<void(const PassKey&)> during_pass;  ///< called in each
  Capabilities capabilities;
};

class FakeEstimator : public Estimator {
 public:
  FakeEstimator(Script& script, int group) : script_(script), group_(group) {}
  Capabilities capabilities() const override { return script_.capabilities; }
  void render_pass(const PassKey& key, const Scene&, Film& film) override {
    script_.now += script_.pass_seconds;
    script_.passes.push_back(key);
    if (script_.during_pass) script_.during_pass(key);
    // 0, 2, 0, 2 ...: mean 1 and deviation 1 in every pixel.
    const float value = key.pass % 2 == 0 ? 0.0f : 2.0f;
    for (int y = film.bounds().y0; y < film.bounds().y1; ++y)
      for (int x = film.bounds().x0; x < film.bounds().x1; ++x)
        add_one(film, group_, x, y, {value, value, value});
    film.add_estimates(group_, 1);
    statistics_.rays += 100;
    statistics_.photons_stored += 10;
    statistics_.radius_max_pixels = 8.0f / static_cast<float>(key.pass + 1);
  }
  EstimatorStatistics statistics() const override { return statistics_; }

 private:
  Script& script_;
  int group_;
  EstimatorStatistics statistics_;
};

class RenderSessionTest : public testing::Test {
 protected:
  RenderSessionTest() {
    preset_.layout = FilmLayout::of_routes({"diffuse"});
    preset_.estimators.push_back(std::make_unique<FakeEstimator>(script_, 0));
    FilmSettings settings;
    settings.width = 5;
    settings.height = 3;
    film_ = std::make_unique<Film>(settings, preset_.layout);
    scene_.samples_per_pixel = 6;
  }
  RenderResult run(const RenderOptions& options) {
    RenderSession session(scene_, preset_, *film_, options);
    session.use_clock([this] { return script_.now; });
    session.on_progress([this](const RenderProgress& progress) { progress_.push_back(progress); });
    session.on_warning([this](const std::string& warning) { warnings_.push_back(warning); });
    return session.run(signals_);
  }

  Script script_;
  Preset preset_;
  Scene scene_;
  std::unique_ptr<Film> film_;
  SignalFlags signals_;
  std::vector<RenderProgress> progress_;
  std::vector<std::string> warnings_;
};

TEST_F(RenderSessionTest, WithoutARuleItRendersTheScenesSamples) {
  RenderOptions options;
  options.seed = 42;
  const RenderResult result = run(options);
  EXPECT_EQ(result.reason, StopReason::kPasses);
  EXPECT_EQ(result.passes_done, 6u);
  EXPECT_EQ(result.seconds, 6);
  ASSERT_EQ(script_.passes.size(), 6u);
  for (uint32_t i = 0; i < 6; ++i) {
    EXPECT_EQ(script_.passes[i].pass, i);
    EXPECT_EQ(script_.passes[i].seed, 42u);
  }
  EXPECT_EQ(film_->estimates(0), 6u);
  EXPECT_EQ(result.statistics[0].rays, 600u);
  EXPECT_EQ(result.first_pass_statistics[0].radius_max_pixels, 8.0f);
}

TEST_F(RenderSessionTest, RangeOfPasses) {
  RenderOptions options;
  options.first_pass = 3;
  options.last_pass = 5;
  EXPECT_EQ(run(options).passes_done, 3u);
  EXPECT_EQ(script_.passes.front().pass, 3u);
  EXPECT_EQ(script_.passes.back().pass, 5u);
}

TEST_F(RenderSessionTest, RangeNeedsIndependentPasses) {
  script_.capabilities.independent_passes = false;
  RenderOptions options;
  options.first_pass = 3;
  options.last_pass = 5;
  EXPECT_THROW(run(options), UsageError);
  options.first_pass = 0;
  EXPECT_EQ(run(options).passes_done, 6u);
}

TEST_F(RenderSessionTest, LayersOfOneNameAreRefused) {
  for (const char* name : {"diffuse", "albedo"}) {
    preset_.layout.aovs = {name};
    try {
      run({});
      FAIL() << name;
    } catch (const UsageError& error) {
      EXPECT_NE(std::string(error.what()).find(std::string("called \"") + name), std::string::npos);
    }
  }
  EXPECT_TRUE(script_.passes.empty());
}

TEST_F(RenderSessionTest, EveryEstimatorRendersEveryPassInOrder) {
  Script second;
  preset_.layout = FilmLayout::of_routes({"diffuse", "caustic"});
  preset_.estimators.push_back(std::make_unique<FakeEstimator>(second, 1));
  film_ = std::make_unique<Film>(film_->settings(), preset_.layout);
  std::vector<std::string> order;
  script_.during_pass = [&](const PassKey& key) {
    order.push_back("a" + std::to_string(key.pass));
  };
  second.during_pass = [&](const PassKey& key) { order.push_back("b" + std::to_string(key.pass)); };
  RenderOptions options;
  options.last_pass = 1;
  const RenderResult result = run(options);
  EXPECT_EQ(order, (std::vector<std::string>{"a0", "b0", "a1", "b1"}));
  EXPECT_EQ(result.statistics.size(), 2u);
}

TEST_F(RenderSessionTest, TimeLimitStopsAtTheNearestPass) {
  RenderOptions options;
  script_.pass_seconds = 1;
  options.time_limit = 10.4;  // 10 is nearer than 11
  const RenderResult result = run(options);
  EXPECT_EQ(result.reason, StopReason::kTime);
  EXPECT_EQ(result.passes_done, 10u);
}

TEST_F(RenderSessionTest, TimeLimitBelowOnePassRendersOne) {
  RenderOptions options;
  options.time_limit = 0.01;
  EXPECT_EQ(run(options).passes_done, 1u);
}

TEST_F(RenderSessionTest, FirstRuleMetWins) {
  RenderOptions options;
  options.time_limit = 100;
  options.last_pass = 3;
  EXPECT_EQ(run(options).reason, StopReason::kPasses);
  script_.passes.clear();
  options.time_limit = 2;
  EXPECT_EQ(run(options).reason, StopReason::kTime);
  EXPECT_EQ(script_.passes.size(), 2u);
}

TEST_F(RenderSessionTest, NoiseTargetStopsWhereTheErrorHasFallenToIt) {
  // Even n: value 1, stderr 1/sqrt(n-1); relative 1/sqrt((n-1) * 1.01). At most 0.2 from n = 25.75.
  RenderOptions options;
  options.noise_target = 0.2;
  const RenderResult result = run(options);
  EXPECT_EQ(result.reason, StopReason::kNoise);
  EXPECT_EQ(result.passes_done, 26u);
  ASSERT_TRUE(result.noise.has_value());
  EXPECT_NEAR(*result.noise, 1 / std::sqrt(25 * 1.01), 1e-6);
}

TEST_F(RenderSessionTest, NoiseTargetDoesNotDependOnTheClock) {
  RenderOptions options;
  options.noise_target = 0.1;
  const uint32_t slow = run(options).passes_done;
  film_ = std::make_unique<Film>(film_->settings(), preset_.layout);
  script_.pass_seconds = 1e-4;
  EXPECT_EQ(run(options).passes_done, slow);
}

TEST_F(RenderSessionTest, NoiseTargetIsRefusedWithoutAnErrorEstimate) {
  script_.capabilities.per_pixel_state = true;
  RenderOptions options;
  options.noise_target = 0.1;
  EXPECT_THROW(run(options), UsageError);
}

TEST_F(RenderSessionTest, SignalStopsAfterThePassAndWrites) {
  const ScratchDirectory directory;
  RenderOptions options;
  options.output = directory.file("out.exr");
  script_.during_pass = [&](const PassKey& key) {
    if (key.pass == 2) signals_.stop = 15;
  };
  const RenderResult result = run(options);
  EXPECT_EQ(result.reason, StopReason::kSignal);
  EXPECT_EQ(result.signal, 15);
  EXPECT_EQ(result.passes_done, 3u);
  const Picture picture = read_picture(options.output);
  EXPECT_EQ(picture.pixels[static_cast<size_t>(picture.find_channel("samples"))], 3.0f);
}

TEST_F(RenderSessionTest, SignalInTheLastPassComesTooLate) {
  script_.during_pass = [&](const PassKey& key) {
    if (key.pass == 5) signals_.stop = 2;
  };
  EXPECT_EQ(run({}).reason, StopReason::kPasses);
}

/// The passes in the metadata of a picture, "" if there is none.
std::string passes_in(const std::string& path) {
  if (!std::filesystem::exists(path)) return "";
  for (const auto& [key, value] : read_picture(path).metadata)
    if (key == "nephroid:passes") return value;
  return "no such key";
}

TEST_F(RenderSessionTest, IntermediatePicturesAreWrittenNowAndThen) {
  const ScratchDirectory directory;
  RenderOptions options;
  options.output = directory.file("out.exr");
  options.write_interval = 3;
  options.last_pass = 7;
  std::vector<std::string> seen;
  script_.during_pass = [&](const PassKey&) { seen.push_back(passes_in(options.output)); };
  run(options);
  // Pass i ends at i + 1 seconds; the fake clock says that writing costs nothing.
  EXPECT_EQ(seen, (std::vector<std::string>{"", "", "", "0..2", "0..2", "0..2", "0..5", "0..5"}));
  EXPECT_EQ(passes_in(options.output), "0..7");
}

TEST_F(RenderSessionTest, PictureOnDemand) {
  const ScratchDirectory directory;
  RenderOptions options;
  options.output = directory.file("out.exr");
  options.write_interval = 1e9;
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

TEST_F(RenderSessionTest, WritingStretchesItsIntervalToItsCost) {
  const ScratchDirectory directory;
  RenderOptions options;
  options.output = directory.file("out.exr");
  options.write_interval = 1;
  options.last_pass = 999;
  // The clock moves by a millisecond at each look: a write costs at least that, so that writes are
  // at least 50 of them apart although the interval has passed long ago.
  script_.pass_seconds = 0.5;
  int writes = 0;
  std::filesystem::file_time_type last{};
  RenderSession session(scene_, preset_, *film_, options);
  session.use_clock([&] {
    const bool exists = std::filesystem::exists(options.output);
    const auto time = exists ? std::filesystem::last_write_time(options.output)
                             : std::filesystem::file_time_type{};
    if (time != last) {
      // A picture has just been written: let it have taken two seconds.
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

TEST_F(RenderSessionTest, FailedIntermediatePictureIsAWarning) {
  const ScratchDirectory directory;
  RenderOptions options;
  options.output = directory.file("out.exr");
  options.write_interval = 1e9;
  script_.during_pass = [&](const PassKey& key) {
    // Somebody puts a directory in the picture's place for the time of one pass.
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

TEST_F(RenderSessionTest, FailedLastPictureIsAnError) {
  const ScratchDirectory directory;
  RenderOptions options;
  options.output = directory.file("out.exr");
  options.write_interval = 1e9;
  script_.during_pass = [&](const PassKey& key) {
    if (key.pass == 5) std::filesystem::create_directory(options.output);
  };
  EXPECT_THROW(run(options), IoError);
}

TEST_F(RenderSessionTest, UnwritableOutputIsSaidBeforeTheFirstPass) {
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

TEST_F(RenderSessionTest, ProgressCountsAndForetells) {
  RenderOptions options;
  options.last_pass = 9;
  options.time_limit = 8.4;
  run(options);
  ASSERT_EQ(progress_.size(), 8u);
  const RenderProgress& p = progress_[3];
  EXPECT_EQ(p.passes_done, 4u);
  EXPECT_EQ(*p.passes_wanted, 10u);
  EXPECT_EQ(p.seconds, 4);
  EXPECT_NEAR(*p.seconds_left, 4.4, 1e-12);  // time is shorter than the six passes left
  EXPECT_NEAR(p.fraction, 4 / 8.4, 1e-12);
  EXPECT_EQ(p.rays, 400u);
  EXPECT_EQ(p.photons_stored, 40u);
  EXPECT_TRUE(p.noise.has_value());
}

TEST_F(RenderSessionTest, MetadataOfTheCallerAndTheSession) {
  const ScratchDirectory directory;
  RenderOptions options;
  options.output = directory.file("out.exr");
  options.seed = 77;
  options.metadata = {{"nephroid:scene_hash", "abc"}};
  run(options);
  const Metadata metadata = read_picture(options.output).metadata;
  const auto has = [&](const std::string& key, const std::string& value) {
    return std::find(metadata.begin(), metadata.end(), std::pair(key, value)) != metadata.end();
  };
  EXPECT_TRUE(has("nephroid:scene_hash", "abc"));
  EXPECT_TRUE(has("nephroid:seed", "77"));
  EXPECT_TRUE(has("nephroid:passes", "0..5"));
  EXPECT_TRUE(has("nephroid:seconds", "6.000"));
  EXPECT_TRUE(has("nephroid:estimates:diffuse", "6"));
  EXPECT_TRUE(std::filesystem::exists(directory.file("out.png")));
}

TEST_F(RenderSessionTest, RoutesOfOneGroupHaveItsEstimates) {
  const ScratchDirectory directory;
  preset_.layout.routes = {"diffuse", "none", "caustic"};
  preset_.layout.groups = {0, 1, 0};  // nobody renders group 1
  film_ = std::make_unique<Film>(film_->settings(), preset_.layout);
  RenderOptions options;
  options.output = directory.file("out.exr");
  run(options);
  const Metadata metadata = read_picture(options.output).metadata;
  const auto estimates = [&](const std::string& route) {
    for (const auto& [key, value] : metadata)
      if (key == "nephroid:estimates:" + route) return value;
    return std::string("absent");
  };
  EXPECT_EQ(estimates("diffuse"), "6");
  EXPECT_EQ(estimates("caustic"), "6");
  EXPECT_EQ(estimates("none"), "0");
}

TEST(Noise, NeedsTwoEstimatesOfEveryGroup) {
  FilmSettings settings;
  settings.width = settings.height = 2;
  Film film(settings, FilmLayout::of_routes({"a", "b"}));
  film.add_estimates(0, 5);
  film.add_estimates(1, 1);
  EXPECT_FALSE(estimated_noise(film).has_value());
  film.add_estimates(1, 1);
  EXPECT_EQ(*estimated_noise(film), 0.0);
}

TEST(Noise, SharesOfRoutes) {
  FilmSettings settings;
  settings.width = settings.height = 2;
  Film film(settings, FilmLayout::of_routes({"a", "b"}));
  EXPECT_EQ(energy_shares(film).routes, (std::vector<double>{0, 0}));
  add_one(film, 0, 0, 0, {2, 0, 0});
  add_one(film, 1, 1, 1, {3, 6, 0});
  film.add_estimates(0, 2);  // means 1 and 3
  film.add_estimates(1, 3);
  const auto shares = energy_shares(film).routes;
  EXPECT_NEAR(shares[0], 0.25, 1e-7);
  EXPECT_NEAR(shares[1], 0.75, 1e-7);
}

}  // namespace
}  // namespace nephroid
