// Whole suites with pictures of a few pixels: rendering, reuse of earlier results, and failures.
#include "bench/bench.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "bench/kept.h"
#include "core/errors.h"
#include "film/exr_file.h"
#include "film/image_io.h"
#include "source_directory.h"
#include "unit/bench/bench_runs.h"

namespace nephroid {
namespace {

TEST_F(BenchRuns, MeasuresEveryIntegrator) {
  const BenchResults results = run(small_suite());
  EXPECT_EQ(exit_status(results, true), 0) << said_;
  ASSERT_EQ(results.scenes.size(), 1u);
  const BenchSceneResult& room = results.scenes[0];
  EXPECT_EQ(room.width, 8);
  EXPECT_EQ(room.reference.passes, 6u);
  ASSERT_TRUE(room.reference.own_error);
  EXPECT_GT(*room.reference.own_error, 0);
  // The layer's share and the named share.
  ASSERT_EQ(room.reference.energy.size(), 2u);
  EXPECT_EQ(room.reference.energy[0].first, "lit");
  EXPECT_GT(room.reference.energy[0].second, 0);
  EXPECT_LT(room.reference.energy[0].second, 1);
  ASSERT_EQ(room.runs.size(), 2u);
  for (const BenchRun& run : room.runs) {
    ASSERT_EQ(run.failure, "");
    EXPECT_EQ(run.end().passes, 4u);
    EXPECT_EQ(run.points.front().passes, 1u);
    EXPECT_EQ(run.points.size(), 4u);
    EXPECT_GT(run.end().errors.rmse, 0);
    EXPECT_GT(run.end().errors.flip, 0);
    EXPECT_GT(run.rays, 0u);
    ASSERT_EQ(run.end().layers.size(), 1u);
    EXPECT_GT(run.end().layers[0].second.rmse, 0);
    EXPECT_LT(run.end().layers[0].second.rmse, run.end().errors.rmse);
    ASSERT_EQ(run.regions.size(), 1u);
    EXPECT_NE(run.regions[0].second.rmse, run.end().errors.rmse);
    for (size_t i = 1; i < run.points.size(); ++i)
      EXPECT_GT(run.points[i].seconds, run.points[i - 1].seconds);
  }
  // Path tracing stores no photons.
  EXPECT_EQ(room.runs[0].bytes, 0u);
  // The peaks of photon memory and pixel memory may fall in different passes.
  EXPECT_LE(room.runs[1].bytes, room.runs[1].photon_bytes + room.runs[1].pixel_bytes);
  EXPECT_GT(room.runs[1].bytes, room.runs[1].pixel_bytes);
  EXPECT_EQ(room.runs[0].emitted, 0u);
  EXPECT_EQ(room.runs[1].emitted, 4096u);
  EXPECT_GT(room.runs[1].photons_stored, 0u);
  EXPECT_GT(room.runs[1].photon_bytes, 0u);
  EXPECT_GT(room.runs[1].bytes, room.runs[1].photon_bytes);
  EXPECT_EQ(results.verdicts.at(0).state, BenchVerdict::State::kHolds);
  for (const char* name : {"results.json", "runs.csv", "curves.csv"})
    EXPECT_FALSE(file(name).empty()) << name;
}

TEST_F(BenchRuns, TheSameReferenceHasNoError) {
  // The run is the reference itself, with its seed.
  std::string suite = small_suite();
  const std::string old_part = "\"integrator\": \"path\"}";
  suite.replace(suite.find(old_part), old_part.size(),
                "\"integrator\": \"path\", \"seed\": 12345}");
  const std::string passes = "\"passes\": 6}";
  suite.replace(suite.find(passes), passes.size(), "\"passes\": 4}");
  const BenchResults results = run(suite);
  const BenchErrors& errors = results.scenes.at(0).find_run("path")->end().errors;
  // The reference's extra layers change only the rounding of sums.
  EXPECT_LT(errors.rmse, 1e-5);
  EXPECT_LT(results.scenes[0].find_run("path")->end().layers.at(0).second.rmse, 1e-5);
  EXPECT_LT(errors.flip, 1e-2);
}

TEST_F(BenchRuns, AReferenceMayTakeATime) {
  std::string suite = small_suite();
  const std::string passes = "\"passes\": 6}";
  suite.replace(suite.find(passes), passes.size(), "\"time\": \"0.05s\"}");
  const BenchResults results = run(suite);
  const BenchReferenceResult& reference = results.scenes.at(0).reference;
  EXPECT_EQ(results.failures(), 0) << said_;
  EXPECT_GE(reference.passes, 1u);
  EXPECT_GT(reference.seconds, 0);
  EXPECT_TRUE(run(suite).scenes.at(0).reference.kept);
}

TEST_F(BenchRuns, AReferenceFileNeedsTheLayers) {
  const std::string picture = run(small_suite()).scenes.at(0).reference.picture;
  const auto with_layer = [&](const std::string& name) {
    return small_suite(R"(, {"name": "other", "file": ")" + kRoom +
                       R"(", "resolution": [8, 8], "layer": {")" + name +
                       R"(": "C[DG]L"}, "reference": {"file": ")" + picture + "\"}}");
  };
  EXPECT_EQ(run(with_layer("lit"), {"other"}).scenes.at(0).runs.at(0).failure, "");
  const BenchResults results = run(with_layer("unlit"), {"other"});
  EXPECT_NE(results.scenes.at(0).runs.at(0).failure.find("the reference has no layer 'unlit'"),
            std::string::npos)
      << results.scenes[0].runs[0].failure;
}

TEST_F(BenchRuns, WhatIsThereIsNotRenderedAgain) {
  const BenchResults first = run(small_suite());
  EXPECT_NE(said_.find("rendering"), std::string::npos);
  const BenchResults second = run(small_suite());
  EXPECT_EQ(said_.find("rendering"), std::string::npos) << said_;
  ASSERT_EQ(second.scenes.at(0).runs.size(), 2u);
  EXPECT_TRUE(second.scenes[0].reference.kept);
  for (size_t i = 0; i < 2; ++i) {
    EXPECT_TRUE(second.scenes[0].runs[i].kept);
    EXPECT_EQ(run_to_json(second.scenes[0].runs[i]), run_to_json(first.scenes[0].runs[i]));
  }
  // Another setting of an integrator makes another run; the others stay.
  std::string changed = small_suite();
  const std::string old_part = "\"photons\": 1024";
  changed.replace(changed.find(old_part), old_part.size(), "\"photons\": 2048");
  const BenchResults third = run(changed);
  EXPECT_TRUE(third.scenes.at(0).find_run("path")->kept);
  EXPECT_FALSE(third.scenes[0].find_run("mixed")->kept);
}

TEST_F(BenchRuns, AnotherFileOfTheSceneIsAnotherScene) {
  const auto write_mesh = [&](const char* vertices) {
    write_text(scratch_.file("mesh.pbrt"), std::string("Shape \"trianglemesh\" \"point3 P\" [") +
                                               vertices + "] \"integer indices\" [0 1 2]");
  };
  write_text(scratch_.file("scene.pbrt"),
             "Camera \"perspective\"\nWorldBegin\nLightSource \"infinite\"\n"
             "Include \"mesh.pbrt\"\n");
  std::string suite = small_suite();
  suite.replace(suite.find(kRoom), kRoom.size(), scratch_.file("scene.pbrt"));
  const auto kept = [&] {
    const BenchResults results = run(suite);
    EXPECT_EQ(results.failures(), 0) << said_;
    const BenchSceneResult& scene = results.scenes.at(0);
    EXPECT_EQ(scene.reference.kept, scene.runs.at(0).kept);
    return scene.reference.kept;
  };
  write_mesh("-1 0 4  1 0 4  0 1 4");
  EXPECT_FALSE(kept());
  EXPECT_TRUE(kept());
  write_mesh("-1 0 4  1 0 4  0 2 4");
  EXPECT_FALSE(kept());
  // Files added later by Include count as well.
  write_text(scratch_.file("more.pbrt"), "Shape \"disk\"");
  write_text(scratch_.file("mesh.pbrt"), "Include \"more.pbrt\"");
  EXPECT_FALSE(kept());
  EXPECT_TRUE(kept());
  write_text(scratch_.file("more.pbrt"), "Shape \"sphere\"");
  EXPECT_FALSE(kept());
}

TEST_F(BenchRuns, WhatWasRemovedIsRenderedAgain) {
  const BenchResults first = run(small_suite());
  std::filesystem::remove(first.scenes.at(0).reference.picture);
  std::filesystem::remove(first.scenes[0].runs.at(1).picture);
  const BenchResults second = run(small_suite());
  EXPECT_EQ(second.failures(), 0) << said_;
  EXPECT_FALSE(second.scenes.at(0).reference.kept);
  EXPECT_TRUE(std::filesystem::exists(second.scenes[0].reference.picture));
  // The same number of passes gives the same picture, so errors against it still hold.
  EXPECT_EQ(second.scenes[0].reference.key, first.scenes[0].reference.key);
  EXPECT_TRUE(second.scenes[0].runs.at(0).kept);
  EXPECT_FALSE(second.scenes[0].runs.at(1).kept);
  EXPECT_TRUE(run(small_suite()).scenes.at(0).reference.kept);
}

/// Replaces the reference and its figures by those of another picture, as if a machine with another
/// speed had stopped after other passes.
void brighten(BenchReferenceResult reference) {
  Picture picture = read_picture(reference.picture);
  for (float& value : picture.pixels) value *= 2;
  write_exr(reference.picture, picture);
  reference.key = hash_picture(picture);
  write_text(reference.picture.substr(0, reference.picture.size() - 3) + "json",
             reference_to_json(reference));
}

TEST_F(BenchRuns, RunsAreNotKeptForAnotherPictureOfTheReference) {
  const BenchResults first = run(small_suite());
  brighten(first.scenes.at(0).reference);
  const BenchResults second = run(small_suite());
  EXPECT_TRUE(second.scenes.at(0).reference.kept);
  for (size_t i = 0; i < 2; ++i) {
    EXPECT_FALSE(second.scenes[0].runs.at(i).kept);
    EXPECT_NE(second.scenes[0].runs[i].end().errors.rmse,
              first.scenes[0].runs.at(i).end().errors.rmse);
  }
  // Rendering the first picture again brings back its measurements.
  std::filesystem::remove(second.scenes[0].reference.picture);
  const BenchResults third = run(small_suite());
  EXPECT_FALSE(third.scenes.at(0).reference.kept);
  for (size_t i = 0; i < 2; ++i)
    EXPECT_EQ(run_to_json(third.scenes[0].runs.at(i)), run_to_json(first.scenes[0].runs.at(i)));
}

TEST_F(BenchRuns, FiguresOfAnotherPictureAreNotTheReferences) {
  const BenchReferenceResult first = run(small_suite()).scenes.at(0).reference;
  Picture picture = read_picture(first.picture);
  picture.pixels.at(0) += 1;
  write_exr(first.picture, picture);
  const BenchReferenceResult second = run(small_suite()).scenes.at(0).reference;
  EXPECT_FALSE(second.kept);
  EXPECT_EQ(second.key, first.key);
}

TEST_F(BenchRuns, AReferenceFileIsKnownByItsPixels) {
  const std::string picture = run(small_suite()).scenes.at(0).reference.picture;
  const std::string copy = scratch_.file("copy.exr");
  std::filesystem::copy_file(picture, copy);
  const std::string suite =
      small_suite(R"(, {"name": "other", "file": ")" + kRoom +
                  R"(", "resolution": [8, 8], "reference": {"file": ")" + copy + "\"}}");
  run(suite, {"other"});
  Picture changed = read_picture(copy);
  changed.metadata.emplace_back("note", "written again");
  write_exr(copy, changed);
  EXPECT_TRUE(run(suite, {"other"}).scenes.at(0).runs.at(0).kept);
  changed.pixels.at(0) += 1;
  write_exr(copy, changed);
  EXPECT_FALSE(run(suite, {"other"}).scenes.at(0).runs.at(0).kept);
}

// A run that is its own reference, in a colour space wider than the screen's, and with an unknown
// parameter.
TEST_F(BenchRuns, ColoursAreComparedInTheirSpaceAndWarningsAreSaid) {
  const std::string scene = scratch_.file("wide.pbrt");
  std::ofstream(scene) << R"(LookAt 0 0 -3  0 0 0  0 1 0 Camera "perspective" "float fov" 40
    ColorSpace "rec2020"
    Film "rgb" "integer xresolution" 8 "integer yresolution" 8
    WorldBegin
    LightSource "infinite" "rgb L" [0.1 0.7 0.2]
    Material "diffuse" "float shinyness" 3 Shape "sphere")";
  const BenchResults results = run(R"({"name": "wide", "passes": 2,
    "integrators": [{"name": "path", "integrator": "path", "seed": 5, "outliers": "reject"}],
    "scenes": [{"name": "ball", "file": ")" +
                                   scene +
                                   R"(", "layer": {"seen": "C D L"},
      "reference": {"integrator": "path", "seed": 5, "passes": 2}}]})");
  ASSERT_EQ(results.failures(), 0) << said_;
  const BenchRun& ball = results.scenes.at(0).runs.at(0);
  const Picture picture = read_picture(ball.picture);
  ASSERT_EQ(picture.color_space, RgbColorSpace::find("rec2020"));
  EXPECT_LT(ball.end().errors.rmse, 1e-5);
  EXPECT_LT(ball.end().errors.flip, 1e-3);
  const auto says = [](const std::vector<std::string>& lines, const char* what) {
    return std::any_of(lines.begin(), lines.end(), [&](const std::string& line) {
      return line.find(what) != std::string::npos;
    });
  };
  EXPECT_TRUE(says(ball.notes, "shinyness"));
  EXPECT_NE(file("results.json").find("shinyness"), std::string::npos);
  const auto value = [&](const std::string& key) {
    for (const auto& [name, text] : picture.metadata)
      if (name == key) return text;
    return std::string();
  };
  EXPECT_EQ(value("nephroid:outliers"), "reject");
  EXPECT_NE(value("nephroid:aovs").find("seen"), std::string::npos);
}

TEST_F(BenchRuns, AFailureDoesNotStopTheRest) {
  const std::string broken = scratch_.file("broken.pbrt");
  std::ofstream(broken) << "WorldBegin\nShape \"blob\"\n";
  const BenchResults results =
      run(small_suite(R"(, {"name": "lost", "file": "/nowhere/s.pbrt", "resolution": [4, 4],
                           "reference": {"integrator": "path", "passes": 1}},
                         {"name": "broken", "file": ")" +
                      broken + R"(", "reference": {"integrator": "path", "passes": 1}},
                         {"name": "small", "file": ")" +
                      kRoom + R"(", "resolution": [4, 4], "reference": {"file": ")" +
                      scratch_.file("room.exr") + "\"}}"));
  ASSERT_EQ(results.scenes.size(), 4u);
  EXPECT_EQ(results.scenes[0].failure, "");
  EXPECT_EQ(results.scenes[0].runs.size(), 2u);
  EXPECT_NE(results.scenes[1].failure.find("/nowhere/s.pbrt"), std::string::npos);
  EXPECT_NE(results.scenes[2].failure.find("broken.pbrt:2"), std::string::npos)
      << results.scenes[2].failure;
  EXPECT_NE(results.scenes[3].failure.find("room.exr"), std::string::npos);
  EXPECT_EQ(results.failures(), 3);
  EXPECT_EQ(exit_status(results, false), 1);
  EXPECT_NE(file("results.json").find("/nowhere/s.pbrt"), std::string::npos);
}

TEST_F(BenchRuns, AReferenceOfAnotherSizeIsSaid) {
  run(small_suite());
  const BenchResults results =
      run(small_suite(R"(, {"name": "small", "file": ")" + kRoom +
                      R"(", "resolution": [4, 4], "reference": {"file": ")" +
                      run(small_suite()).scenes.at(0).reference.picture + "\"}}"),
          {"small"});
  ASSERT_EQ(results.scenes.size(), 1u);
  ASSERT_EQ(results.scenes[0].runs.size(), 2u);
  EXPECT_NE(results.scenes[0].runs[0].failure.find("the reference is 8x8 pixels"),
            std::string::npos)
      << results.scenes[0].runs[0].failure;
}

TEST_F(BenchRuns, ASignalStopsAndTheNextInvocationGoesOn) {
  signals_.stop.store(SIGTERM);
  const BenchResults stopped = run(small_suite());
  EXPECT_EQ(stopped.signal, SIGTERM);
  EXPECT_EQ(exit_status(stopped, false), 128 + SIGTERM);
  EXPECT_NE(file("results.json").find("\"signal\": 15"), std::string::npos);
  signals_.stop.store(0);
  EXPECT_EQ(exit_status(run(small_suite()), true), 0);
}

TEST_F(BenchRuns, ClaimsThatFailMatterOnlyIfTheyAreStrict) {
  std::string suite = small_suite();
  suite.replace(suite.find("[1, 1e9]"), 8, "[0, 0.5]");
  const BenchResults results = run(suite);
  EXPECT_EQ(results.verdicts.at(0).state, BenchVerdict::State::kFails);
  EXPECT_EQ(exit_status(results, false), 0);
  EXPECT_EQ(exit_status(results, true), 1);
}

TEST_F(BenchRuns, WrongUse) {
  EXPECT_THROW(run(small_suite(), {"cellar"}), UsageError);
  std::string endless = small_suite();
  endless.replace(endless.find("\"passes\": 4,"), 12, "");
  EXPECT_THROW(run(endless), UsageError);
}

TEST_F(BenchRuns, ResultsAreReadBack) {
  std::string suite = small_suite(R"(, {"name": "lost", "file": "/nowhere/s.pbrt",
                                       "reference": {"integrator": "path", "passes": 1}})");
  suite.insert(1, "\"repeat\": 2, ");
  const BenchResults results = run(suite);
  const std::string text = file("results.json");
  EXPECT_EQ(text, results_json(results));
  const BenchResults back = results_from_json(text, scratch_.file("out/results.json"));
  EXPECT_EQ(results_json(back), text);
  EXPECT_EQ(back.scenes.at(0).reference.integrator, "path");
  // Moved results refer to the pictures beside them.
  const BenchResults moved = results_from_json(text, "/elsewhere/results.json");
  EXPECT_EQ(moved.scenes.at(0).runs.at(1).picture.rfind("/elsewhere/runs/room-mixed-", 0), 0u);
  EXPECT_EQ(moved.scenes[0].runs[1].again.at(0).picture.rfind("/elsewhere/runs/", 0), 0u);
  EXPECT_EQ(moved.scenes[0].reference.picture.rfind("/elsewhere/references/", 0), 0u);
}

// Every message names the file and what was expected.
TEST_F(BenchRuns, OtherTextIsNoResults) {
  run(small_suite());
  const std::string text = file("results.json");
  const auto without = [&](const std::string& part, const std::string& instead) {
    std::string wrong = text;
    wrong.replace(wrong.find(part), part.size(), instead);
    return wrong;
  };
  const std::string wrong_texts[] = {
      "",
      "[]",
      "{}",
      "null",
      text.substr(0, text.size() / 2),
      without("\"format\": 2", "\"format\": 1"),
      without("\"title\": \"Tiny", "\"name\": \"Tiny"),
      without("\"holds\"", "\"unknown\""),
      without("\"integrator\": \"mixed\"", "\"integrator\": \"other\""),
      without("\"scene\": \"room\"", "\"scene\": \"hall\""),
      without("\"points\": [", "\"points\": [], \"more\": ["),
  };
  for (const std::string& wrong : wrong_texts) {
    try {
      results_from_json(wrong, "r.json");
      ADD_FAILURE() << "accepted: " << wrong.substr(0, 200);
    } catch (const UsageError& error) {
      const std::string message = error.what();
      EXPECT_EQ(message.rfind("r.json: not the results of a suite: ", 0), 0u) << message;
      EXPECT_NE(message.find("; expected a results.json of"), std::string::npos) << message;
    }
  }
}

TEST(BenchSuites, TheExamplesAreUnderstood) {
  const BenchSuite suite = read_suite(testing_support::source_directory() + "/bench/smoke.json");
  EXPECT_EQ(suite.name, "smoke");
  EXPECT_TRUE(std::ifstream(suite.scenes.at(0).file).good());
}

}  // namespace
}  // namespace nephroid
