// Inspections of pixels: words, vertices and shares of closed-form scenes, and agreement with the
// mean of many passes for estimators of all kinds.
#include "session/inspect.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/errors.h"
#include "core/parallel.h"
#include "integrator/path/path_options.h"
#include "rendering.h"

namespace nephroid {
namespace {

using namespace testing_support;

constexpr char kView[] = R"(
  LookAt 0 4 -3  0 0 0  0 1 0
  Camera "perspective" "float fov" 40
  PixelFilter "box" "float xradius" 0.5 "float yradius" 0.5
  Film "rgb" "integer xresolution" 15 "integer yresolution" 11)";
constexpr char kFloor[] = R"(
  WorldBegin
  MakeNamedMaterial "floor" "string type" "diffuse" "rgb reflectance" [0.6 0.6 0.6]
  NamedMaterial "floor"
  Shape "bilinearmesh" "point3 P" [-8 0 -8  8 0 -8  -8 0 8  8 0 8])";

constexpr char kKey[] = R"(
  LightSource "point" "string name" "key" "rgb I" [9 9 9] "point3 from" [0 3 0.2])";

// A ball of glass over the middle of the floor, in the light of the lamp above and of the sky. The
// caustic lies below the ball and is seen through it, or beside it.
constexpr char kInspectedBall[] = R"(
  LightSource "infinite" "string name" "sky" "rgb L" [0.3 0.3 0.4]
  MakeNamedMaterial "glass" "string type" "dielectric" "float eta" 1.5
  NamedMaterial "glass"
  Translate 0 1.2 0.6
  Shape "sphere" "float radius" 0.5)";
const Vec3f kMiddleOfBall(0, 1.2f, 0.6f);
constexpr float kRadiusOfBall = 0.5f;

struct Inspected {
  /// `film_parameters` end the Film directive.
  Inspected(const std::string& world, const Plan& plan, uint32_t passes = 1,
            const std::string& film_parameters = "")
      : scene(scene_from_text(kView + film_parameters + kFloor + world)),
        set(make_estimators(plan, options(), *scene)),
        film(film_for(*scene, set)) {
    for (uint32_t pass = 0; pass < passes; ++pass) set.render_pass({kSeed, pass}, *scene, film);
  }
  /// All passes have the same radius, so that all estimates have the same bias.
  static IntegratorOptions options() {
    IntegratorOptions options;
    options.shrink_alpha = 1;
    options.photons_per_pass = 10000;
    options.radius = 0.4f;
    options.edit<PathOptions>().specular_trees = true;
    return options;
  }
  PixelInspection at(int x, int y) {
    InspectionSettings settings;
    settings.seed = kSeed;
    settings.options = options();
    return inspect_pixel(*scene, set, film, x, y, settings);
  }
  static constexpr uint64_t kSeed = 5;
  std::unique_ptr<Scene> scene;
  EstimatorSet set;
  Film film;
};

double luminance(const Rgb& color) {
  return RgbColorSpace::srgb().to_xyz(color).y;
}

double distance_to_segment(const Vec3f& p, const Vec3f& a, const Vec3f& b) {
  const float t = std::clamp(dot(p - a, b - a) / length_squared(b - a), 0.0f, 1.0f);
  return length(a + (b - a) * t - p);
}

const InspectedPath* path_of(const PixelInspection& found, const std::string& word) {
  const auto at = std::ranges::find(found.paths, word, &InspectedPath::word);
  return at != found.paths.end() ? &*at : nullptr;
}

TEST(Inspect, NamesTheLampThatLightsAFloor) {
  for (const char* integrator : {"path-only", "mixed", "bpm", "all-photons"}) {
    Inspected view(kKey, integrator);
    const PixelInspection found = view.at(7, 5);
    ASSERT_EQ(found.paths.size(), 1u) << integrator;
    const InspectedPath& path = found.paths[0];
    EXPECT_EQ(path.word, "C <RD'floor'> <L.'key'>");
    EXPECT_EQ(path.light, "key");
    EXPECT_DOUBLE_EQ(path.share, 1);
    ASSERT_EQ(found.lights.size(), 1u);
    EXPECT_EQ(found.lights[0].name, "key");
    EXPECT_NEAR(found.lights[0].share, 1, 1e-6);
    ASSERT_EQ(path.points.size(), 3u);
    EXPECT_NEAR(length(path.points[0] - Vec3f(0, 4, -3)), 0, 1e-4);
    EXPECT_NEAR(path.points[1].y, 0, 1e-4);
    EXPECT_NEAR(length(path.points[2] - Vec3f(0, 3, 0.2f)), 0, 1e-3);
    // The floor is seen in the pixel itself.
    EXPECT_NEAR(path.pixels[1].x, 7.5f, 0.51f);
    EXPECT_NEAR(path.pixels[1].y, 5.5f, 0.51f);
    // I / d^2 * cos * reflectance / pi at the middle of the pixel.
    const Vec3f way = Vec3f(0, 3, 0.2f) - path.points[1];
    const double expected =
        9 * static_cast<double>(way.y) / std::pow(length(way), 3) * 0.6 / double{kPi};
    EXPECT_NEAR(found.traced.g, expected, 0.05 * expected) << integrator;
  }
}

TEST(Inspect, FindsTheCasterOfACaustic) {
  Inspected view(std::string(kKey) + kInspectedBall, "mixed");
  const PixelInspection found = view.at(7, 3);
  const InspectedPath* caustic = path_of(found, "C <RD'floor'> <TS'glass'> <TS'glass'> <L.'key'>");
  ASSERT_NE(caustic, nullptr);
  EXPECT_EQ(caustic->route, "caustic");
  EXPECT_EQ(caustic->technique, "photon merging");
  EXPECT_GT(caustic->share, 0.05);
  // Lens, floor, two points of the ball, lamp.
  ASSERT_EQ(caustic->points.size(), 5u);
  for (const int i : {2, 3})
    EXPECT_NEAR(length(caustic->points[i] - kMiddleOfBall), kRadiusOfBall, 1e-3);
  EXPECT_LT(distance_to_segment(kMiddleOfBall, caustic->points[2], caustic->points[3]),
            kRadiusOfBall);
  EXPECT_NEAR(length(caustic->points[4] - Vec3f(0, 3, 0.2f)), 0, 1e-3);
}

TEST(Inspect, FollowsBothWaysAtGlass) {
  Inspected view(std::string(kKey) + kInspectedBall, "bpm");
  const PixelInspection found = view.at(7, 2);
  const InspectedPath* path = path_of(found, "C <TS'glass'> <TS'glass'> <RD'floor'> <B.'sky'>");
  ASSERT_NE(path, nullptr);
  ASSERT_EQ(path->points.size(), 5u);
  for (const int i : {1, 2})
    EXPECT_NEAR(length(path->points[i] - kMiddleOfBall), kRadiusOfBall, 1e-3);
  EXPECT_NEAR(path->points[3].y, 0, 1e-4);
  // The sky is far away.
  EXPECT_GT(length(path->points[4]), 10);
  const InspectedPath* mirrored = path_of(found, "C <RS'glass'> <B.'sky'>");
  ASSERT_NE(mirrored, nullptr);
  EXPECT_EQ(mirrored->technique, "specular chains");
  ASSERT_EQ(mirrored->points.size(), 3u);
  EXPECT_NEAR(length(mirrored->points[1] - kMiddleOfBall), kRadiusOfBall, 1e-3);
}

TEST(Inspect, NamesMedia) {
  Inspected view(std::string(kKey) + R"(
    MakeNamedMedium "fog" "string type" "homogeneous" "rgb sigma_s" [2 2 2] "rgb sigma_a" [0 0 0]
    MakeNamedMedium "fire" "string type" "homogeneous" "rgb sigma_s" [0 0 0] "rgb sigma_a" [1 1 1]
      "rgb Le" [1 1 1]
    Material "interface"
    AttributeBegin MediumInterface "fog" "" Translate 0 1 0
      Shape "sphere" "float radius" 0.5 AttributeEnd
    AttributeBegin MediumInterface "fire" "" Translate 2 1 0
      Shape "sphere" "float radius" 0.5 AttributeEnd)",
                 "mixed");
  const PixelInspection fog = view.at(7, 4);
  const InspectedPath* in_fog = path_of(fog, "C <V'fog'> <L.'key'>");
  ASSERT_NE(in_fog, nullptr);
  // Where light goes straight through there is no vertex.
  ASSERT_EQ(in_fog->points.size(), 3u);
  EXPECT_LT(length(in_fog->points[1] - Vec3f(0, 1, 0)), 0.5f);
  for (int x = 0; x < 15; ++x) {
    const PixelInspection found = view.at(x, 4);
    if (const InspectedPath* glow = path_of(found, "C <M.'fire'>")) {
      EXPECT_EQ(glow->light, "fire");
      EXPECT_EQ(glow->route, "emission");
      return;
    }
  }
  FAIL() << "the glowing medium was not found";
}

TEST(Inspect, ShowsBothEndsOfSubsurfaceLight) {
  Inspected view(std::string(kKey) + R"(
    MakeNamedMaterial "wax" "string type" "subsurface" "rgb mfp" [0.1 0.1 0.1]
      "rgb reflectance" [0.5 0.5 0.5]
    NamedMaterial "wax" Translate 0 0.5 0 Shape "sphere" "float radius" 0.5)",
                 "path-only");
  const PixelInspection found = view.at(7, 5);
  const InspectedPath* path = path_of(found, "C <TD'wax'> <L.'key'>");
  ASSERT_NE(path, nullptr);
  ASSERT_EQ(path->points.size(), 4u);
  for (const int i : {1, 2}) EXPECT_NEAR(length(path->points[i] - Vec3f(0, 0.5f, 0)), 0.5f, 1e-3);
  EXPECT_GT(length(path->points[1] - path->points[2]), 1e-4f);
}

// A word is an expression: a layer of that expression has the light of the word.
TEST(Inspect, FindsTheLightOfEachWord) {
  const std::string world = std::string(kKey) + kInspectedBall;
  constexpr size_t kWords = 3;
  const PixelInspection found = Inspected(world, "mixed").at(7, 4);
  RoutePlan plan = plan_named("mixed");
  for (size_t i = 0; i < kWords; ++i)
    plan.aovs.push_back(parse_aov(fmt::format("word{}={}", i, found.paths[i].word)));
  const auto scene = scene_from_text(std::string(kView) + kFloor + world);
  const PlanLearned learned = learn(*scene, plan, Inspected::options(), 1);
  const SeedValues values = values_over_seeds(16, 1, [&](uint64_t seed) {
    const Film film = render(*scene, plan, Inspected::options(), seed, 6, 0, learned);
    std::vector<double> layers;
    for (size_t i = 0; i < kWords; ++i)
      layers.push_back(luminance(film.aov_value(static_cast<int>(i), 7, 4)));
    return layers;
  });
  for (size_t i = 0; i < kWords; ++i) {
    const Estimate layer = estimate_of(values[i]);
    const InspectedPath& path = found.paths[i];
    const double error =
        path.share_error * luminance(found.traced) + path.share * found.traced_error;
    EXPECT_NEAR(luminance(path.value), layer.mean, 5 * std::hypot(error, layer.error)) << path.word;
    EXPECT_LT(std::hypot(error, layer.error), 0.15 * layer.mean + 0.01 * luminance(found.traced))
        << path.word;
  }
}

void expect_agreement(const char* integrator, uint32_t passes,
                      const std::string& film_parameters = "") {
  Inspected view(std::string(kKey) + kInspectedBall, integrator, passes, film_parameters);
  for (const Vec2i& pixel : {Vec2i(7, 3), Vec2i(7, 5), Vec2i(2, 9)}) {
    const PixelInspection found = view.at(pixel.x, pixel.y);
    const std::string where = fmt::format("{} at {},{}", integrator, pixel.x, pixel.y);
    const double error = std::hypot(luminance(found.standard_error), found.traced_error) + 1e-5;
    EXPECT_NEAR(luminance(found.traced), luminance(found.value), 5 * error) << where;
    EXPECT_LT(error, 0.12 * luminance(found.value)) << where;
    double of_lights = 0, of_techniques = 0, of_routes = 0;
    for (const EstimatedShare& light : found.lights) of_lights += luminance(light.value);
    for (const EstimatedShare& t : found.techniques) of_techniques += luminance(t.value);
    for (const Share& route : found.routes) of_routes += luminance(route.value);
    EXPECT_NEAR(of_lights, luminance(found.traced), 1e-4 * luminance(found.traced)) << where;
    EXPECT_NEAR(of_techniques, luminance(found.traced), 1e-4 * luminance(found.traced)) << where;
    EXPECT_NEAR(of_routes, luminance(found.value), 1e-4 * luminance(found.value)) << where;
  }
}

TEST(Inspect, AgreesWithPathTracing) {
  expect_agreement("path-only", 400);
}
TEST(Inspect, AgreesWithPathsAndPhotons) {
  expect_agreement("mixed", 100);
}
TEST(Inspect, AgreesWithPhotonsBesidePaths) {
  expect_agreement("doidge2012", 100);
}
TEST(Inspect, AgreesWithBidirectionalPhotonMapping) {
  expect_agreement("bpm", 100);
}

// Clamped samples lose the same light, whichever word it belongs to.
TEST(Inspect, AgreesWithAFilmThatClampsAndCrops) {
  const std::string film =
      R"("float maxcomponentvalue" 0.7 "integer pixelbounds" [1 15 2 11]
         PixelFilter "mitchell" "float xradius" 2 "float yradius" 2)";
  expect_agreement("path-only", 400, film);
  expect_agreement("mixed", 100, film);
}

TEST(Inspect, SaysWhatStandsInForEstimatorsOfWholePictures) {
  for (const auto& [integrator, estimator] :
       {std::pair{"vcm", "vcm"}, {"sppm", "sppm"}, {"split", "lighttrace"}}) {
    Inspected view(std::string(kKey) + kInspectedBall, integrator, 50);
    const PixelInspection found = view.at(7, 3);
    ASSERT_EQ(found.notes.size(), 1u) << integrator;
    EXPECT_NE(found.notes[0].find(std::string("of ") + estimator), std::string::npos);
    EXPECT_NE(found.notes[0].find("by bpm"), std::string::npos);
    EXPECT_NEAR(luminance(found.traced), luminance(found.value), 0.15 * luminance(found.value))
        << integrator;
    EXPECT_NE(path_of(found, "C <RD'floor'> <TS'glass'> <TS'glass'> <L.'key'>"), nullptr);
  }
}

TEST(Inspect, LetsPathTracingStandInWhereItAloneFindsTheLight) {
  Inspected view(std::string(kKey) + R"(
    MakeNamedMedium "fire" "string type" "homogeneous" "rgb sigma_s" [0 0 0] "rgb sigma_a" [1 1 1]
      "rgb Le" [1 1 1]
    Material "interface" MediumInterface "fire" "" Translate 0 1 0
    Shape "sphere" "float radius" 1)",
                 "pssmlt");
  const PixelInspection found = view.at(7, 4);
  ASSERT_EQ(found.notes.size(), 1u);
  EXPECT_NE(found.notes[0].find("by path"), std::string::npos);
  EXPECT_NE(path_of(found, "C <M.'fire'>"), nullptr);
}

TEST(Inspect, IsTheSameForAnyNumberOfThreads) {
  Inspected view(std::string(kKey) + kInspectedBall, "mixed");
  const PixelInspection many = view.at(7, 3);
  const ThreadLimit one(1);
  const PixelInspection single = view.at(7, 3);
  EXPECT_EQ(many.traced.r, single.traced.r);
  ASSERT_EQ(many.paths.size(), single.paths.size());
  for (size_t i = 0; i < many.paths.size(); ++i) {
    EXPECT_EQ(many.paths[i].word, single.paths[i].word);
    EXPECT_EQ(many.paths[i].share, single.paths[i].share);
    EXPECT_EQ(many.paths[i].points, single.paths[i].points);
  }
}

TEST(Inspect, RefusesPixelsBesideThePicture) {
  Inspected view(kKey, "path-only");
  EXPECT_THROW(view.at(15, 0), UsageError);
  EXPECT_THROW(view.at(0, -1), UsageError);
}

}  // namespace
}  // namespace nephroid
