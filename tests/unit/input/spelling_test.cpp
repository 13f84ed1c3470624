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

TEST(Spelling, KnowsWhatOthersCallThings) {
  const std::vector<std::string> materials = {"diffuse",       "dielectric", "conductor",
                                              "coateddiffuse", "principled", "measured"};
  EXPECT_EQ(did_you_mean("Glass", materials), ", did you mean \"dielectric\"?");
  EXPECT_EQ(did_you_mean("metal", materials), ", did you mean \"conductor\"?");
  EXPECT_EQ(did_you_mean("openpbr", materials), ", did you mean \"principled\"?");
  EXPECT_EQ(did_you_mean("ior", {"roughness", "eta"}), ", did you mean \"eta\"?");
  EXPECT_EQ(did_you_mean("st", {"S", "uv"}), ", did you mean \"uv\"?");
  EXPECT_EQ(did_you_mean("mapname", {"filename", "name"}), ", did you mean \"filename\"?");
  EXPECT_EQ(did_you_mean("gold", {"metal-Ag-eta", "metal-Au-eta", "metal-Au-k"}),
            ", did you mean \"metal-Au-eta\" or \"metal-Au-k\"?");
  EXPECT_EQ(did_you_mean("area", {"point"}, "light"),
            ", did you mean AreaLightSource \"diffuse\" before a Shape?");
  EXPECT_EQ(did_you_mean("area", {"point"}, "film"), "");
  EXPECT_EQ(did_you_mean("glass", {"film"}), "") << "only what the candidates have";
}

TEST(Spelling, TakesTheFirstOfEquals) {
  EXPECT_EQ(did_you_mean("metal", {"metalA", "metalB"}), ", did you mean \"metalA\"?");
}

}  // namespace
}  // namespace nephroid
