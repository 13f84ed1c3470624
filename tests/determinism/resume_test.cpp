// A render interrupted after or within any pass, any number of times, and resumed from its picture
// ends with the bits of an uninterrupted one. So does the sum of pictures of disjoint passes, in
// any order. For all integrators and presets.
#include <gtest/gtest.h>

#include <cstring>
#include <memory>
#include <string>

#include "core/errors.h"
#include "determinism/scene_of_all_kinds.h"
#include "film/exr_file.h"
#include "film/film_output.h"
#include "integrator/photon_mapping/photon_map.h"
#include "rendering.h"
#include "session/checkpoint/checkpoint.h"
#include "session/checkpoint/film_metadata.h"
#include "session/checkpoint/merge_pictures.h"
#include "session/checkpoint/version.h"
#include "session/light_layers.h"
#include "unit/film/scratch_directory.h"

namespace nephroid {
namespace {

using namespace testing_support;

constexpr uint32_t kPasses = 4;

IntegratorOptions small_passes() {
  IntegratorOptions options;
  options.photons_per_pass = 5000;
  options.edit<PhotonMapOptions>().map_photons = 20000;
  return options;
}

/// Stops a pass at the given call of attend().
class StopAt final : public PassControl {
 public:
  explicit StopAt(int looks) : looks_(looks) {}
  bool is_wanted() const noexcept override { return true; }
  void attend() override {
    if (--looks_ <= 0) throw PassStopped{};
  }

 private:
  int looks_;
};

/// A plan with a layer for each lamp, so that sums of layers are compared, too.
RoutePlan plan_with_layers(const std::string& name, const Scene& scene) {
  RoutePlan plan = plan_named(name);
  add_layers(LayerChoice::kLights, scene, &plan);
  return plan;
}

/// A run of the program: starts with a new film and new estimators.
struct OneRun {
  OneRun(const Scene& of_scene, const std::string& plan, bool rejects)
      : scene(of_scene),
        set(make_estimators(plan_with_layers(plan, scene), small_passes(), scene)),
        film(film_for(scene, set)) {
    if (rejects)
      film.reject_outliers(
          {std::vector<float>(static_cast<size_t>(film.layout().group_count()), 1.0f), 8});
    identity.version = kVersion;
    identity.set_film(film, 5);
  }
  void render(uint32_t first, uint32_t last) {
    for (uint32_t pass = first; pass <= last; ++pass) {
      set.render_pass({5, pass}, scene, film);
      film.finish_pass();
      done.add(pass);
    }
  }
  /// Renders up to pass `last`. False if the control stopped it before.
  bool render_watched(uint32_t last, PassControl& control) {
    for (uint32_t pass = open.value_or(done.first_missing(0)); pass <= last; ++pass) {
      open = pass;
      try {
        set.render_pass({5, pass}, scene, film, control);
      } catch (const PassStopped&) {
        return false;
      }
      open.reset();
      film.finish_pass();
      done.add(pass);
    }
    return true;
  }
  void go_on(const std::string& path) {
    const Checkpoint checkpoint = go_on_from(path, identity, scene, set, film);
    done = checkpoint.passes;
    open = checkpoint.open_pass;
  }
  void write(const std::string& path) {
    write_state(state_path_beside(path),
                {{film.settings().width, film.settings().height}, film.bounds(), metadata()},
                state_of(scene, set, film));
  }

  Metadata metadata() const {
    Metadata all = identity.to_metadata();
    add_film_metadata(film, passes_add_up(set, film), &all);
    all.emplace_back(kPassesKey, done.text());
    if (open) all.emplace_back(kOpenPassKey, std::to_string(*open));
    return all;
  }

  const Scene& scene;
  EstimatorSet set;
  Film film;
  RenderIdentity identity;
  PassRanges done;
  std::optional<uint32_t> open;
};

/// A scene for one of the plans. One of them has a film with positions and other geometry.
std::unique_ptr<Scene> scene_for(const std::string& plan) {
  std::string text = kScene;
  const std::string film = "Film \"rgb\"";
  if (plan == "path") text.replace(text.find(film), film.size(), "Film \"gbuffer\"");
  return scene_from_text(text);
}

void expect_same_state(RenderState a, RenderState b, const std::string& what) {
  ASSERT_EQ(a.arrays.size(), b.arrays.size());
  for (size_t i = 0; i < a.arrays.size(); ++i) {
    ASSERT_EQ(a.arrays[i].bytes.size(), b.arrays[i].bytes.size());
    ASSERT_EQ(
        std::memcmp(a.arrays[i].bytes.data(), b.arrays[i].bytes.data(), a.arrays[i].bytes.size()),
        0)
        << what << ": " << a.arrays[i].name;
  }
  ASSERT_EQ(a.streams.size(), b.streams.size());
  for (size_t i = 0; i < a.streams.size(); ++i)
    ASSERT_EQ(a.streams[i].save(), b.streams[i].save()) << what << ": " << a.streams[i].name;
}

class Resume : public ::testing::TestWithParam<std::string> {};

TEST_P(Resume, EndsWithTheBitsOfOneRun) {
  const auto scene = scene_for(GetParam());
  const ScratchDirectory directory;
  const std::string path = directory.file("picture.exr");
  for (const bool rejects : {false, true}) {
    OneRun whole(*scene, GetParam(), rejects);
    whole.render(0, kPasses - 1);
    EXPECT_GT(picture_mean(whole.film), 0.0);
    for (const std::vector<uint32_t>& ends : {std::vector<uint32_t>{0, 3}, {1, 3}, {0, 1, 2, 3}}) {
      uint32_t next = 0;
      for (const uint32_t end : ends) {
        OneRun run(*scene, GetParam(), rejects);
        if (next > 0) run.go_on(path);
        run.render(next, end);
        run.write(path);
        next = end + 1;
      }
      OneRun last(*scene, GetParam(), rejects);
      last.go_on(path);
      EXPECT_EQ(last.done.text(), "0..3");
      expect_same_state(state_of(*scene, last.set, last.film),
                        state_of(*scene, whole.set, whole.film),
                        std::to_string(ends.size()) + " runs");
    }
    // One preset is enough: rejection does not depend on the estimator.
    if (GetParam() != "path") break;
  }
}

TEST_P(Resume, WithinPassesEndsWithTheBitsOfOneRun) {
  constexpr uint32_t kLast = 2;
  const auto scene = scene_for(GetParam());
  const ScratchDirectory directory;
  const std::string path = directory.file("picture.exr");
  OneRun whole(*scene, GetParam(), GetParam() == "path");
  whole.render(0, kLast);
  // Stops come later and later, so that the loop ends even if each one loses part of a pass.
  int stops = 0, within = 0;
  for (int looks = 1, growth = 3;; looks += growth, ++growth) {
    OneRun run(*scene, GetParam(), GetParam() == "path");
    if (stops > 0) run.go_on(path);
    StopAt control(looks);
    const bool is_done = run.render_watched(kLast, control);
    run.write(path);
    if (is_done) break;
    ++stops;
    within += run.film.has_open_pass();
  }
  EXPECT_GE(stops, 3);
  OneRun last(*scene, GetParam(), GetParam() == "path");
  last.go_on(path);
  EXPECT_EQ(last.done.text(), "0..2");
  EXPECT_FALSE(last.open);
  expect_same_state(state_of(*scene, last.set, last.film), state_of(*scene, whole.set, whole.film),
                    std::to_string(stops) + " stops, " + std::to_string(within) + " within a pass");
}

TEST_P(Resume, PicturesOfOtherPassesAddUp) {
  const auto scene = scene_for(GetParam());
  const ScratchDirectory directory;
  std::vector<std::string> parts;
  for (const auto& [first, last] : {std::pair<uint32_t, uint32_t>{2, 2}, {0, 1}, {3, 3}}) {
    OneRun run(*scene, GetParam(), false);
    run.render(first, last);
    parts.push_back(directory.file(std::to_string(first) + ".exr"));
    run.write(parts.back());
  }
  const std::string sum = directory.file("sum.exr");
  OneRun whole(*scene, GetParam(), false);
  if (!passes_add_up(whole.set, whole.film)) {
    EXPECT_THROW(merge_pictures(parts, sum), UsageError);
    return;
  }
  whole.render(0, kPasses - 1);
  for (int order = 0; order < 3; ++order) {
    EXPECT_EQ(merge_pictures(parts, sum, LayerPrecision::kFloat).passes.text(), "0..3");
    OneRun merged(*scene, GetParam(), false);
    merged.go_on(sum);
    expect_same_state(merged.film.state(), whole.film.state(), "merged");
    const Picture picture = read_picture(sum), wanted = film_picture(whole.film, {});
    for (size_t c = 0; c < wanted.channels.size(); ++c) {
      const int found = picture.find_channel(wanted.channels[c]);
      ASSERT_GE(found, 0) << wanted.channels[c];
      for (size_t i = 0; i < static_cast<size_t>(picture.window.area()); ++i)
        ASSERT_EQ(picture.pixels[i * picture.channels.size() + static_cast<size_t>(found)],
                  wanted.pixels[i * wanted.channels.size() + c])
            << wanted.channels[c];
    }
    std::rotate(parts.begin(), parts.begin() + 1, parts.end());
  }
  parts.push_back(parts[0]);
  EXPECT_THROW(merge_pictures(parts, sum), UsageError);
}

TEST_P(Resume, WhatAnotherTaskLearnedGivesTheSameBits) {
  const auto scene = scene_for(GetParam());
  const ScratchDirectory directory;
  const std::string path = directory.file("task.exr");
  OneRun first(*scene, GetParam(), false);
  first.render(0, 0);
  first.write(path);
  OneRun whole(*scene, GetParam(), false), task(*scene, GetParam(), false);
  EXPECT_EQ(learn_from(path, task.identity, task.set, task.film), std::vector<std::string>());
  whole.render(0, 1);
  task.render(0, 1);
  expect_same_state(state_of(*scene, task.set, task.film), state_of(*scene, whole.set, whole.film),
                    "learned from another task");
  for (size_t i = 0; i < task.set.estimators.size(); ++i) {
    if (task.set.estimators[i]->descriptor().capabilities.learned_is_light) continue;
    EXPECT_EQ(task.set.statistics()[i].learning_rays, 0u);
  }
  // Else the test would prove nothing.
  if (GetParam() == "mixed") {
    uint64_t rays = 0;
    for (const EstimatorStatistics& s : whole.set.statistics()) rays += s.learning_rays;
    EXPECT_GT(rays, 0u);
  }
}

TEST(LearnFrom, WhatCannotBeTakenIsLearnedAgain) {
  const auto scene = scene_from_text(kScene);
  const ScratchDirectory directory;
  const std::string path = directory.file("task.exr"), sum = directory.file("sum.exr");
  OneRun first(*scene, "mixed", false), second(*scene, "mixed", false);
  first.render(0, 0);
  first.write(path);
  second.render(1, 1);
  second.write(directory.file("other.exr"));
  merge_pictures({path, directory.file("other.exr")}, sum);
  const std::string unlearned = directory.file("unlearned.exr");
  OneRun(*scene, "mixed", false).write(unlearned);
  const auto said = [&](const std::string& from, const std::string& instruction_sets = "") {
    OneRun task(*scene, "mixed", false);
    task.identity.instruction_sets = instruction_sets;
    std::string text;
    for (const std::string& warning : learn_from(from, task.identity, task.set, task.film))
      text += warning + "\n";
    task.render(2, 2);
    uint64_t rays = 0;
    for (const EstimatorStatistics& s : task.set.statistics()) rays += s.learning_rays;
    EXPECT_EQ(rays > 0, !text.empty()) << text;
    return text;
  };
  EXPECT_EQ(said(path), "");
  for (const auto& [text, part] : {std::pair(said(sum), "what was learned is not kept there"),
                                   std::pair(said(unlearned), "what was learned is not kept there"),
                                   std::pair(said(path, "avx9"), "nothing, here avx9"),
                                   std::pair(said(directory.file("none.exr")), "there is no")}) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
    EXPECT_NE(text.find("; this render learns by itself\n"), std::string::npos) << text;
  }
  // A sum that a render goes on from has nothing learned, either.
  OneRun run(*scene, "mixed", false);
  EXPECT_FALSE(go_on_from(sum, run.identity, *scene, run.set, run.film).has_learned);
  EXPECT_EQ(learn_from(path, run.identity, run.set, run.film), std::vector<std::string>());
  run.render(2, 2);
  for (const EstimatorStatistics& s : run.set.statistics()) EXPECT_EQ(s.learning_rays, 0u);
  OneRun resumed(*scene, "mixed", false);
  EXPECT_TRUE(go_on_from(path, resumed.identity, *scene, resumed.set, resumed.film).has_learned);
}

INSTANTIATE_TEST_SUITE_P(AllRoutes, Resume, ::testing::ValuesIn(plan_names()),
                         [](const auto& test) { return test_name(test.param); });

TEST(ResumeRefuses, ThePictureOfAnotherRender) {
  const auto scene = scene_from_text(kScene);
  const ScratchDirectory directory;
  const std::string path = directory.file("picture.exr");
  OneRun run(*scene, "path", false);
  run.identity.options = "max-depth=5 radius=1";
  run.render(0, 0);
  run.write(path);
  OneRun other(*scene, "path", false);
  other.identity.seed = "6";
  other.identity.options = "max-depth=5 radius=2 alpha=1";
  try {
    other.go_on(path);
    FAIL() << "went on";
  } catch (const UsageError& error) {
    const std::string text = error.what();
    for (const char* line : {"seed 5, here 6", "radius 1, here 2", "alpha nothing, here 1"})
      EXPECT_NE(text.find(line), std::string::npos) << text;
    EXPECT_EQ(text.find("max-depth"), std::string::npos) << text;
  }
  EXPECT_THROW(learn_from(path, other.identity, other.set, other.film), UsageError);
  std::filesystem::remove(state_path_beside(path));
  EXPECT_THROW(run.go_on(path), IoError);
}

}  // namespace
}  // namespace nephroid
