// [W12], Russian roulette of eye paths behind merged photons.
#include "integrator/bidirectional/merge_roulette.h"

#include <gtest/gtest.h>

namespace nephroid {
namespace {

void merge(MergeRoulette& path, int photons) {
  for (int i = 0; i < photons; ++i) path.merge();
}

TEST(MergeRoulette, GoesOnTheLessTheMorePhotonsWereMerged) {
  for (const auto& [photons, expected] :
       {std::pair{0, 0.5f}, {1, 0.5f}, {5, 0.2f}, {500, 0.0625f}}) {
    MergeRoulette path(nullptr, false, 1);
    merge(path, photons);
    path.leave(EventClass::kDiffuse, true);
    EXPECT_FLOAT_EQ(path.survival(), expected) << photons;
    EXPECT_EQ(path.survival(), 1) << "once";
    EXPECT_EQ(path.merged(), static_cast<uint64_t>(photons));
  }
}

TEST(MergeRoulette, IsPlayedBehindTheFirstRoughVertexOnly) {
  MergeRoulette glossy(nullptr, false, 1);
  merge(glossy, 8);
  glossy.leave(EventClass::kGlossy, true);
  EXPECT_EQ(glossy.survival(), 1) << "what a glossy lobe reflects is in no photons";
  merge(glossy, 8);
  glossy.leave(EventClass::kDiffuse, false);
  EXPECT_EQ(glossy.survival(), 1) << "photons count once behind a rough event";

  // Light that leaves below a surface counts where it leaves.
  MergeRoulette under(nullptr, false, 1);
  merge(under, 8);
  under.come_out();
  merge(under, 4);
  under.leave(EventClass::kDiffuse, true);
  EXPECT_FLOAT_EQ(under.survival(), 0.25f);
}

TEST(MergeRoulette, CountsThePhotonsOfAllBatches) {
  uint32_t all = 0;
  for (const int photons : {3, 0, 7}) {
    MergeRoulette path(&all, true, 1);
    merge(path, photons);
    path.leave(EventClass::kDiffuse, true);
  }
  EXPECT_EQ(all, 10u);
  MergeRoulette path(&all, false, 1);
  merge(path, 3);
  path.leave(EventClass::kDiffuse, true);
  EXPECT_FLOAT_EQ(path.survival(), 0.1f);
  EXPECT_EQ(all, 10u);
}

TEST(MergeRoulette, LetsAPhotonStandForSeveral) {
  MergeRoulette path(nullptr, false, 2.5f);
  merge(path, 2);
  path.leave(EventClass::kDiffuse, true);
  EXPECT_FLOAT_EQ(path.survival(), 0.2f);
}

}  // namespace
}  // namespace nephroid
