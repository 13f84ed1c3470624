// Whole renders with outlier rejection: for every preset, kept and rejected light add up to the
// plain picture. Fireflies go, photon caustics stay.
#include <gtest/gtest.h>

#include "core/parallel.h"
#include "rendering.h"
#include "session/film_of_scene.h"
#include "session/learn_lights.h"
#include "session/report/noise.h"

namespace nephroid {
namespace {

using namespace testing_support;

// A rough mirror, and a small lamp that paths through the glass hit only by chance.
const char* const kOutlierScene = R"(
  LookAt 0 4 -5  0 0.4 0  0 1 0
  Camera "perspective" "float fov" 40
  Film "rgb" "integer xresolution" 32 "integer yresolution" 32
  PixelFilter "gaussian"
  WorldBegin
  AttributeBegin
    AreaLightSource "diffuse" "rgb L" [250 230 210]
    Translate 1.5 3 -0.5 Rotate 90 1 0 0
    Shape "disk" "float radius" 0.12
  AttributeEnd
  LightSource "infinite" "rgb L" [0.2 0.25 0.3]
  Material "diffuse" "rgb reflectance" [0.6 0.5 0.4]
  Shape "bilinearmesh" "point3 P" [-4 0 -4  4 0 -4  -4 0 4  4 0 4]
  Material "conductor" "float roughness" 0.2
  AttributeBegin Translate 1.2 0.5 0.6 Shape "sphere" "float radius" 0.5 AttributeEnd
  Material "dielectric" "float eta" 1.5
  AttributeBegin Translate -0.5 0.8 0 Shape "sphere" "float radius" 0.7 AttributeEnd
)";

IntegratorOptions options_of_test() {
  IntegratorOptions options;
  options.photons_per_pass = 8000;
  return options;
}

Film render_rejecting(const Scene& scene, const Plan& plan, uint64_t seed, uint32_t passes) {
  const IntegratorOptions options = options_of_test();
  EstimatorSet set = make_estimators(plan, options, scene);
  Film film = film_for(scene, set);
  film.reject_outliers(outlier_settings(*set.routes, options, *scene.filter, film.bounds().area()));
  for (uint32_t pass = 0; pass < passes; ++pass) {
    set.render_pass({seed, pass}, scene, film);
    film.finish_pass();
  }
  return film;
}

/// Calls body(x, y, c) for every channel of every pixel.
template <class Body>
void for_each_channel(const Film& film, const Body& body) {
  const PixelBounds& b = film.bounds();
  for (int y = b.y0; y < b.y1; ++y)
    for (int x = b.x0; x < b.x1; ++x)
      for (int c = 0; c < 3; ++c) body(x, y, c);
}

/// Mean of (x-r)^2 / (r^2 + 0.01).
double relative_error(const Film& reference, const Film& film) {
  double sum = 0;
  for_each_channel(film, [&](int x, int y, int c) {
    const double r = reference.value(x, y)[c], v = film.value(x, y)[c];
    sum += (v - r) * (v - r) / (r * r + 0.01);
  });
  return sum / (3.0 * static_cast<double>(film.bounds().area()));
}

class Outliers : public ::testing::TestWithParam<std::string> {};

TEST_P(Outliers, AreThePicturesOwnLightForAnyNumberOfThreads) {
  const auto scene = scene_from_text(kOutlierScene);
  const Film plain = render(*scene, GetParam(), options_of_test(), 3, 4);
  std::vector<Film> films;
  for (const int threads : {1, 3}) {
    const ThreadLimit limit(threads);
    films.push_back(render_rejecting(*scene, GetParam(), 3, 4));
  }
  const Film& film = films[0];
  for_each_channel(film, [&](int x, int y, int c) {
    const float kept = film.value(x, y)[c], held = film.outliers(x, y)[c];
    ASSERT_EQ(films[1].value(x, y)[c], kept);
    ASSERT_EQ(films[1].outliers(x, y)[c], held);
    ASSERT_NEAR(kept + held, plain.value(x, y)[c], 1e-6f * (std::abs(kept) + std::abs(held)));
    // The error is computed from the sums of both layers: equal bits show that nothing was lost.
    ASSERT_EQ(film.standard_error(x, y)[c], plain.standard_error(x, y)[c]);
  });
}

INSTANTIATE_TEST_SUITE_P(AllRoutes, Outliers, ::testing::ValuesIn(plan_names()),
                         [](const auto& test) { return test_name(test.param); });

TEST(OutliersOfPath, FirefliesGo) {
  const auto scene = scene_from_text(kOutlierScene);
  const Film reference = render(*scene, "path", options_of_test(), 100, 1024);
  const Film plain = render(*scene, "path", options_of_test(), 1, 32);
  const Film film = render_rejecting(*scene, "path", 1, 32);
  EXPECT_LT(relative_error(reference, film), 0.5 * relative_error(reference, plain));
  EXPECT_GT(energy_shares(film).outliers, 0.0);
}

TEST(OutliersOfPhotons, CausticsStay) {
  const auto scene = scene_from_text(kOutlierScene);
  const auto caustic = [&](const Film& film) {
    double sum = 0;
    for_each_channel(film, [&](int x, int y, int c) { sum += film.route_value(0, x, y)[c]; });
    return sum;
  };
  const Film plain = render(*scene, "doidge2012", options_of_test(), 1, 32);
  const Film film = render_rejecting(*scene, "doidge2012", 1, 32);
  ASSERT_EQ(plain.layout().routes[0], "caustic");
  EXPECT_GT(energy_shares(plain).routes[0], 0.03);
  EXPECT_GT(caustic(film), 0.97 * caustic(plain));
  EXPECT_LT(energy_shares(film).outliers, 0.02);
}

// A window and a small lamp light a table, without glass. Light that is only sampled rarely is not
// an outlier: no region loses it.
TEST(OutliersOfMixed, NoRegionLosesLightThatIsSampledRarely) {
  const auto scene = scene_from_text(R"(
    Scale -1 1 1
    LookAt 18.8091 -25.8885 16  0 0 3.2  0 0 1
    Camera "perspective" "float fov" 28
    Film "rgb" "integer xresolution" 320 "integer yresolution" 240
    WorldBegin
    AttributeBegin
      AreaLightSource "diffuse" "blackbody L" 6500 "float scale" 2.5
      Shape "bilinearmesh" "point3 P" [-40 -20 5  -40 20 5  -40 -20 45  -40 20 45]
    AttributeEnd
    AttributeBegin
      Translate 12 18 22
      AreaLightSource "diffuse" "blackbody L" 4000 "float scale" 500
      Shape "sphere" "float radius" 0.6
    AttributeEnd
    Material "diffuse" "rgb reflectance" [0.5 0.45 0.4]
    Shape "bilinearmesh" "point3 P" [-100 -60 0  100 -60 0  -100 100 0  100 100 0])");
  SignalFlags signals;
  ASSERT_TRUE(learn_lights(*scene, signals, [] { return 0.0; }));
  constexpr int kRegion = 16, kAcross = 320 / kRegion, kRegions = kAcross * 240 / kRegion;
  const SeedValues found = values_over_seeds(8, 0, [&](uint64_t seed) {
    const Film film = render_rejecting(*scene, "mixed", seed, 4);
    std::vector<double> sums(2 * kRegions, 0.0);
    for_each_channel(film, [&](int x, int y, int c) {
      const auto region = static_cast<size_t>(y / kRegion * kAcross + x / kRegion);
      const auto held = static_cast<double>(film.outliers(x, y)[c]);
      sums[2 * region] += held;
      sums[2 * region + 1] += held + static_cast<double>(film.value(x, y)[c]);
    });
    return sums;
  });
  for (size_t region = 0; region < kRegions; ++region)
    EXPECT_LE(estimate_of(found[2 * region]).mean,
              max_error(0.01 * estimate_of(found[2 * region + 1]).mean))
        << region;
}

}  // namespace
}  // namespace nephroid
