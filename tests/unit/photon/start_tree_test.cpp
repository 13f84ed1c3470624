// The tree of splits through useful starts.
#include "photon/start_tree.h"

#include <gtest/gtest.h>

#include <vector>

#include "unit/photon/useful_starts.h"

namespace nephroid {
namespace {

using testing_bsdf::TestRandom;
using testing_guide::add_cluster;

std::vector<UsefulStart> clusters(int count, int each) {
  std::vector<UsefulStart> starts;
  TestRandom random(3);
  for (int c = 0; c < count; ++c) {
    const Vec2f at = random.next2();
    add_cluster(starts, 0, {6 * at.x - 3, 0, 6 * at.y - 3}, 0.05f, each, random);
  }
  return starts;
}

TEST(StartTree, HasEachStartInOneLeaf) {
  for (const int count : {1, 2, 7, 100}) {
    const std::vector<UsefulStart> starts = clusters(count, 25);
    const StartTree tree(starts, 32);
    ASSERT_GE(tree.leaves().size(), 1u);
    ASSERT_LE(tree.leaves().size(), 32u);
    if (count == 7) {
      EXPECT_GE(tree.leaves().size(), 7u);
    }
    std::vector<int> seen(starts.size(), 0);
    for (const StartTree::Crowd& leaf : tree.leaves()) {
      double weight = 0;
      for (const uint32_t i : tree.starts_of(leaf)) {
        ++seen[i];
        weight += double{starts[i].weight};
        EXPECT_TRUE(leaf.bounds.intersects(starts[i].first_hit));
      }
      EXPECT_NEAR(leaf.weight, weight, 1e-6 * weight);
    }
    EXPECT_EQ(seen, std::vector<int>(starts.size(), 1));
  }
}

TEST(StartTree, HasEveryCrowdThatWasCut) {
  const StartTree tree(clusters(7, 25), 32);
  ASSERT_EQ(tree.inner().size(), tree.leaves().size() - 1);
  EXPECT_EQ(tree.inner().back().begin, 0u);
  EXPECT_EQ(tree.inner().back().end, 7u * 25);
  for (const StartTree::Crowd& crowd : tree.inner()) {
    size_t starts = 0, leaves = 0;
    for (const StartTree::Crowd& leaf : tree.leaves())
      if (crowd.contains(leaf)) {
        ++leaves;
        starts += leaf.end - leaf.begin;
      }
    EXPECT_GE(leaves, 2u);
    EXPECT_EQ(starts, crowd.end - crowd.begin);
  }
}

TEST(StartTree, CutsNothingWhereAllAreAtOnePoint) {
  const std::vector<UsefulStart> starts(1000, {0, {1, 2, 3}, 1});
  const StartTree tree(starts, 32);
  EXPECT_EQ(tree.leaves().size(), 1u);
  EXPECT_TRUE(tree.inner().empty());
  EXPECT_EQ(tree.leaves()[0].half_diagonal(), 0);
}

}  // namespace
}  // namespace nephroid
