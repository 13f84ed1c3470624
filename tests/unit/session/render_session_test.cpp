// The render loop, with a scripted estimator and a scripted clock: which passes are rendered, when
// it stops, and its progress reports.
#include <cmath>

#include "core/errors.h"
#include "unit/film/scratch_directory.h"
#include "unit/session/scripted_session.h"

namespace nephroid {
namespace {

using testing_support::add_one, testing_support::Script, testing_support::FakeEstimator;
using RenderSessionTest = testing_support::ScriptedSession;

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
  script_.descriptor.capabilities.independent_passes = false;
  RenderOptions options;
  options.first_pass = 3;
  options.last_pass = 5;
  EXPECT_THROW(run(options), UsageError);
  options.first_pass = 0;
  EXPECT_EQ(run(options).passes_done, 6u);
}

TEST_F(RenderSessionTest, RejectionNeedsARangeFromZero) {
  film_->reject_outliers({{1.0f}, 8});
  RenderOptions options;
  options.first_pass = 3;
  options.last_pass = 5;
  EXPECT_THROW(run(options), UsageError);
  options.first_pass = 0;
  EXPECT_EQ(run(options).passes_done, 6u);
}

TEST_F(RenderSessionTest, OutliersAreJudgedAfterEveryPass) {
  film_->reject_outliers({{1.0f}, 8});
  RenderOptions options;
  options.last_pass = 3;
  std::vector<uint64_t> held;
  script_.during_pass = [&](const PassKey&) {
    held.push_back(film_->rejection()->held_estimates());
    add_one(*film_, 0, 2, 1, {1000, 1000, 1000});
    add_one(*film_, 0, 2, 1, {1000, 1000, 1000});
  };
  run(options);
  EXPECT_EQ(held, (std::vector<uint64_t>{0, 2, 4, 6}));
  EXPECT_EQ(film_->rejection()->held_estimates(), 0u);  // the eighth confirmed them
}

TEST_F(RenderSessionTest, EveryEstimatorRendersEveryPassInOrder) {
  Script second;
  set_.layout = FilmLayout::of_routes({"diffuse", "caustic"});
  set_.estimators.push_back(std::make_unique<FakeEstimator>(second, 1));
  film_ = std::make_unique<Film>(film_->settings(), set_.layout);
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

TEST_F(RenderSessionTest, TimeLimitEndsAPass) {
  RenderOptions options;
  script_.pass_seconds = 1;
  script_.looks = 8;
  options.time_limit = 10.4;
  const RenderResult result = run(options);
  EXPECT_EQ(result.reason, StopReason::kTime);
  EXPECT_EQ(result.passes_done, 10u);
  EXPECT_EQ(result.seconds, 10.5);  // at the next check
}

TEST_F(RenderSessionTest, TimeLimitBelowOnePassRendersOne) {
  RenderOptions options;
  script_.looks = 8;
  options.time_limit = 0.01;
  const RenderResult result = run(options);
  EXPECT_EQ(result.passes_done, 1u);
  EXPECT_EQ(result.seconds, 1);
}

TEST_F(RenderSessionTest, ASignalEndsAPass) {
  script_.looks = 8;
  script_.during_look = [&](const PassKey& key, int look) {
    if (key.pass == 2 && look == 3) signals_.stop = 15;
  };
  const RenderResult result = run({});
  EXPECT_EQ(result.reason, StopReason::kSignal);
  EXPECT_EQ(result.passes_done, 2u);
  EXPECT_EQ(result.seconds, 2.5);
}

TEST_F(RenderSessionTest, ASignalBeforeThereIsLightWritesNothing) {
  const ScratchDirectory directory;
  RenderOptions options;
  options.output = directory.file("out.exr");
  script_.looks = 8;
  signals_.stop = 2;
  const RenderResult result = run(options);
  EXPECT_EQ(result.reason, StopReason::kSignal);
  EXPECT_EQ(result.passes_done, 0u);
  EXPECT_FALSE(std::filesystem::exists(options.output));
}

TEST_F(RenderSessionTest, APassThatWasBegunIsGoneOnWith) {
  RenderOptions options;
  options.begin_with.passes = *PassRanges::parse("0..1");
  options.begin_with.open_pass = 2;
  options.last_pass = 3;
  EXPECT_EQ(run(options).passes_done, 4u);
  EXPECT_EQ(script_.passes[0].pass, 2u);
  // The requested pass exists; the open pass beyond it stays as it is.
  options.last_pass = 1;
  EXPECT_EQ(run(options).passes_of_run, 0u);
  // Only a single pass at a time.
  options.begin_with.passes = *PassRanges::parse("0..0");
  EXPECT_THROW(run(options), UsageError);
}

TEST_F(RenderSessionTest, APassThatWasBegunStaysAsItIsAtTheTimeLimit) {
  RenderOptions options;
  options.begin_with.passes = *PassRanges::parse("0..1");
  options.begin_with.open_pass = 2;
  options.begin_with.seconds = 100;
  options.time_limit = 100;
  film_->add_estimates(0, 2);
  const RenderResult result = run(options);
  EXPECT_EQ(result.reason, StopReason::kTime);
  EXPECT_TRUE(script_.passes.empty());
  options.time_limit = 101;
  EXPECT_EQ(run(options).passes_of_run, 1u);
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
  // Even n: value 1, stderr 1/sqrt(n-1); relative error 1/sqrt((n-1) * 1.01). It is at most 0.2
  // from n = 25.75 on.
  RenderOptions options;
  options.noise_target = 0.2;
  const RenderResult result = run(options);
  EXPECT_EQ(result.reason, StopReason::kNoise);
  EXPECT_EQ(result.passes_done, 26u);
  ASSERT_TRUE(result.error.has_value());
  EXPECT_NEAR(*result.error, 1 / std::sqrt(25 * 1.01), 1e-6);
}

TEST_F(RenderSessionTest, NoiseTargetDoesNotDependOnTheClock) {
  RenderOptions options;
  options.noise_target = 0.1;
  const uint32_t slow = run(options).passes_done;
  film_ = std::make_unique<Film>(film_->settings(), set_.layout);
  script_.pass_seconds = 1e-4;
  EXPECT_EQ(run(options).passes_done, slow);
}

TEST_F(RenderSessionTest, TheErrorAtTheEndIsThatOfThePicture) {
  // Progress updates it every second: last after pass 20.
  script_.pass_seconds = 0.1;
  RenderOptions options;
  options.last_pass = 25;
  const RenderResult result = run(options);
  ASSERT_TRUE(progress_.back().error.has_value());
  EXPECT_GT(*progress_.back().error, 1.05 / std::sqrt(25 * 1.01));
  ASSERT_TRUE(result.error.has_value());
  EXPECT_NEAR(*result.error, 1 / std::sqrt(25 * 1.01), 1e-6);
}

TEST_F(RenderSessionTest, NoiseTargetIsRefusedWithoutAnErrorEstimate) {
  script_.descriptor.capabilities.per_pixel_state = true;
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

TEST_F(RenderSessionTest, WhatTheFirstPassHasNotReachedIsSaid) {
  FilmSettings settings;
  settings.width = 200;
  settings.height = 100;  // more pixels than the first lattice has
  const size_t slices = Film(settings, set_.layout).slices().count_of_levels(1);
  for (const size_t done : {size_t{1}, slices}) {
    Film film(settings, set_.layout);
    signals_.stop = 0;
    script_.looks = 1;
    script_.during_look = [&](const PassKey&, int) {
      for (int y = 0; y < 100; ++y)
        for (int x = 0; x < 200; ++x) {
          const size_t slice = film.slices().slice_of(x, y);
          if (slice < done) add_one(film, 0, x, y, {1, 1, 1});
        }
      for (size_t i = 0; i < done; ++i) film.finish_slice(0, i, 1);
      signals_.stop = 2;
    };
    RenderSession session(scene_, set_, film, {});
    session.use_clock([this] { return script_.now; });
    EXPECT_TRUE(session.run(signals_).has_unfinished_pass);
    const bool is_covered = done == slices;
    EXPECT_EQ(film.value(199, 99).r, is_covered ? 1.0f : 0.0f);
    EXPECT_EQ(film.value(1, 1).r, 1.0f);  // as its neighbour
    const std::string said = is_covered ? "are as their neighbours" : "may be black";
    EXPECT_NE(session.report().find("pixels that it has not reached " + said), std::string::npos)
        << session.report();
  }
}

TEST_F(RenderSessionTest, ProgressCountsAndForetells) {
  RenderOptions options;
  options.last_pass = 9;
  options.time_limit = 8.4;
  run(options);
  ASSERT_EQ(progress_.size(), 9u);
  const RenderProgress& p = progress_[3];
  EXPECT_EQ(p.passes_done, 4u);
  EXPECT_EQ(*p.passes_wanted, 10u);
  EXPECT_EQ(p.seconds, 4);
  EXPECT_NEAR(*p.seconds_left, 4.4, 1e-12);  // the time limit comes before the six remaining passes
  EXPECT_NEAR(p.fraction, 4 / 8.4, 1e-12);
  EXPECT_EQ(p.rays, 400u);
  EXPECT_EQ(p.photons_stored, 40u);
  EXPECT_TRUE(p.error.has_value());
}

TEST_F(RenderSessionTest, ProgressNeverFallsWithinPasses) {
  script_.looks = 10;
  script_.pass_seconds = 10;
  // The third pass takes longer than those before it.
  script_.during_pass = [&](const PassKey& key) { script_.now += key.pass == 2 ? 7 : 0; };
  RenderOptions options;
  options.last_pass = 3;
  run(options);
  ASSERT_EQ(progress_.size(), 4u);
  ASSERT_EQ(progress_within_.size(), 40u);
  // Nothing is known within the first pass: its pixels are done all at once.
  EXPECT_FALSE(progress_within_[9].seconds_left);
  EXPECT_EQ(progress_within_[9].fraction, 0);
  EXPECT_NEAR(*progress_within_[14].seconds_left, 25, 1e-9);
  EXPECT_NEAR(progress_within_[14].fraction, 15.0 / 40, 1e-9);
  double before = 0;
  for (const RenderProgress& p : progress_within_) {
    EXPECT_GE(p.fraction, before);
    before = p.fraction;
  }
}

TEST_F(RenderSessionTest, BehindTheTimeLimitNobodyKnowsHowLongTheFirstPictureTakes) {
  script_.looks = 10;
  script_.pass_seconds = 10;
  RenderOptions options;
  options.time_limit = 5;
  run(options);
  ASSERT_EQ(progress_within_.size(), 10u);
  EXPECT_NEAR(*progress_within_[1].seconds_left, 3, 1e-9);
  EXPECT_NEAR(progress_within_[1].fraction, 0.4, 1e-9);
  EXPECT_FALSE(progress_within_[8].seconds_left);
  EXPECT_EQ(progress_within_[8].fraction, 1);
}

}  // namespace
}  // namespace nephroid
