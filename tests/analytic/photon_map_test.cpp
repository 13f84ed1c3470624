// Photon maps and hit points where the light has a closed form: the bias bound [N2], a closed
// furnace, which is unbiased, and a hit point that stays.
#include "integrator/photon_mapping/photon_map.h"

#include <gtest/gtest.h>

#include "integrator/photon_mapping/ppm.h"
#include "rendering.h"
#include "scene/camera/camera.h"

namespace nephroid {
namespace {

using namespace testing_support;

// One pixel sees a lit disk and darkness around it. A hit point of `ppm` stays on one of the two
// for ever. The new walks of each `sppm` pass see both.
TEST(HitPoints, Stay) {
  const auto scene = scene_from_text(R"(
    LookAt 0 2 0.001  0 0 0  0 0 1
    Camera "perspective" "float fov" 40
    Film "rgb" "integer xresolution" 1 "integer yresolution" 1
    PixelFilter "box"
    WorldBegin
    LightSource "distant" "point3 from" [0 1 0] "point3 to" [0 0 0]
    Material "diffuse" "rgb reflectance" [0.5 0.5 0.5]
    Rotate -90 1 0 0 Shape "disk" "float radius" 0.5)");
  IntegratorOptions options;
  options.photons_per_pass = 4096;
  options.edit<PpmOptions>().hit_points = 1;
  options.radius = 0.05f;
  int dark = 0;
  for (uint64_t seed = 0; seed < 16; ++seed) {
    const double stays = picture_mean(render(*scene, "ppm", options, seed, 12));
    const double moves = picture_mean(render(*scene, "sppm", options, seed, 12));
    // At the edge of the disk about half of the photons are missing.
    EXPECT_TRUE(stays == 0 || stays > 0.4 * 0.5 * static_cast<double>(kInvPi)) << stays;
    EXPECT_GT(moves, 0.05 * 0.5 * static_cast<double>(kInvPi));
    EXPECT_LT(moves, 0.8 * 0.5 * static_cast<double>(kInvPi));
    dark += stays == 0;
  }
  EXPECT_GT(dark, 2);
  EXPECT_LT(dark, 14);
}

// A point light at height 1 above a floor: E = I (1 + x^2)^(-3/2), whose second derivatives are at
// most 3 I. Relative to E at the middle, [N2] is 0.15 r^2 * 3.
TEST(PhotonMap, BiasKeepsToItsBound) {
  const auto scene = scene_from_text(R"(
    LookAt 0 0.5 0.0005  0 0 0  0 0 1
    Camera "perspective" "float fov" 0.5
    Film "rgb" "integer xresolution" 4 "integer yresolution" 4
    PixelFilter "box"
    WorldBegin
    LightSource "point" "rgb I" [1 1 1] "point3 from" [0 1 0]
    Material "diffuse" "spectrum reflectance" [300 0.5 900 0.5]
    Shape "bilinearmesh" "point3 P" [-3 0 -3  3 0 -3  -3 0 3  3 0 3])");
  const double footprint = static_cast<double>(scene->camera->footprint().width(0.5f));
  const double truth = 0.5 / static_cast<double>(kPi);
  IntegratorOptions options;
  options.edit<PhotonMapOptions>().map_photons = 1 << 16;
  const auto look = [&](int nearest, double max_radius) {
    options.edit<PhotonMapOptions>().nearest_photons = nearest;
    options.radius = static_cast<float>(max_radius / footprint);
    const Plan plan = plan_of({"all=C[DG].*:photonmap", "rest=.*:path"});
    const SeedValues values = values_over_seeds(32, 0, [&](uint64_t seed) {
      EstimatorSet set = make_estimators(plan, options, *scene);
      Film film = film_for(*scene, set);
      LearningLoop map;
      for (uint32_t pass = 0; pass < 16; ++pass)
        map.render_pass(*set.estimators[0], {seed, pass}, *scene, film);
      const double pixels = static_cast<double>(set.estimators[0]->statistics().radius_max_pixels);
      return std::vector<double>{picture_mean(film) / truth - 1, footprint * pixels};
    });
    const Estimate bias = estimate_of(values[0]);
    const double radius = *std::max_element(values[1].begin(), values[1].end());
    const double bound = 0.15 * radius * radius * 3;
    std::printf("radius %.3f: bias %+.4f, standard error %.4f, bound %.4f\n", radius, bias.mean,
                bias.error, bound);
    EXPECT_LT(std::abs(bias.mean), bound + kT31 * bias.error);
    EXPECT_LT(kT31 * bias.error, max_error(0.02));
    return std::pair{radius, bias};
  };
  // Light is strongest in the middle, so the map is too dark there, by nearly the bound.
  const auto [fixed, dark] = look(kAllPhotons, 0.5);
  EXPECT_NEAR(fixed, 0.5, 1e-3);
  EXPECT_LT(dark.mean, -0.05);
  const auto [nearest, less] = look(600, 0.5);
  EXPECT_LT(nearest, 0.4);
  EXPECT_GT(less.mean, dark.mean);
}

// Inside a sphere that emits and reflects half of all light, radiance is uniform. A spherical cap
// has the area of the disk whose radius is its chord: the estimate is unbiased for any radius. Few
// photons add noise only: the farthest one sets the radius and is not counted. If it were,
// estimates would be too bright by 1/19.
TEST(PhotonMap, AClosedFurnaceIsFlat) {
  const auto scene = scene_from_text(R"(
    LookAt 0 0 0  0 0 1  0 1 0
    Camera "spherical"
    Film "rgb" "integer xresolution" 4 "integer yresolution" 4
    PixelFilter "box"
    WorldBegin
    AreaLightSource "diffuse" "rgb L" [1 1 1] "bool twosided" true
    Material "diffuse" "spectrum reflectance" [300 0.5 900 0.5]
    Shape "sphere" "float radius" 1)");
  IntegratorOptions options;
  options.max_depth = 4;
  options.edit<PhotonMapOptions>().map_photons = 1 << 14;
  options.photons_per_pass = 1 << 12;
  options.radius = 0.7f / scene->camera->footprint().width(1.0f);
  const double expected = 0.5 + 0.25 + 0.125 + 0.0625;
  const struct {
    const char* route;
    int nearest, walks;
  } rows[] = {{"all=C[DG].*:photonmap", 20, 8},
              {"all=C[DG].*:photonmap", kAllPhotons, 2},
              {"all=C[DG].*:ppm", 0, 8}};
  for (const auto& row : rows) {
    options.camera_samples_per_pass = row.walks;  // fewer where each gathers a tenth of all photons
    options.edit<PhotonMapOptions>().nearest_photons = row.nearest;
    const SeedValues values = values_over_seeds(16, 0, [&](uint64_t seed) {
      EstimatorSet set = make_estimators(plan_of({row.route, "rest=.*:path"}), options, *scene);
      Film film = film_for(*scene, set);
      LearningLoop map;
      for (uint32_t pass = 0; pass < 16; ++pass)
        map.render_pass(*set.estimators[0], {seed, pass}, *scene, film);
      return block_means(film, 2);
    });
    for (const std::vector<double>& block : values) {
      const Estimate e = estimate_of(block);
      EXPECT_NEAR(e.mean, expected, kT15 * e.error) << row.route << ' ' << row.nearest;
    }
    const Estimate e = estimate_of(mean_of_blocks(values));
    std::printf("%s, %d: off by %+.3f %%, standard error %.3f %%\n", row.route, row.nearest,
                100 * (e.mean / expected - 1), 100 * e.error / expected);
    EXPECT_NEAR(e.mean, expected, kT15 * e.error);
    EXPECT_LT(kT15 * e.error, max_error(0.05 * expected));
  }
}

}  // namespace
}  // namespace nephroid
