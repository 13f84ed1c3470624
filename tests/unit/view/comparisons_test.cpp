// Pictures to compare with.
#include "view/comparisons.h"

#include <gtest/gtest.h>

#include "core/errors.h"

namespace nephroid {
namespace {

Picture grey(int width, int height) {
  Picture picture;
  picture.full_width = width;
  picture.full_height = height;
  picture.window = {0, 0, width, height};
  picture.channels = {"R", "G", "B"};
  picture.pixels.assign(static_cast<size_t>(width) * height * 3, 0.5f);
  return picture;
}

TEST(Comparisons, PicturesOfOtherSizesAreRefused) {
  const Picture large = grey(64, 64), small = grey(2, 2);
  EXPECT_THROW(distance(large, small), UsageError);
  for (const char* kind : {"relmse", "flip"}) {
    EXPECT_THROW(heat_png(large, small, kind), UsageError) << kind;
    EXPECT_THROW(heat_png(small, large, kind), UsageError) << kind;
  }
}

TEST(Comparisons, OldSnapshotsGoAndFilesStay) {
  Comparisons comparisons;
  comparisons.add_file(grey(1, 1), "file.exr");
  for (int i = 0; i < 5; ++i) comparisons.add_snapshot(grey(1, 1), "now");
  std::string ids;
  for (const ListedComparison& listed : comparisons.list()) ids += listed.id + " ";
  EXPECT_EQ(ids, "file1 B C D E ");
  EXPECT_EQ(comparisons.find("A"), nullptr);
  for (size_t i = 1; i < Comparisons::kMaxFiles; ++i) comparisons.add_file(grey(1, 1), "more");
  EXPECT_THROW(comparisons.add_file(grey(1, 1), "too many"), UsageError);
  EXPECT_TRUE(comparisons.remove("file1"));
  EXPECT_EQ(comparisons.add_file(grey(1, 1), "again"), "file9");
}

}  // namespace
}  // namespace nephroid
