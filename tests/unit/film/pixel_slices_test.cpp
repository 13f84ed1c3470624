// Slices contain every pixel once, coarse to fine, and a pixel knows its slice.
#include "film/pixel_slices.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace nephroid {
namespace {

TEST(PixelSlices, ReachEveryPixelOnceAndCoarseToFine) {
  for (const PixelBounds& crop :
       {PixelBounds{0, 0, 1, 1}, PixelBounds{3, 5, 8, 8}, PixelBounds{0, 7, 1000, 8},
        PixelBounds{2, 1, 131, 130}, PixelBounds{11, 13, 11 + 641, 13 + 479},
        PixelBounds{0, 0, 1920, 1080}}) {
    const PixelSlices slices(crop);
    std::vector<int> seen(static_cast<size_t>(crop.area()));
    size_t slice = 0;
    for (int level = 1; level <= slices.levels(); ++level) {
      const int spacing = slices.spacing(level);
      for (; slice < slices.count_of_levels(level); ++slice) {
        const PixelSlices::Run run = slices.at(slice);
        ASSERT_GT(run.count, 0);
        ASSERT_LE(run.count, PixelSlices::kMaxPixelsOfSlice);
        for (int i = 0; i < run.count; ++i) {
          const int x = run.x + i * run.step - crop.x0, y = run.y - crop.y0;
          ASSERT_TRUE(x >= 0 && x < crop.width() && y >= 0 && y < crop.height());
          ASSERT_EQ(x % spacing, 0);
          ASSERT_EQ(y % spacing, 0);
          ASSERT_EQ(slices.slice_of(crop.x0 + x, crop.y0 + y), slice);
          ++seen[static_cast<size_t>(y * crop.width() + x)];
        }
      }
      // All points of the lattice are reached.
      for (int y = 0; y < crop.height(); y += spacing)
        for (int x = 0; x < crop.width(); x += spacing)
          ASSERT_EQ(seen[static_cast<size_t>(y * crop.width() + x)], 1) << level;
      if (level == 1) {
        EXPECT_LE(std::count(seen.begin(), seen.end(), 1), PixelSlices::kMaxFirstPixels);
      }
    }
    EXPECT_EQ(slice, slices.count());
    EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), crop.area());
  }
}

}  // namespace
}  // namespace nephroid
