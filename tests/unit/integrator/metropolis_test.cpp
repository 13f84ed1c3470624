// What the Metropolis estimators promise beside their pictures: lengths that are chosen as often as
// they say, reports, passes of any size and any order, and crops.
#include <gtest/gtest.h>

#include <algorithm>

#include "integrator/multiplexed.h"
#include "rendering.h"

namespace nephroid {
namespace {

using namespace testing_support;

const std::string kHead = R"(
  LookAt 0 3 -5  0 0.4 0  0 1 0
  Camera "perspective" "float fov" 30
  PixelFilter "mitchell"
)";
const std::string kFilm = R"(Film "rgb" "integer xresolution" 12 "integer yresolution" 12 )";
const std::string kWorld = R"(
  WorldBegin
  AttributeBegin
    AreaLightSource "diffuse" "rgb L" [10 9 8]
    Translate 0 4 0 Rotate 90 1 0 0 Shape "disk" "float radius" 0.7
  AttributeEnd
  Material "diffuse" "rgb reflectance" [0.6 0.5 0.4]
  Shape "bilinearmesh" "point3 P" [-6 0 -6  6 0 -6  -6 0 6  6 0 6]
  Material "conductor" "float roughness" 0.2
  Translate 0.3 0.5 0 Shape "sphere" "float radius" 0.5
)";

EstimatorStatistics statistics_of(const std::string& text, const std::string& integrator,
                                  const IntegratorOptions& options, uint32_t passes) {
  const auto scene = scene_from_text(text);
  Preset preset = make_integrator(integrator, options, *scene);
  Film film = film_for(*scene, preset);
  for (uint32_t pass = 0; pass < passes; ++pass)
    preset.estimators[0]->render_pass({1, pass}, *scene, film);
  return preset.estimators[0]->statistics();
}

void expect_shares(const LengthChoice& choice) {
  constexpr int kNumbers = 1 << 16;
  std::vector<int> found(choice.lengths(), 0);
  std::vector<double> expected(choice.lengths(), 0.0);
  for (int i = 0; i < kNumbers; ++i) {
    const LengthChoice::Chosen c = choice.choose((static_cast<float>(i) + 0.5f) / kNumbers);
    ASSERT_GE(c.length, 0);
    ASSERT_LT(static_cast<size_t>(c.length), found.size());
    ASSERT_GT(c.probability, 0);
    found[static_cast<size_t>(c.length)] += 1;
    expected[static_cast<size_t>(c.length)] = double{c.probability} * kNumbers;
  }
  for (size_t n = 0; n < found.size(); ++n) EXPECT_NEAR(found[n], expected[n], 1.01) << n;
}

TEST(LengthChoice, ChoosesAsOftenAsItSays) {
  expect_shares(LengthChoice(0));
  expect_shares(LengthChoice(7));
  expect_shares(LengthChoice(100));
  expect_shares(LengthChoice(std::vector<double>{0, 0, 0}));
  const std::vector<double> bright = {0.2, 5, 0, 1, 0};
  const LengthChoice learned(bright);
  expect_shares(learned);
  EXPECT_EQ(learned.lengths(), 5u);
  const auto share = [&](const LengthChoice& choice, int length) {
    for (float u = 0; u < 1; u += 1e-4f)
      if (const auto c = choice.choose(u); c.length == length) return c.probability;
    return 0.0f;
  };
  EXPECT_GT(share(learned, 1), share(LengthChoice(4), 1)) << "what is bright is tried more often";
  EXPECT_GT(share(learned, 4), 0) << "what was not seen is still tried";
  EXPECT_EQ(LengthChoice(1 << 30).lengths(), 1000u);
}

TEST(Metropolis, CountsItsPathsAndSaysHowItWent) {
  for (const char* integrator : {"mlt", "pssmlt"}) {
    IntegratorOptions options;
    options.mutations = 20;
    options.chain_length = 100;
    options.large_step = 0.25f;
    const EstimatorStatistics s = statistics_of(kHead + kFilm + kWorld, integrator, options, 2);
    // 2880 mutations are 29 chains of 100, and a bootstrap of a quarter as many.
    EXPECT_EQ(s.camera_paths, 2u * (2900 + 725)) << integrator;
    EXPECT_GT(s.rays, s.camera_paths / 2) << integrator;
    EXPECT_GT(s.splats, 1000u) << integrator;
    ASSERT_EQ(s.notes.size(), 1u) << integrator;
    EXPECT_NE(s.notes[0].find("of 1450 paths"), std::string::npos) << s.notes[0];
  }
}

TEST(Metropolis, SaysThatItFoundNothing) {
  const EstimatorStatistics s = statistics_of(kHead + kFilm + R"(WorldBegin
      LightSource "point" "point3 from" [0 -5 0]
      Material "diffuse" Shape "bilinearmesh" "point3 P" [-6 0 -6  6 0 -6  -6 0 6  6 0 6])",
                                              "pssmlt", {}, 1);
  ASSERT_EQ(s.notes.size(), 1u);
  EXPECT_NE(s.notes[0].find("none of"), std::string::npos) << s.notes[0];
}

TEST(Metropolis, PassesOfAnySizeFindTheSamePicture) {
  // The least there can be: a mutation a chain, chains as long as the pass, large steps only.
  const auto scene = scene_from_text(kHead + kFilm + kWorld);
  IntegratorOptions options;
  options.max_depth = 4;
  const Estimate expected = mean_over_seeds(*scene, "path", options, 32, 64);
  struct Size {
    float mutations;
    int64_t chain_length;
    float large_step;
  };
  uint64_t seed = 100;
  for (const char* integrator : {"mlt", "pssmlt"})
    for (const Size& size : {Size{1, 1, 0.3f}, Size{8, 1 << 30, 0.02f}, Size{8, 16, 1.0f}}) {
      options.mutations = size.mutations;
      options.chain_length = size.chain_length;
      options.large_step = size.large_step;
      const Estimate found = mean_over_seeds(*scene, integrator, options, 32, 24, seed += 100);
      const double error = std::hypot(found.error, expected.error);
      EXPECT_NEAR(found.mean, expected.mean, kT31 * error)
          << integrator << ", chains of " << size.chain_length;
      EXPECT_LT(error, 0.02 * expected.mean) << "too noisy to tell";
    }
}

TEST(Metropolis, ACropIsAsBrightAsItsPartOfThePicture) {
  const auto whole = scene_from_text(kHead + kFilm + kWorld);
  const auto crop =
      scene_from_text(kHead + R"(Film "rgb" "integer xresolution" 12 "integer yresolution" 12
                 "integer pixelbounds" [4 8 4 8] )" +
                      kWorld);
  IntegratorOptions options;
  options.max_depth = 4;
  const SeedValues all = block_values(*whole, "path", options, 32, 32, 1, 3);
  const Estimate expected = estimate_of(all[4]);
  for (const char* integrator : {"mlt", "pssmlt"}) {
    const Estimate found = mean_over_seeds(*crop, integrator, options, 32, 16, 500);
    const double error = std::hypot(found.error, expected.error);
    EXPECT_NEAR(found.mean, expected.mean, kT31 * error) << integrator;
    EXPECT_LT(error, 0.02 * expected.mean) << "too noisy to tell";
  }
}

}  // namespace
}  // namespace nephroid
