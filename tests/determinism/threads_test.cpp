// The same bits for any number of threads and for any order of the passes, by all integrators and
// all presets of routes.
#include <gtest/gtest.h>

#include "core/parallel.h"
#include "rendering.h"

namespace nephroid {
namespace {

using namespace testing_support;

const char* const kScene = R"(
  LookAt 0 1 -6  0 0.8 0  0 1 0
  Camera "perspective" "float fov" 35 "float lensradius" 0.02 "float focaldistance" 6
  Film "rgb" "integer xresolution" 24 "integer yresolution" 20
  PixelFilter "mitchell"
  WorldBegin
  AttributeBegin
    Translate 0 3 0
    AreaLightSource "diffuse" "rgb L" [9 8 7] "bool twosided" true
    Shape "disk" "float radius" 0.5 "float height" 0
  AttributeEnd
  LightSource "point" "rgb I" [2 3 4] "point3 from" [2 2 -3]
  Material "diffuse" "rgb reflectance" [0.6 0.5 0.4]
  Shape "bilinearmesh" "point3 P" [-4 0 -4  4 0 -4  -4 0 4  4 0 4]
  Material "dielectric" "spectrum eta" "glass-SF11"
  AttributeBegin Translate -0.8 0.7 0 Shape "sphere" "float radius" 0.6 AttributeEnd
  Material "coateddiffuse" "rgb reflectance" [0.2 0.5 0.3] "float roughness" 0.2
  AttributeBegin Translate 0.8 0.7 0 Shape "sphere" "float radius" 0.6 AttributeEnd
  LightSource "infinite" "rgb L" [0.2 0.3 0.4]
  MakeNamedMaterial "paint" "string type" "diffuse" "rgb reflectance" [0.7 0.2 0.2]
  MakeNamedMaterial "metal" "string type" "conductor" "float roughness" 0.1
  MakeNamedMaterial "gap" "string type" "interface"
  MakeNamedMaterial "half" "string type" "mix" "string materials" ["paint" "gap"] "float amount" 0.5
  Material "mix" "string materials" ["half" "metal"] "float amount" 0.3
  Shape "bilinearmesh" "point3 P" [-2 0.2 -2  0 0.2 -2  -2 0.2 0  0 0.2 0]
  Material "diffuse" "rgb reflectance" [0.3 0.6 0.3]
  Shape "bilinearmesh" "point3 P" [0 0.3 -2  2 0.3 -2  0 0.3 0  2 0.3 0] "float alpha" 0.5
  ObjectBegin "ball"
    Material "coatedconductor" "float interface.roughness" 0.1 "float conductor.roughness" 0.3
      "float g" 0.4 "rgb albedo" [0.5 0.4 0.3]
    Shape "loopsubdiv" "integer levels" 2
      "integer indices" [0 2 4 2 1 4 1 3 4 3 0 4 2 0 5 1 2 5 3 1 5 0 3 5]
      "point3 P" [0.5 0 0  -0.5 0 0  0 0.5 0  0 -0.5 0  0 0 0.5  0 0 -0.5]
  ObjectEnd
  AttributeBegin Translate 0 1.6 0.5 ObjectInstance "ball" AttributeEnd
  AttributeBegin Translate -0.2 0.4 -1.5 ActiveTransform EndTime Translate 0.4 0 0 Rotate 150 1 0 1
    ObjectInstance "ball" AttributeEnd
  AttributeBegin Translate -1.2 1.8 1 Scale 1 0.6 1.4 Rotate 40 1 1 0 ObjectInstance "ball" AttributeEnd
  MakeNamedMedium "smoke" "string type" "uniformgrid" "integer nx" 2 "integer ny" 1 "integer nz" 2
    "float density" [0.2 1 0.6 0.1] "rgb sigma_s" [1.5 1 0.5] "rgb sigma_a" [0.1 0.2 0.3]
  AttributeBegin MediumInterface "smoke" "" Material "interface" Translate 0.6 0.6 0.6
    Shape "sphere" "float radius" 0.6 AttributeEnd
  AttributeBegin Material "hair" "float eumelanin" 0.5
    Shape "curve" "point3 P" [-1.2 0.2 -1  -0.4 0.9 -1.3  0.4 0.2 -1  1.2 0.9 -1]
      "float width" 0.1 AttributeEnd
  AttributeBegin Material "subsurface" "rgb mfp" [0.2 0.1 0.05] "rgb reflectance" [0.8 0.6 0.5]
    Translate 1.6 0.5 -0.5 Shape "sphere" "float radius" 0.4 AttributeEnd
  Material "diffuse" "rgb reflectance" [0.4 0.4 0.7]
  Shape "trianglemesh" "integer indices" [0 1 2 0 2 3]
    "point3 P" [-3 0 2  3 0 2  3 3 2.5  -3 3 2.5] "normal N" [-1 0 -1  1 0 -1  1 0 -1  -1 0 -1]
  )";

void expect_same_bits(const Film& a, const Film& b, const std::string& what) {
  const PixelBounds& bounds = a.bounds();
  for (int y = bounds.y0; y < bounds.y1; ++y)
    for (int x = bounds.x0; x < bounds.x1; ++x) {
      ASSERT_EQ(a.depth(x, y), b.depth(x, y)) << what << ": depth of pixel " << x << ' ' << y;
      ASSERT_EQ(a.bias(x, y), b.bias(x, y)) << what << ": bias of " << x << ' ' << y;
      ASSERT_EQ(a.bias_error(x, y), b.bias_error(x, y)) << what << ' ' << x << ' ' << y;
      for (int c = 0; c < 3; ++c) {
        ASSERT_EQ(a.albedo(x, y)[c], b.albedo(x, y)[c]) << what << ": albedo of " << x << ' ' << y;
        ASSERT_EQ(a.normal(x, y)[c], b.normal(x, y)[c]) << what << ": normal of " << x << ' ' << y;
        ASSERT_EQ(a.standard_error(x, y)[c], b.standard_error(x, y)[c])
            << what << ": standard error of " << x << ' ' << y;
      }
      for (int r = 0; r < static_cast<int>(a.layout().routes.size()); ++r) {
        const Rgb u = a.route_value(r, x, y), v = b.route_value(r, x, y);
        for (int c = 0; c < 3; ++c)
          ASSERT_EQ(u[c], v[c]) << what << ": pixel " << x << ' ' << y << " route " << r;
      }
    }
}

// The features are compared above; they must not all be zero.
void expect_features(const Film& film) {
  double albedo = 0, depth = 0, normal = 0;
  const PixelBounds& b = film.bounds();
  for (int y = b.y0; y < b.y1; ++y)
    for (int x = b.x0; x < b.x1; ++x) {
      albedo += static_cast<double>(film.albedo(x, y).g);
      depth += static_cast<double>(film.depth(x, y));
      normal += static_cast<double>(length(film.normal(x, y)));
    }
  const double pixels = static_cast<double>(b.area());
  EXPECT_GT(albedo, 0.1 * pixels);
  EXPECT_GT(depth, 3 * pixels);
  EXPECT_GT(normal, 0.5 * pixels);
}

class Determinism : public ::testing::TestWithParam<std::string> {};

TEST_P(Determinism, AnyNumberOfThreads) {
  const auto scene = scene_from_text(kScene);
  IntegratorOptions options;
  options.photons_per_pass = 20000;
  std::vector<Film> films;
  for (const int threads : {1, 2, 7}) {
    const ThreadLimit limit(threads);
    films.push_back(render(*scene, GetParam(), options, 5, 3));
  }
  expect_same_bits(films[0], films[1], "1 and 2 threads");
  expect_same_bits(films[0], films[2], "1 and 7 threads");
  EXPECT_GT(picture_mean(films[0]), 0.0);
  expect_features(films[0]);
}

TEST_P(Determinism, AnyOrderOfIndependentPasses) {
  const auto scene = scene_from_text(kScene);
  IntegratorOptions options;
  options.photons_per_pass = 20000;
  Preset forwards = make_preset(plan_named(GetParam()), options, *scene);
  for (const auto& e : forwards.estimators)
    if (!e->capabilities().independent_passes) GTEST_SKIP() << "passes are a sequence";
  Preset backwards = make_preset(plan_named(GetParam()), options, *scene);
  Film a = film_for(*scene, forwards), b = film_for(*scene, backwards);
  for (uint32_t pass = 0; pass < 4; ++pass) {
    for (const auto& e : forwards.estimators) e->render_pass({5, pass}, *scene, a);
    for (const auto& e : backwards.estimators) e->render_pass({5, 3 - pass}, *scene, b);
  }
  expect_same_bits(a, b, "passes forwards and backwards");
}

TEST_P(Determinism, BatchesOfPhotonsLoseNothing) {
  // A pass in many batches gathers the same photons: equal up to the rounding of the sums.
  const auto scene = scene_from_text(kScene);
  IntegratorOptions whole, batched;
  whole.photons_per_pass = batched.photons_per_pass = 100000;
  batched.memory_photons = 1;  // as few photons at once as there can be
  const Preset preset = make_preset(plan_named(GetParam()), whole, *scene);
  for (const RouteGroup& group : preset.routes->groups())
    if (group.estimator == EstimatorKind::kPhotonMap)
      GTEST_SKIP() << "memory ends a map; it has no batches";
  const Film a = render(*scene, GetParam(), whole, 5, 1),
             b = render(*scene, GetParam(), batched, 5, 1);
  const PixelBounds& bounds = a.bounds();
  for (int y = bounds.y0; y < bounds.y1; ++y)
    for (int x = bounds.x0; x < bounds.x1; ++x)
      for (int c = 0; c < 3; ++c)
        ASSERT_NEAR(a.value(x, y)[c], b.value(x, y)[c], 1e-4 * (0.01 + std::abs(a.value(x, y)[c])));
}

INSTANTIATE_TEST_SUITE_P(AllRoutes, Determinism, ::testing::ValuesIn(plan_names()),
                         [](const auto& test) { return test_name(test.param); });

}  // namespace
}  // namespace nephroid
