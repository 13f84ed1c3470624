// [E5], the merge radius.
#include "integrator/photons/merge_radius.h"

#include <gtest/gtest.h>

namespace nephroid {
namespace {

TEST(FirstRadius, GrowsWithThePicture) {
  IntegratorOptions options;
  EXPECT_FLOAT_EQ(first_radius(options, 100), 1.5f);
  EXPECT_FLOAT_EQ(first_radius(options, 128 * 128), 1.5f);
  EXPECT_NEAR(first_radius(options, 512 * 512), 3.446f, 1e-3f);
  EXPECT_NEAR(first_radius(options, 1920 * 1080), 6.41f, 1e-2f);
  options.radius = 0.7f;
  EXPECT_FLOAT_EQ(first_radius(options, 512 * 512), 0.7f);
}

// After as many photons, a render has the same radius, however they are divided into passes.
TEST(ShrinkageByPhotons, CountsPhotonsLikePasses) {
  IntegratorOptions options;
  EXPECT_FLOAT_EQ(shrinkage_by_photons(options, 1), 1);
  EXPECT_FLOAT_EQ(shrinkage_by_photons(options, 0.2), 1);
  EXPECT_FLOAT_EQ(shrinkage_by_photons(options, 64), 0.5f) << "64^(-1/6)";
  for (const uint32_t x : {2u, 8u})
    EXPECT_NEAR(shrinkage(options, 4000) * shrinkage_by_photons(options, x),
                shrinkage(options, 4000 * x), 1e-4f);
  options.radius = 3;
  EXPECT_EQ(shrinkage_by_photons(options, 64), 1) << "the user's radius is the radius";
}

}  // namespace
}  // namespace nephroid
