// BSDFs of Mitsuba as materials: parameters, defaults and conventions.
#include <cmath>

#include "unit/input/mitsuba_bsdfs.h"

namespace nephroid::testing {
namespace {

using Numbers = std::vector<double>;

TEST(MitsubaBsdf, DiffuseHasAReflectance) {
  EXPECT_EQ(parameter(material_of(bsdf("diffuse")).parameters, "reflectance").numbers,
            (Numbers{0.5, 0.5, 0.5}));
  const std::string rgb = value("rgb", "reflectance", ".1, .2 .3");
  EXPECT_EQ(parameter(material_of(bsdf("diffuse", rgb)).parameters, "reflectance").numbers,
            (Numbers{0.1, 0.2, 0.3}));
}

TEST(MitsubaBsdf, ReflectancesAboveOneAreRenderedAsOne) {
  MitsubaScene scene;
  const SceneDescription d =
      with_bsdf(scene, bsdf("diffuse", value("rgb", "reflectance", "2, 0.5, 0")));
  EXPECT_EQ(parameter(d.materials[0].parameters, "reflectance").numbers, (Numbers{1, 0.5, 0}));
  EXPECT_NE(scene.warnings().find("a reflectance is above 1"), std::string::npos);
  EXPECT_NE(scene
                .error("<bsdf type=\"diffuse\" id=\"a\">" + value("rgb", "reflectance", "-1 0 0") +
                       "</bsdf>")
                .find("negative component"),
            std::string::npos);
}

TEST(MitsubaBsdf, IndicesAreNumbersOrNames) {
  EXPECT_NEAR(number(material_of(bsdf("dielectric")).parameters, "eta"), 1.5046 / 1.000277, 1e-12);
  const std::string water = value("string", "intIOR", "Water") + value("float", "extIOR", "1.5");
  EXPECT_NEAR(number(material_of(bsdf("dielectric", water)).parameters, "eta"), 1.333 / 1.5, 1e-12);
  EXPECT_NEAR(number(material_of(bsdf("thindielectric")).parameters, "eta"), 1.5046 / 1.000277,
              1e-12);
  MitsubaScene scene;
  EXPECT_EQ(scene.error("<bsdf type=\"dielectric\" id=\"a\">\n" +
                        value("string", "int_ior", "diamnd") + "</bsdf>"),
            "scene.xml:3:1: substance \"diamnd\" is unknown, expected a refractive index or a name "
            "such as \"bk7\", did you mean \"diamond\"?");
}

TEST(MitsubaBsdf, AlphaIsTheRoughnessItself) {
  const MaterialDescription m = material_of(bsdf(
      "roughdielectric", value("float", "alpha", "0.3") + value("string", "distribution", "ggx")));
  EXPECT_EQ(m.type, "dielectric");
  EXPECT_EQ(number(m.parameters, "roughness"), 0.3);
  EXPECT_EQ(parameter(m.parameters, "remaproughness").bools, std::vector<bool>{false});
  const MaterialDescription two = material_of(
      bsdf("roughconductor", value("float", "alphaU", "0.1") + value("float", "alphaV", "0.2")));
  EXPECT_EQ(number(two.parameters, "uroughness"), 0.1);
  EXPECT_EQ(number(two.parameters, "vroughness"), 0.2);
}

TEST(MitsubaBsdf, TexturesOfAlphaAreTheRoughness) {
  const std::string color = value("rgb", "specularReflectance", "1 0.5 0.5");
  const std::string alpha =
      "<texture type=\"checkerboard\" name=\"alpha\"/>" + value("string", "distribution", "ggx");
  const std::pair<std::string, const char*> cases[] = {
      {bsdf("roughdielectric", alpha), "roughness"},
      {bsdf("roughconductor", alpha), "roughness"},
      {bsdf("roughplastic", alpha), "roughness"},
      {bsdf("roughdielectric", alpha + color), "specular_roughness"},
      {bsdf("roughplastic", alpha + color), "specular_roughness"}};
  for (const auto& [text, name] : cases) {
    MitsubaScene scene;
    const SceneDescription d = with_bsdf(scene, text);
    const ParameterSet& set = d.materials.at(0).parameters;
    EXPECT_EQ(parameter(set, name).type, "texture") << text;
    EXPECT_EQ(parameter(set, "remaproughness").bools, std::vector<bool>{false}) << text;
    EXPECT_EQ(scene.warnings().find("alpha"), std::string::npos) << scene.warnings();
  }
  const MaterialDescription ward =
      material_of(bsdf("ward", value("rgb", "diffuseReflectance", "0 0 0") +
                                   "<texture type=\"checkerboard\" name=\"alphaU\"/>"));
  EXPECT_EQ(parameter(ward.parameters, "uroughness").type, "texture");
  EXPECT_EQ(number(ward.parameters, "vroughness"), 0.1);
}

TEST(MitsubaBsdf, TwoAlphasOfTintedGlassAreItsAnisotropy) {
  const auto glass = [](const char* u, const char* v) {
    return material_of(bsdf("roughdielectric", value("rgb", "specularReflectance", "1 0.5 0.5") +
                                                   value("float", "alphaU", u) +
                                                   value("float", "alphaV", v)))
        .parameters;
  };
  // OpenPBR 1.1: alpha_t = r sqrt(2 / (1 + (1 - a)^2)) for r = roughness^2, alpha_b = (1 - a)
  // alpha_t.
  const ParameterSet wide = glass("0.4", "0.1");
  const double r = number(wide, "specular_roughness");
  const double across = 1 - number(wide, "specular_roughness_anisotropy");
  const double alpha_t = r * std::sqrt(2 / (1 + across * across));
  EXPECT_NEAR(alpha_t, 0.4, 1e-12);
  EXPECT_NEAR(across * alpha_t, 0.1, 1e-12);
  const ParameterSet turned = glass("0.1", "0.4");
  EXPECT_NEAR(number(turned, "specular_roughness"), r, 1e-12);
  EXPECT_FALSE(has_parameter(turned, "specular_roughness_anisotropy"));
}

TEST(MitsubaBsdf, OtherDistributionsGetAWarning) {
  MitsubaScene scene;
  with_bsdf(scene, bsdf("roughdielectric", value("string", "distribution", "beckmann")));
  EXPECT_NE(scene.warnings().find("distribution \"beckmann\" is rendered as \"ggx\""),
            std::string::npos);
  MitsubaScene other;
  with_bsdf(other, bsdf("roughdielectric", value("string", "distribution", "ggx")));
  EXPECT_EQ(other.warnings(), "");
}

TEST(MitsubaBsdf, ConductorsAreNamedOrGiven) {
  const ParameterSet gold =
      material_of(bsdf("conductor", value("string", "material", "Au"))).parameters;
  EXPECT_EQ(text(gold, "eta"), "metal-Au-eta");
  EXPECT_EQ(text(gold, "k"), "metal-Au-k");
  const ParameterSet chromium =
      material_of(bsdf("conductor", value("string", "material", "Cr"))).parameters;
  EXPECT_EQ(parameter(chromium, "eta").numbers.size(), 10u);
  const ParameterSet given =
      material_of(bsdf("conductor", value("rgb", "eta", "1 2 3") + value("spectrum", "k", "4") +
                                        value("float", "extEta", "2")))
          .parameters;
  EXPECT_EQ(parameter(given, "eta").numbers, (Numbers{0.5, 1, 1.5}));
  EXPECT_EQ(parameter(given, "k").numbers, (Numbers{2, 2, 2}));
  MitsubaScene scene;
  EXPECT_NE(scene
                .error("<bsdf type=\"conductor\" id=\"a\">\n" +
                       value("string", "material", "unobtainium") + "</bsdf>")
                .find("scene.xml:3:1: conductor \"unobtainium\" is unknown"),
            std::string::npos);
}

TEST(MitsubaBsdf, TheDefaultConductorIsCopperInTheOldVersionAndAMirrorInTheNewOne) {
  EXPECT_EQ(text(material_of(bsdf("conductor")).parameters, "eta"), "metal-Cu-eta");
  EXPECT_EQ(parameter(material_of(bsdf("conductor"), "3.0.0").parameters, "reflectance").numbers,
            (Numbers{1, 1, 1}));
  EXPECT_EQ(
      parameter(material_of(bsdf("conductor", value("string", "material", "none") +
                                                  value("spectrum", "specularReflectance", "0.25")))
                    .parameters,
                "reflectance")
          .numbers,
      (Numbers{0.25, 0.25, 0.25}));
}

TEST(MitsubaBsdf, AConductorsReflectanceAbsorbsTheRest) {
  MitsubaScene scene;
  const SceneDescription d =
      with_bsdf(scene, bsdf("conductor", value("spectrum", "specularReflectance", "0.75")));
  const MaterialDescription mix = material(d, d.shapes[0].material.name);
  EXPECT_EQ(mix.type, "mix");
  EXPECT_EQ(number(mix.parameters, "amount"), 0.25);
  const std::vector<std::string> parts = parameter(mix.parameters, "materials").strings;
  EXPECT_EQ(material(d, parts.at(0)).type, "conductor");
  EXPECT_EQ(parameter(material(d, parts.at(1)).parameters, "reflectance").numbers,
            (Numbers{0, 0, 0}));
}

/// Mean Fresnel reflectance of diffuse light, by the fit of Egan and Hilgeman for light from inside
/// (used by Jensen et al. 2001).
double internal_reflectance(double eta) {
  return -1.4399 / (eta * eta) + 0.7099 / eta + 0.6681 + 0.0636 * eta;
}

TEST(MitsubaBsdf, LinearPlasticHasABaseOfTheSameReflectance) {
  const MaterialDescription m = material_of(
      bsdf("plastic", value("rgb", "diffuseReflectance", "0.2, 0.5, 1") +
                          value("float", "intIOR", "1.5") + value("float", "extIOR", "1")));
  EXPECT_EQ(m.type, "coateddiffuse");
  const Numbers base = parameter(m.parameters, "reflectance").numbers;
  const double f = internal_reflectance(1.5);
  const double expected[] = {0.2, 0.5, 1};
  for (size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(base[i] / (1 - f * base[i]), expected[i] / (1 - f), 0.01 * expected[i]);
  const MaterialDescription nonlinear =
      material_of(bsdf("plastic", value("rgb", "diffuseReflectance", "0.2, 0.5, 1") +
                                      value("boolean", "nonlinear", "true")));
  EXPECT_EQ(parameter(nonlinear.parameters, "reflectance").numbers, (Numbers{0.2, 0.5, 1}));
}

TEST(MitsubaBsdf, CoatsCoverConductorsAndDiffuseSurfaces) {
  const MaterialDescription metal = material_of(bsdf(
      "coating", value("float", "thickness", "2") + value("spectrum", "sigmaA", "0.25") +
                     bsdf("roughconductor",
                          value("float", "alpha", "0.2") + value("string", "material", "Ag"))));
  EXPECT_EQ(metal.type, "coatedconductor");
  EXPECT_EQ(text(metal.parameters, "conductor.eta"), "metal-Ag-eta");
  EXPECT_EQ(number(metal.parameters, "conductor.roughness"), 0.2);
  EXPECT_EQ(number(metal.parameters, "thickness"), 0.5);
  const MaterialDescription paint = material_of(bsdf(
      "roughcoating",
      value("float", "alpha", "0.1") + bsdf("diffuse", value("rgb", "reflectance", "1, 0, 0"))));
  EXPECT_EQ(paint.type, "coateddiffuse");
  EXPECT_EQ(parameter(paint.parameters, "reflectance").numbers, (Numbers{1, 0, 0}));
  EXPECT_EQ(number(paint.parameters, "roughness"), 0.1);
  EXPECT_EQ(material_of(bsdf("coating", bsdf("dielectric"))).type, "dielectric");
}

TEST(MitsubaBsdf, LobesOfPhongKeepTheirReflectances) {
  MitsubaScene scene;
  const SceneDescription d =
      with_bsdf(scene, bsdf("phong", value("rgb", "diffuseReflectance", "0.3 0.3 0.3") +
                                         value("rgb", "specularReflectance", "0.1 0.1 0.1") +
                                         value("float", "exponent", "199.5")));
  const MaterialDescription mix = material(d, d.shapes[0].material.name);
  const double share = number(mix.parameters, "amount");
  const std::vector<std::string> parts = parameter(mix.parameters, "materials").strings;
  const ParameterSet diffuse = material(d, parts[0]).parameters;
  const ParameterSet glossy = material(d, parts[1]).parameters;
  EXPECT_NEAR((1 - share) * parameter(diffuse, "reflectance").numbers[0], 0.3, 1e-12);
  EXPECT_NEAR(share * parameter(glossy, "reflectance").numbers[0], 0.1, 1e-12);
  EXPECT_NEAR(number(glossy, "uroughness"), 0.05, 1e-12);
}

TEST(MitsubaBsdf, AMaskIsTheOpacityOfTheShape) {
  MitsubaScene scene;
  const SceneDescription d = with_bsdf(
      scene,
      bsdf("twosided", bsdf("mask", value("rgb", "opacity", "0.2 0.2 0.5") + bsdf("diffuse"))));
  EXPECT_NEAR(number(d.shapes[0].parameters, "alpha"), 0.3, 1e-12);
  EXPECT_EQ(material(d, d.shapes[0].material.name).type, "diffuse");
}

TEST(MitsubaBsdf, AMaskInAMixtureMixesWithNothing) {
  MitsubaScene scene;
  const SceneDescription d = with_bsdf(
      scene,
      bsdf("blendbsdf", value("float", "weight", "0.25") + bsdf("diffuse") +
                            bsdf("mask", value("float", "opacity", "0.4") + bsdf("diffuse"))));
  EXPECT_FALSE(has_parameter(d.shapes[0].parameters, "alpha"));
  const MaterialDescription blend = material(d, d.shapes[0].material.name);
  EXPECT_EQ(number(blend.parameters, "amount"), 0.25);
  const MaterialDescription mask =
      material(d, parameter(blend.parameters, "materials").strings.at(1));
  EXPECT_EQ(number(mask.parameters, "amount"), 0.4);
  EXPECT_EQ(material(d, parameter(mask.parameters, "materials").strings.at(0)).type, "interface");
}

TEST(MitsubaBsdf, WeightsOfMixturesBecomeShares) {
  MitsubaScene scene;
  const SceneDescription d = with_bsdf(
      scene, bsdf("mixturebsdf", value("string", "weights", "0.2, 0.3, 0.4") + bsdf("diffuse") +
                                     bsdf("dielectric") + bsdf("null")));
  // ((a, b), c), black
  const MaterialDescription outer = material(d, d.shapes[0].material.name);
  EXPECT_NEAR(number(outer.parameters, "amount"), 0.1, 1e-12);
  const MaterialDescription inner =
      material(d, parameter(outer.parameters, "materials").strings.at(0));
  EXPECT_NEAR(number(inner.parameters, "amount"), 0.4 / 0.9, 1e-12);
  const MaterialDescription first =
      material(d, parameter(inner.parameters, "materials").strings.at(0));
  EXPECT_NEAR(number(first.parameters, "amount"), 0.3 / 0.5, 1e-12);
}

TEST(MitsubaBsdf, BumpAndNormalMapsAreParametersOfACopy) {
  MitsubaScene scene;
  const SceneDescription d = scene.read(
      "<bsdf type=\"diffuse\" id=\"plain\"/>\n<shape type=\"sphere\"><ref id=\"plain\"/></shape>\n"
      "<shape type=\"sphere\"><bsdf type=\"bumpmap\"><float name=\"scale\" value=\"2\"/>"
      "<texture type=\"checkerboard\"/><ref id=\"plain\"/></bsdf></shape>\n"
      "<shape type=\"sphere\"><bsdf type=\"normalmap\"><texture type=\"bitmap\" "
      "name=\"normalmap\">" +
      value("string", "filename", "n.png") + "</texture><ref id=\"plain\"/></bsdf></shape>\n");
  EXPECT_FALSE(has_parameter(material(d, d.shapes[0].material.name).parameters, "displacement"));
  const std::string height =
      text(material(d, d.shapes[1].material.name).parameters, "displacement");
  EXPECT_EQ(d.textures.back().name, height);
  EXPECT_EQ(number(d.textures.back().parameters, "scale"), 2);
  EXPECT_EQ(text(material(d, d.shapes[2].material.name).parameters, "normalmap"), "n.png");
}

TEST(MitsubaBsdf, BacksOfOpenShapesGetOneWarning) {
  const std::string open = "<shape type=\"rectangle\">" + bsdf("diffuse") + "</shape>\n";
  MitsubaScene scene;
  scene.read(open + open);
  EXPECT_EQ(scene.warnings(),
            "scene.xml:2:1: 2 open shapes have one-sided BSDFs, this is the first: the back is "
            "black in Mitsuba, and like the front here\n");
  for (const std::string& harmless :
       {"<shape type=\"cube\">" + bsdf("diffuse") + "</shape>\n",
        "<shape type=\"sphere\">" + bsdf("plastic") + "</shape>\n",
        "<shape type=\"rectangle\">" + bsdf("twosided", bsdf("diffuse")) + "</shape>\n",
        "<shape type=\"rectangle\">" + bsdf("dielectric") + "</shape>\n"}) {
    MitsubaScene other;
    other.read(harmless);
    EXPECT_EQ(other.warnings(), "") << harmless;
  }
}

}  // namespace
}  // namespace nephroid::testing
