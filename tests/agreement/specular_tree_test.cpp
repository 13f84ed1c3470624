// Specular trees, which follow both ways at each delta boundary, find the same light as paths that
// choose one way, with less noise. In glass, in media and with dispersion.
#include "integrator/path/specular_tree.h"

#include <gtest/gtest.h>

#include "ball_in_a_medium.h"
#include "integrator/path/path_visitor.h"
#include "integrator/path/specular_chain_pass.h"
#include "owned_routes.h"
#include "rendering.h"
#include "transport/camera_path.h"

namespace nephroid {
namespace {

using namespace testing_support;

struct TreeEstimate {
  double mean = 0, variance = 0;  ///< variance of a path
};

/// Paths through a part of the picture, each with its own wavelengths, weighted by the sensor.
TreeEstimate look(const Scene& scene, const OwnedRoutes& owned, bool grows, bool shares_wavelengths,
                  const PixelBounds& area = {0, 0, 8, 8}) {
  const SpecularTree tree(scene, owned, 20);
  PartSums light(*owned.routes, owned.group);
  constexpr int kPaths = 1 << 15;
  double sum = 0, squares = 0;
  for (uint32_t i = 0; i < kPaths; ++i) {
    const SobolPoint point(i);
    PathSampler sampler(point, 11);
    sampler.start_dimension(dimensions::kWavelength);
    const auto lambda = SampledWavelengths::sample_visible(sampler.get_1d());
    sampler.start_dimension(dimensions::kFilm);
    const Vec2f u = sampler.get_2d();
    CameraPath path = start_camera_path(
        scene,
        Vec2f(static_cast<float>(area.x0) + static_cast<float>(area.width()) * u.x,
              static_cast<float>(area.y0) + static_cast<float>(area.height()) * u.y),
        sampler, lambda, 0.0f);
    path.walk.per_wavelength = shares_wavelengths;
    light.clear();
    PathVisitor visitor(scene, owned, false, light, nullptr, grows ? &tree : nullptr);
    random_walk(scene, TransportMode::kRadiance, 20, path.walk, sampler, visitor);
    const SensorWeights weights = sensor_weights(
        lambda, *scene.film.color_space, scene.film.imaging_ratio, scene.film.white_balance);
    double value = 0;
    for (const Rgb& c : light.colors(weights, 1, kInfinity, 1)) value += (c.r + c.g + c.b) / 3;
    sum += value;
    squares += value * value;
  }
  const double mean = sum / kPaths;
  return {mean, squares / kPaths - mean * mean};
}

TEST(SpecularTree, FindsWhatWalksFindWithLessNoise) {
  const std::string glass = R"(Material "dielectric")";
  const std::string prism = R"(Material "dielectric" "spectrum eta" "glass-SF11")";
  const std::string thin = R"(Material "thindielectric")";
  const std::string mirror = R"(Material "conductor" "float roughness" 0)";
  const std::string frosted = R"(Material "dielectric" "float roughness" 0.001)";
  const std::string pane_before = R"(
    AttributeBegin MediumInterface "" "" Material "thindielectric"
      Translate 0 0 -1.5 Shape "disk" AttributeEnd )";
  const std::string mirror_before = R"(
    AttributeBegin Material "conductor" "float roughness" 0 Translate 0 0 -1.5 Rotate 150 0 1 0
      Shape "disk" "float radius" 2 AttributeEnd Translate 3 0 -4 )";
  const std::string around_the_eye = R"( Shape "sphere" "float radius" 4)";
  const std::string fibre =
      R"( Shape "curve" "point3 P" [-1 0 0  -0.3 0.1 0  0.3 -0.1 0  1 0 0] "float width" 0.4)";
  struct Case {
    const char* name;
    std::string text;
    double gain;  ///< minimal gain in variance; 0: no trees, identical paths
  };
  for (const Case& c :
       {Case{"glass", ball(kClear, glass), 2}, Case{"milk glass", ball(kMilky, glass), 1},
        Case{"prism", ball(kClear, prism), 1.5}, Case{"pane", ball(kClear, thin), 0},
        Case{"mirror", ball(kClear, mirror), 0}, Case{"nearly smooth", ball(kClear, frosted), 0},
        Case{"fibre", ball(kClear, glass, fibre), 0},
        Case{"pane and glass", ball(kClear, pane_before + glass), 1.2},
        Case{"mirror and glass", ball(kClear, mirror_before + glass), 1},
        Case{"in glass", ball(kClear, glass, around_the_eye), 1}}) {
    const auto scene = scene_from_text(c.text);
    const OwnedRoutes owned = owned_routes(*scene, {"all=.*:path"});
    for (const bool shared : {false, true}) {
      const TreeEstimate walks = look(*scene, owned, false, shared);
      const TreeEstimate trees = look(*scene, owned, true, shared);
      if (c.gain == 0) {
        EXPECT_EQ(trees.mean, walks.mean) << c.name;
        continue;
      }
      const double error = std::sqrt((walks.variance + trees.variance) / (1 << 15));
      EXPECT_NEAR(trees.mean, walks.mean, 3.5 * error + 1e-9) << c.name << shared;
      EXPECT_GT(walks.mean, 20 * error) << c.name;
      EXPECT_GT(walks.variance, c.gain * trees.variance) << c.name << shared;
    }
  }
}

// Walks for this light alone find all of it. They also predict the variance of walks that choose
// one way at each boundary.
TEST(SpecularChainPass, FindsTheLightBehindDeltaLobes) {
  const auto scene = scene_from_text(ball(kClear, R"(Material "dielectric" "float eta" 2)"));
  const OwnedRoutes owned = owned_routes(*scene, {"of=CS+L:photons+light", "rest=.*:path"});
  const EstimatorSet set = make_estimators(plan_named("path"), {}, *scene);
  const Film film = film_for(*scene, set);
  const PixelBounds& b = film.bounds();
  const SpecularTree tree(*scene, owned, 20);
  constexpr int kWalks = 32, kPasses = 64;
  SampleMap map(b, kWalks);
  ChainVariance measured(b);
  const SpecularChainPass pass{.scene = *scene,
                               .film = film.format(),
                               .owned = owned,
                               .tree = tree,
                               .walks = map,
                               .seed = 5,
                               .measured = &measured};
  const size_t parts = owned.routes->groups()[0].parts.size();
  std::vector<Rgb> values(static_cast<size_t>(b.area()) * parts);
  for (uint32_t i = 0; i < kPasses; ++i)
    EXPECT_GT(pass.render(values, pass.points([i](int n) { return i * static_cast<uint32_t>(n); })),
              64u * 32);
  double sum = 0;
  for (const Rgb& v : values) sum += static_cast<double>(v.r + v.g + v.b) / 3;
  const TreeEstimate walks = look(*scene, owned, false, false);
  const double error = std::sqrt(walks.variance / (1 << 15));
  EXPECT_NEAR(sum / kPasses / static_cast<double>(b.area()), walks.mean, 3.5 * error);
  EXPECT_GT(walks.mean, 20 * error);

  const SampleVariance::ByTile foretold = measured.choice.by_tile(),
                               apart = measured.walks.by_tile();
  double variance = 0, least = 0, light = 0;
  for (const double v : foretold.light) light += v / 4;
  for (size_t tile = 0; tile < foretold.variance.size(); ++tile) {
    const double brightness = foretold.light[tile] + 0.1 * light;
    variance += foretold.variance[tile] * brightness / 4;
    least += apart.variance[tile] * brightness / 4;
  }
  double of_walks = 0;
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x)
      of_walks += look(*scene, owned, false, false, {x, y, x + 1, y + 1}).variance / 64;
  EXPECT_NEAR(variance, of_walks, 0.2 * of_walks);
  EXPECT_LT(least, 0.6 * of_walks);
}

}  // namespace
}  // namespace nephroid
