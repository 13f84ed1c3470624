// Mitsuba's principled BSDFs in the terms of OpenPBR.
#include <cmath>
#include <tuple>

#include "unit/input/mitsuba_bsdfs.h"

namespace nephroid::testing {
namespace {

using Numbers = std::vector<double>;

TEST(MitsubaPrincipled, KeepsItsNames) {
  const ParameterSet set =
      material_of(bsdf("principled",
                       value("rgb", "base_color", "0.1 0.2 0.3") +
                           value("float", "roughness", "0.4") + value("float", "metallic", "0.6") +
                           value("float", "spec_trans", "0.7") + value("float", "specular", "0.5")),
                  "3.0.0")
          .parameters;
  EXPECT_EQ(parameter(set, "base_color").numbers, (Numbers{0.1, 0.2, 0.3}));
  EXPECT_EQ(number(set, "specular_roughness"), 0.4);
  EXPECT_EQ(number(set, "base_metalness"), 0.6);
  EXPECT_EQ(number(set, "transmission_weight"), 0.7);
  EXPECT_NEAR(number(set, "specular_ior"), 1.5, 1e-9);
}

TEST(MitsubaPrincipled, HasTheFacetsOfBurley) {
  // Burley 2012: alphas roughness^2 / a and roughness^2 a with a = sqrt(1 - 0.9 anisotropic).
  const ParameterSet set = material_of(bsdf("principled", value("float", "roughness", "0.6") +
                                                              value("float", "anisotropic", "0.5")),
                                       "3.0.0")
                               .parameters;
  const double r = number(set, "specular_roughness");
  const double across = 1 - number(set, "specular_roughness_anisotropy");
  const double alpha_t = r * r * std::sqrt(2 / (1 + across * across));
  const double a = std::sqrt(1 - 0.9 * 0.5);
  EXPECT_NEAR(alpha_t, 0.36 / a, 1e-12);
  EXPECT_NEAR(across * alpha_t, 0.36 * a, 1e-12);
}

TEST(MitsubaPrincipled, AClearcoatLeavesTheReflectanceBelowIt) {
  const ParameterSet set =
      material_of(bsdf("principled", value("float", "clearcoat", "0.8")), "3.0.0").parameters;
  EXPECT_EQ(number(set, "coat_weight"), 0.2);
  EXPECT_EQ(number(set, "coat_darkening"), 0);
  ASSERT_TRUE(has_parameter(set, "coat_affects_specular"));
  EXPECT_EQ(parameter(set, "coat_affects_specular").bools, std::vector<bool>{false});
}

TEST(MitsubaPrincipled, TexturesAreScaled) {
  const auto checks = [](const std::string& name) {
    return "<texture type=\"checkerboard\" name=\"" + name + "\"/>";
  };
  MitsubaScene scene;
  const SceneDescription d = with_bsdf(
      scene, bsdf("principled", checks("roughness") + checks("anisotropic") + checks("clearcoat")),
      "3.0.0");
  const ParameterSet& set = d.materials.at(0).parameters;
  EXPECT_EQ(parameter(set, "specular_roughness").type, "texture");
  const auto factor = [&](const char* name) {
    for (const TextureDescription& t : d.textures)
      if (t.name == text(set, name)) return number(t.parameters, "scale");
    ADD_FAILURE() << name;
    return 0.0;
  };
  EXPECT_EQ(factor("specular_roughness_anisotropy"), 0.9);
  EXPECT_EQ(factor("coat_weight"), 0.25);
}

TEST(MitsubaPrincipled, TintsAreTheHueOfTheBaseColour) {
  const std::string base = value("rgb", "base_color", "0.4 0.1 0.1");
  const double luminance = 0.2126 * 0.4 + 0.7152 * 0.1 + 0.0722 * 0.1;
  const double red = 0.5 + 0.5 * 0.4 / luminance, green = 0.5 + 0.5 * 0.1 / luminance;
  const ParameterSet set =
      material_of(bsdf("principled", base + value("float", "spec_tint", "0.5") +
                                         value("float", "sheen", "0.25") +
                                         value("float", "sheen_tint", "0.5")),
                  "3.0.0")
          .parameters;
  for (const auto& [weight, color, expected] :
       {std::tuple("specular_weight", "specular_color", red),
        std::tuple("fuzz_weight", "fuzz_color", 0.25 * red)}) {
    EXPECT_NEAR(number(set, weight), expected, 1e-12);
    const Numbers rgb = parameter(set, color).numbers;
    EXPECT_NEAR(rgb.at(0), 1, 1e-12);
    EXPECT_NEAR(rgb.at(1), green / red, 1e-12);
  }
}

TEST(MitsubaPrincipled, TintsWithoutAnEffectAreSilent) {
  MitsubaScene scene;
  const SceneDescription d =
      with_bsdf(scene, bsdf("principled", value("float", "sheen_tint", "0.5")), "3.0.0");
  EXPECT_EQ(scene.warnings().find("_tint"), std::string::npos) << scene.warnings();
  EXPECT_FALSE(has_parameter(d.materials.at(0).parameters, "fuzz_weight"));
  with_bsdf(
      scene,
      bsdf("principled", value("rgb", "base_color", "0.4 0.1 0.1") +
                             value("float", "metallic", "1") + value("float", "spec_tint", "0.5")),
      "3.0.0");
  EXPECT_NE(scene.warnings().find("\"spec_tint\" is ignored"), std::string::npos);
}

}  // namespace
}  // namespace nephroid::testing
