// [W13] The area of a merge's disc over that of the surface in it, where the share that is covered
// is known.
#include "photon/disc_area.h"

#include <gtest/gtest.h>

#include "core/warps.h"
#include "photon/merge.h"
#include "rendering.h"

namespace nephroid {
namespace {

// A floor of a diffuse material, x and z from -2 to 2.
constexpr char kFloor[] =
    "Material \"diffuse\" Shape \"bilinearmesh\" \"point3 P\" [-2 0 -2  2 0 -2  -2 0 2  2 0 2]\n";
constexpr float kRadius = 0.1f;

struct MeanCover {
  double inverse_cover = 0, rays = 0;
};

// At the surface that lies below a point.
MeanCover mean_below(const std::string& world, const Vec3f& point) {
  const auto scene = testing_support::scene_from_text("WorldBegin " + world);
  SurfaceInteraction hit;
  EXPECT_TRUE(scene->intersect({point, Vec3f(0, -1, 0)}, hit));
  constexpr uint32_t kProbes = 1 << 14;
  MeanCover mean;
  for (uint32_t i = 0; i < kProbes; ++i) {
    const DiscProbes probes = probe_disc(*scene, hit, kRadius, PathSampler(PaddedPoint{i}, 7));
    mean.inverse_cover += probes.inverse_cover / kProbes;
    mean.rays += static_cast<double>(probes.rays) / kProbes;
  }
  return mean;
}

MeanCover mean_at(const std::string& world, float x, float z) {
  return mean_below(world, Vec3f(x, 5, z));
}

TEST(DiscArea, AWholeDiscTakesOneRay) {
  const MeanCover mean = mean_at(kFloor, 0.3f, 0.2f);
  EXPECT_EQ(mean.inverse_cover, 1.0);
  EXPECT_EQ(mean.rays, 1.0);
}

TEST(DiscArea, HalfOfItAtAnEdge) {
  EXPECT_NEAR(mean_at(kFloor, 1.99999f, 0).inverse_cover, 2.0, 0.03);
}

TEST(DiscArea, AQuarterAtACorner) {
  EXPECT_NEAR(mean_at(kFloor, 1.99999f, -1.99999f).inverse_cover, 4.0, 0.1);
}

TEST(DiscArea, ASegmentIsCutOffHalfARadiusFromAnEdge) {
  const double covered = 1 - (std::acos(0.5) - 0.5 * std::sqrt(0.75)) / kPi;
  EXPECT_NEAR(mean_at(kFloor, 2 - kRadius / 2, 0).inverse_cover, 1 / covered, 0.01);
}

// Photons on a wall are not merged on the floor, though the wall leans over the missing half.
TEST(DiscArea, ASteepWallAtTheEdgeChangesNothing) {
  const std::string wall = "Shape \"bilinearmesh\" \"point3 P\" [2 0 -2  2 0 2  3 2 -2  3 2 2]\n";
  EXPECT_NEAR(mean_at(kFloor + wall, 1.99999f, 0).inverse_cover, 2.0, 0.03);
}

// Photons are counted by the area of surface within the radius, not by its shadow on the disc.
TEST(DiscArea, ABendLeavesTheDiscWhole) {
  const std::string slope =
      "Shape \"bilinearmesh\" \"point3 P\" [2 0 -2  4 -1.68 -2  2 0 2  4 -1.68 2]\n";  // 40 degrees
  EXPECT_NEAR(mean_at(kFloor + slope, 1.99999f, 0).inverse_cover, 1.0, 0.02);
}

TEST(DiscArea, AStepIsAnEdge) {
  const std::string step =
      "Shape \"bilinearmesh\" \"point3 P\" [2 -.1 -2  4 -.1 -2  2 -.1 2  4 -.1 2]\n";
  EXPECT_NEAR(mean_at(kFloor + step, 1.99999f, 0).inverse_cover, 2.0, 0.03);
}

TEST(DiscArea, SurfacesThatAreSmoothHaveNoPhotons) {
  const std::string glass =
      "Material \"dielectric\" Shape \"bilinearmesh\" \"point3 P\" [2 0 -2  4 0 -2  2 0 2  4 0 "
      "2]\n";
  const std::string wood =
      "Material \"diffuse\" Shape \"bilinearmesh\" \"point3 P\" [2 0 -2  4 0 -2  2 0 2  4 0 2]\n";
  EXPECT_NEAR(mean_at(kFloor + glass, 1.99999f, 0).inverse_cover, 2.0, 0.03);
  EXPECT_EQ(mean_at(kFloor + wood, 1.99999f, 0).inverse_cover, 1.0);
}

// Sheets above and below the floor hide nothing; a pile of them stops the probe, which corrects
// nothing then.
TEST(DiscArea, LooksThroughInterfacesAndOtherSurfaces) {
  const auto sheet = [](const std::string& material, float y) {
    const std::string h = " " + std::to_string(y) + " ";
    return "Material \"" + material + "\" Shape \"bilinearmesh\" \"point3 P\" [-4" + h + "-1 4" +
           h + "-1 -4" + h + "1 4" + h + "1]\n";
  };
  std::string world = kFloor;
  for (const float side : {-1.0f, 1.0f})
    world += sheet("interface", 0.001f * side) + sheet("dielectric", 0.002f * side);
  EXPECT_EQ(mean_below(world, Vec3f(0, 0.0005f, 0)).inverse_cover, 1.0);
  EXPECT_NEAR(mean_below(world, Vec3f(0, 0.0005f, 0)).rays, 3.0, 0.01);
  EXPECT_NEAR(mean_below(world, Vec3f(1.99999f, 0.0005f, 0)).inverse_cover, 1.0, 0.01);
}

// Photons are as bright there as if all of it were.
TEST(DiscArea, SurfacesThatAreThereByChanceAreWhole) {
  std::string veil = kFloor;
  veil.insert(veil.rfind('\n'), " \"float alpha\" 0.5");
  const auto scene = testing_support::scene_from_text("WorldBegin " + veil);
  SurfaceInteraction hit;
  float x = -1;
  while (!scene->intersect({Vec3f(x, 5, 0), Vec3f(0, -1, 0)}, hit) && x < 1) x += 0.1f;
  ASSERT_LT(x, 1);
  for (uint32_t i = 0; i < 64; ++i)
    EXPECT_EQ(probe_disc(*scene, hit, kRadius, PathSampler(PaddedPoint{i}, 7)).inverse_cover, 1.0f);
}

TEST(DiscArea, CurvedSurfacesAreWhole) {
  const std::string ball = "Material \"diffuse\" Shape \"sphere\" \"float radius\" 0.25\n";
  EXPECT_NEAR(mean_at(ball, 0, 0).inverse_cover, 1.0, 1e-3);
  EXPECT_NEAR(mean_at(ball, 0.12f, 0.1f).inverse_cover, 1.0, 1e-3);
}

// Of a cable, the side that is seen, as far as it is tilted by less than 45.57 degrees.
TEST(DiscArea, AThinCable) {
  const std::string cable =
      "Material \"diffuse\" Shape \"cylinder\" \"float radius\" 0.02 \"float zmin\" -1 \"float "
      "zmax\" 1\n";
  const double covered = 2 * std::acos(0.7) * 0.02 * 2 * 0.1 / (kPi * 0.01);
  const double expected = (1 - std::pow(1 - covered, 16)) / covered;
  EXPECT_NEAR(mean_at(cable, 0, 0).inverse_cover, expected, 0.05 * expected);
}

// In uniform light the photons within r / sqrt(2) are half of those within r, if the disc is whole.
// At an edge they are more, which says nothing of the bias.
TEST(DiscArea, TheEstimateOfTheBiasIsThatOfAWholeDisc) {
  const auto scene = testing_support::scene_from_text(std::string("WorldBegin ") + kFloor);
  SurfaceInteraction hit;
  ASSERT_TRUE(scene->intersect({Vec3f(2 - kRadius / 2, 5, 0), Vec3f(0, -1, 0)}, hit));
  double bias = 0, light = 0;
  constexpr uint32_t kProbes = 1 << 14;
  for (uint32_t i = 0; i < kProbes; ++i) {
    const DiscProbes probes = probe_disc(*scene, hit, kRadius, PathSampler(PaddedPoint{i}, 7));
    // A photon, uniform over the disc; it lies beside the floor in some cases.
    const Vec2f d = square_to_disk(PathSampler(PaddedPoint{i}, 8).get_2d());
    if (d.x > 0.5f) continue;
    light += probes.inverse_cover;
    bias += probes.inverse_cover * (bias_factor(sqr(d.x) + sqr(d.y), 1) + probes.bias_offset);
  }
  EXPECT_NEAR(light, kProbes, 0.02 * kProbes);
  EXPECT_NEAR(bias, 0, 0.03 * kProbes);
}

// A strip as wide as a fortieth of the radius: the probing ends before it is found.
TEST(DiscArea, ThreadsAreTooDark) {
  const std::string thread =
      "Material \"diffuse\" Shape \"bilinearmesh\" \"point3 P\" [-1 0 -.00125  1 0 -.00125  -1 0 "
      ".00125  1 0 .00125]\n";
  const double covered = 2 * 0.0025 * 0.1 / (kPi * 0.01);
  const double expected = (1 - std::pow(1 - covered, 16)) / covered;
  EXPECT_NEAR(mean_at(thread, 0, 0).inverse_cover, expected, 0.02 * expected);
  EXPECT_LT(expected, 1 / covered);
}

}  // namespace
}  // namespace nephroid
