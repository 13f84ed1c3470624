// Passes of path+photons as they are numbered and measured: later passes go on where the first one
// ended, and what a pass tells of its spread does not depend on memory.
#include "integrator/bidirectional/pair_pass.h"

#include <gtest/gtest.h>

#include "owned_routes.h"
#include "rendering.h"

namespace nephroid {
namespace {

using namespace testing_support;

constexpr char kView[] = R"(
  LookAt 0 4 -2  0 0 0  0 1 0
  Camera "perspective" "float fov" 40
  Film "rgb" "integer xresolution" 12 "integer yresolution" 8
  PixelFilter "box" "float xradius" 0.5 "float yradius" 0.5
  WorldBegin
  Material "diffuse" "rgb reflectance" [0.6 0.6 0.6]
  Shape "bilinearmesh" "point3 P" [-4 0 -4  4 0 -4  -4 0 4  4 0 4]
)";

struct View {
  explicit View(const std::string& world)
      : scene(scene_from_text(kView + world)),
        preset(make_preset(plan_of({"all=.*:path+photons"}), {}, *scene)),
        owned(owned_routes(*scene, {"all=.*:path+photons"})) {}
  Film render(const PairPass& pass, uint32_t number, const IntegratorOptions& options = {}) const {
    Film film = film_for(*scene, preset);
    EstimatorStatistics statistics;
    pass.render({3, number}, *scene, film, owned, options, statistics);
    return film;
  }
  std::unique_ptr<Scene> scene;
  Preset preset;
  OwnedRoutes owned;
};

PairPass camera_paths_only() {
  PairPass pass;
  pass.light_paths = 0;
  pass.connects = false;
  pass.caustics_only = true;
  return pass;
}

// Light that depends on the place alone: over that of even light in the same pass, which has the
// same colours, a pixel tells where its paths came down.
struct Places {
  View uneven{R"(LightSource "point" "rgb I" [9 9 9] "point3 from" [1.5 1.2 0.7])"};
  View even{R"(LightSource "distant" "rgb L" [1 1 1] "point3 from" [0 1 0] "point3 to" [0 0 0])"};

  std::vector<double> of(const PairPass& pass, uint32_t number) const {
    const Film a = uneven.render(pass, number), b = even.render(pass, number);
    std::vector<double> values;
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 12; ++x)
        values.push_back(static_cast<double>(a.value(x, y).g) /
                         static_cast<double>(b.value(x, y).g));
    return values;
  }
};

TEST(PairPass, GoesOnWithThePointsThatTheFirstPassHasLeft) {
  const Places places;
  constexpr uint32_t kHead = 8, kLater = 3;
  // One path a pass, in the order of their numbers.
  std::vector<std::vector<double>> single;
  for (uint32_t i = 0; i < kHead + 2 * kLater; ++i)
    single.push_back(places.of(camera_paths_only(), i));
  const auto expect_numbers = [&](const PairPass& pass, uint32_t number, uint32_t begin,
                                  uint32_t end) {
    const std::vector<double> found = places.of(pass, number);
    for (size_t pixel = 0; pixel < found.size(); ++pixel) {
      double sum = 0;
      for (uint32_t i = begin; i < end; ++i) sum += single[i][pixel];
      const double expected = sum / (end - begin);
      ASSERT_NEAR(found[pixel], expected, 2e-3 * expected)
          << "pass " << number << ", pixel " << pixel;
    }
  };
  PairPass pass = camera_paths_only();
  SampleMap map(film_for(*places.even.scene, places.even.preset).bounds());
  pass.samples = &map;
  for (uint16_t& n : map.counts()) n = kHead;
  expect_numbers(pass, 0, 0, kHead);
  for (uint16_t& n : map.counts()) n = kLater;
  pass.head = kHead;
  expect_numbers(pass, 1, kHead, kHead + kLater);
  expect_numbers(pass, 2, kHead + kLater, kHead + 2 * kLater);
}

// Mean of all pixels over passes, its standard error, and the rays.
struct Mean {
  double value = 0, error = 0, rays = 0;
};
Mean mean_of(const View& view, const PairPass& pass, uint32_t passes,
             const IntegratorOptions& options = {}) {
  Mean mean;
  double squares = 0;
  for (uint32_t i = 0; i < passes; ++i) {
    Film film = film_for(*view.scene, view.preset);
    EstimatorStatistics statistics;
    pass.render({3, i}, *view.scene, film, view.owned, options, statistics);
    double sum = 0;
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 12; ++x) sum += static_cast<double>(film.value(x, y).g) / 96;
    mean.value += sum / passes;
    squares += sum * sum / passes;
    mean.rays += static_cast<double>(statistics.rays);
  }
  mean.error = std::sqrt((squares - mean.value * mean.value) / passes);
  return mean;
}

TEST(PairPass, FindsTheSameLightHoweverLongItsCameraPathsAre) {
  const View box(R"(
    Shape "bilinearmesh" "point3 P" [-4 4.2 -4  4 4.2 -4  -4 4.2 4  4 4.2 4]
    Shape "bilinearmesh" "point3 P" [-4 0 4  4 0 4  -4 5 4  4 5 4]
    AttributeBegin AreaLightSource "diffuse" "rgb L" [2 2 2]
    Shape "bilinearmesh" "point3 P" [-4 0 -4  4 0 -4  -4 5 -4  4 5 -4] AttributeEnd)");
  PairPass pass = camera_paths_only();
  const Mean one = mean_of(box, pass, 200);
  double rays = one.rays;
  for (const float window : {kCameraWindow, kPatientWindow}) {
    pass.window = window;
    const Mean longer = mean_of(box, pass, 200);
    EXPECT_NEAR(longer.value, one.value, 4 * std::hypot(longer.error, one.error)) << window;
    EXPECT_LT(longer.error, 0.02 * longer.value);
    EXPECT_GT(longer.rays, 1.05 * rays) << window;
    rays = longer.rays;
  }
}

TEST(PairPass, LeavesCausticsToWalksWhereThereAreNoPhotons) {
  const View view(R"(
    AttributeBegin AreaLightSource "diffuse" "rgb L" [2 2 2] Translate 0 9 0
    Shape "sphere" "float radius" 3 AttributeEnd
    Material "dielectric" Translate 0 0.8 0 Shape "sphere" "float radius" 0.6)");
  PairPass pass = camera_paths_only();
  const Mean walks = mean_of(view, pass, 200);
  pass.light_paths = 1 << 14;
  // Pixels are large here: with the radius of a picture, merging adds five per cent.
  IntegratorOptions options;
  options.radius = 0.2f;
  const Mean both = mean_of(view, pass, 100, options);
  EXPECT_NEAR(walks.value, both.value, 4 * std::hypot(walks.error, both.error));
  EXPECT_LT(walks.error, 0.02 * walks.value);
}

TEST(PairPass, TellsTheSameSpreadInBatches) {
  const View view(R"(
    LightSource "point" "rgb I" [9 9 9] "point3 from" [1.5 2.2 0.7]
    Material "dielectric" Translate 0 0.8 0 Shape "sphere" "float radius" 0.6)");
  PairPass pass = camera_paths_only();
  pass.light_paths = 100000;
  const Film film = film_for(*view.scene, view.preset);
  SampleMap map(film.bounds());
  for (uint16_t& n : map.counts()) n = 4;
  pass.samples = &map;
  const auto spread = [&](int64_t memory) {
    IntegratorOptions options;
    options.memory_photons = memory;
    SampleSpread found(film.bounds());
    pass.spread = &found;
    EstimatorStatistics statistics;
    pass.try_out({3, 0}, *view.scene, film, view.owned, options, statistics);
    EXPECT_GT(statistics.photons_stored, 100u);
    return found.by_tile();
  };
  const SampleSpread::ByTile whole = spread(1 << 20), batches = spread(1);
  double most = 0;
  for (size_t i = 0; i < whole.variance.size(); ++i) {
    EXPECT_NEAR(batches.variance[i], whole.variance[i], 1e-3 * whole.variance[i] + 1e-6);
    EXPECT_GE(batches.cost[i], whole.cost[i]) << "each batch has its own walks";
    most = std::max(most, whole.variance[i]);
  }
  EXPECT_GT(most, 0);
}

}  // namespace
}  // namespace nephroid
