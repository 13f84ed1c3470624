// Suggestions for misspelt names.
#include "input/spelling.h"

#include <gtest/gtest.h>

namespace nephroid {
namespace {

TEST(Spelling, FindsTheNearestName) {
  const std::vector<std::string> names = {"Shape", "Sampler", "Scale", "LookAt"};
  EXPECT_EQ(did_you_mean("Shap", names), ", did you mean \"Shape\"?");
  EXPECT_EQ(did_you_mean("Lookat", names), ", did you mean \"LookAt\"?");
  EXPECT_EQ(did_you_mean("SAMPLRE", names), ", did you mean \"Sampler\"?");
}

TEST(Spelling, IsSilentWhenNothingIsNear) {
  EXPECT_EQ(did_you_mean("Teapot", {"Shape", "Scale"}), "");
  EXPECT_EQ(did_you_mean("x", {}), "");
  EXPECT_EQ(did_you_mean("", {"a"}), "");
  EXPECT_EQ(did_you_mean(std::string(1000, 'a'), {std::string(1000, 'a')}), "");
}

TEST(Spelling, TakesTheFirstOfEquals) {
  EXPECT_EQ(did_you_mean("metal", {"metalA", "metalB"}), ", did you mean \"metalA\"?");
}

}  // namespace
}  // namespace nephroid
