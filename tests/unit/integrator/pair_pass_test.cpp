// Passes of path+photons as they are numbered and measured: later passes go on where the first one
// ended, and what a pass tells of its variance does not depend on memory.
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
  PairPass pass_of(const PairTechniques& techniques, uint32_t number,
                   const IntegratorOptions& options) const {
    return {.key = {3, number},
            .seed = 3,
            .scene = *scene,
            .owned = owned,
            .options = options,
            .techniques = techniques,
            .light_paths_vary = true};
  }
  Film render(const PairTechniques& techniques, uint32_t number, const SampleMap& map,
              uint32_t in_first_pass = 0) const {
    Film film = film_for(*scene, preset);
    EstimatorStatistics statistics;
    nephroid::render(pass_of(techniques, number, {}),
                     {.film = film, .samples = {map, no_walks, in_first_pass}}, statistics);
    return film;
  }
  std::unique_ptr<Scene> scene;
  Preset preset;
  OwnedRoutes owned;
  PixelBounds bounds = film_for(*scene, preset).bounds();
  SampleMap one_path{bounds}, no_walks{bounds, 0};
};

PairTechniques camera_paths_only() {
  return {.light_paths = 0, .connects = false, .caustics_only = true};
}

// Light that depends on the place alone: over that of even light in the same pass, which has the
// same colours, a pixel tells where its paths came down.
struct Places {
  View uneven{R"(LightSource "point" "rgb I" [9 9 9] "point3 from" [1.5 1.2 0.7])"};
  View even{R"(LightSource "distant" "rgb L" [1 1 1] "point3 from" [0 1 0] "point3 to" [0 0 0])"};

  std::vector<double> of(uint32_t number, const SampleMap& map, uint32_t in_first_pass = 0) const {
    const Film a = uneven.render(camera_paths_only(), number, map, in_first_pass),
               b = even.render(camera_paths_only(), number, map, in_first_pass);
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
    single.push_back(places.of(i, places.even.one_path));
  const auto expect_numbers = [&](const SampleMap& map, uint32_t in_first_pass, uint32_t number,
                                  uint32_t begin, uint32_t end) {
    const std::vector<double> found = places.of(number, map, in_first_pass);
    for (size_t pixel = 0; pixel < found.size(); ++pixel) {
      double sum = 0;
      for (uint32_t i = begin; i < end; ++i) sum += single[i][pixel];
      const double expected = sum / (end - begin);
      ASSERT_NEAR(found[pixel], expected, 2e-3 * expected)
          << "pass " << number << ", pixel " << pixel;
    }
  };
  const SampleMap first(places.even.bounds, kHead), later(places.even.bounds, kLater);
  expect_numbers(first, 0, 0, 0, kHead);
  expect_numbers(later, kHead, 1, kHead, kHead + kLater);
  expect_numbers(later, kHead, 2, kHead + kLater, kHead + 2 * kLater);
}

// Mean of all pixels over passes, its standard error, and the rays.
struct Mean {
  double value = 0, error = 0, rays = 0;
};
Mean mean_of(const View& view, const PairTechniques& techniques, uint32_t passes,
             const IntegratorOptions& options = {}) {
  Mean mean;
  double squares = 0;
  for (uint32_t i = 0; i < passes; ++i) {
    Film film = film_for(*view.scene, view.preset);
    EstimatorStatistics statistics;
    render(view.pass_of(techniques, i, options),
           {.film = film, .samples = {view.one_path, view.no_walks}}, statistics);
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
  PairTechniques pass = camera_paths_only();
  const Mean one = mean_of(box, pass, 200);
  double rays = one.rays;
  for (const float window : {kCameraRouletteThreshold, kPatientRouletteThreshold}) {
    pass.roulette_threshold = window;
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
  PairTechniques pass = camera_paths_only();
  const Mean walks = mean_of(view, pass, 200);
  pass.light_paths = 1 << 14;
  // Pixels are large here: with the radius of a picture, merging adds five per cent.
  IntegratorOptions options;
  options.radius = 0.2f;
  const Mean both = mean_of(view, pass, 100, options);
  EXPECT_NEAR(walks.value, both.value, 4 * std::hypot(walks.error, both.error));
  EXPECT_LT(walks.error, 0.02 * walks.value);
}

TEST(PairPass, TellsTheSameVarianceInBatches) {
  const View view(R"(
    LightSource "point" "rgb I" [9 9 9] "point3 from" [1.5 2.2 0.7]
    Material "dielectric" Translate 0 0.8 0 Shape "sphere" "float radius" 0.6)");
  PairTechniques pass = camera_paths_only();
  pass.light_paths = 100000;
  const SampleMap map(view.bounds, 4);
  const FilmFormat format = film_for(*view.scene, view.preset).format();
  const auto variance = [&](int64_t memory) {
    IntegratorOptions options;
    options.memory_photons = memory;
    SampleVariance found(view.bounds);
    EstimatorStatistics statistics;
    try_out(view.pass_of(pass, 0, options), format, {.paths = map}, found, statistics);
    EXPECT_GT(statistics.photons_stored, 100u);
    return found.by_tile();
  };
  const SampleVariance::ByTile whole = variance(1 << 20), batches = variance(1);
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
