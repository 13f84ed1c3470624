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

}  // namespace
}  // namespace nephroid
