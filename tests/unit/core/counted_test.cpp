// Counts with their nouns: only a count of 1 has the singular.
#include "core/counted.h"

#include <gtest/gtest.h>

namespace nephroid {
namespace {

TEST(Counted, OnlyOneIsSingular) {
  EXPECT_EQ(counted(0, "photon"), "0 photons");
  EXPECT_EQ(counted(1, "photon"), "1 photon");
  EXPECT_EQ(counted(2, "photon"), "2 photons");
  EXPECT_EQ(counted(uint64_t{1} << 40, "photon"), "1099511627776 photons");
}

TEST(Counted, PluralsThatAreNoPlainS) {
  EXPECT_EQ(counted(1, "pass", "passes"), "1 pass");
  EXPECT_EQ(counted(3, "pass", "passes"), "3 passes");
  EXPECT_EQ(in_number(1, "was", "were"), "was");
  EXPECT_EQ(in_number(0, "was", "were"), "were");
}

}  // namespace
}  // namespace nephroid
