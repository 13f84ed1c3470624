// [W13] The area of a merge's disc over that of the surface in it, where the share that is covered
// is known.
#include "photon/disc_area.h"

#include <gtest/gtest.h>

#include "rendering.h"

namespace nephroid {
namespace {

// A floor of a diffuse material, x and z from -2 to 2.
constexpr char kFloor[] =
    "Material \"diffuse\" Shape \"bilinearmesh\" \"point3 P\" [-2 0 -2  2 0 -2  -2 0 2  2 0 2]\n";
constexpr float kRadius = 0.1f;

struct Mean {
  double inverse_cover = 0, rays = 0;
};

// Of what lies below (x, 5, z).
Mean mean_at(const std::string& world, float x, float z) {
  const auto scene = testing_support::scene_from_text("WorldBegin " + world);
  SurfaceInteraction hit;
  EXPECT_TRUE(scene->intersect({Vec3f(x, 5, z), Vec3f(0, -1, 0)}, hit));
  constexpr uint32_t kProbes = 1 << 14;
  Mean mean;
  for (uint32_t i = 0; i < kProbes; ++i) {
    const DiscProbes probes = probe_disc(*scene, hit, kRadius, PathSampler(PaddedPoint{i}, 7));
    mean.inverse_cover += probes.inverse_cover / kProbes;
    mean.rays += static_cast<double>(probes.rays) / kProbes;
  }
  return mean;
}

TEST(DiscArea, AWholeDiscTakesOneRay) {
  const Mean mean = mean_at(kFloor, 0.3f, 0.2f);
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

// Photons on a wall are not merged on the floor.
TEST(DiscArea, AWallAtTheEdgeChangesNothing) {
  const std::string wall = "Shape \"bilinearmesh\" \"point3 P\" [2 0 -2  2 0 2  2 4 -2  2 4 2]\n";
  EXPECT_NEAR(mean_at(kFloor + wall, 1.99999f, 0).inverse_cover, 2.0, 0.03);
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

// What stands between the probe and the surface hides nothing.
TEST(DiscArea, LooksThroughInterfacesAndOtherSurfaces) {
  const std::string sheets =
      "Material \"interface\" Shape \"bilinearmesh\" \"point3 P\" [-1 -.01 -1 1 -.01 -1 -1 -.01 1 "
      "1 -.01 1] Material \"dielectric\" Shape \"bilinearmesh\" \"point3 P\" [-1 .01 -1 1 .01 -1 "
      "-1 "
      ".01 1 1 .01 1]\n";
  const auto scene = testing_support::scene_from_text("WorldBegin " + sheets + kFloor);
  SurfaceInteraction hit;
  ASSERT_TRUE(scene->intersect({Vec3f(0, 0.005f, 0), Vec3f(0, -1, 0)}, hit));
  for (uint32_t i = 0; i < 64; ++i) {
    const DiscProbes probes = probe_disc(*scene, hit, kRadius, PathSampler(PaddedPoint{i}, 7));
    EXPECT_EQ(probes.inverse_cover, 1.0f);
    EXPECT_EQ(probes.rays, 2);
  }
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

// A strip whose width is a fortieth of the radius: the probing ends before it would find it.
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
