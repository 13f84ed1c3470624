// Subsurface scattering of Mitsuba, and the measured substances that media and subsurface
// scattering share.
#include "unit/input/mitsuba_scene.h"

namespace nephroid::testing {
namespace {

using Numbers = std::vector<double>;

/// A sphere with that BSDF and that subsurface scattering.
std::string sphere(const std::string& bsdf, const std::string& type, const std::string& body) {
  return "<shape type=\"sphere\">" + bsdf + "<subsurface type=\"" + type + "\">" + body +
         "</subsurface></shape>\n";
}
ParameterSet below(const std::string& body) {
  MitsubaScene scene;
  const SceneDescription d = scene.read(sphere("", "dipole", body));
  const MaterialDescription m = material(d, d.shapes.at(0).material.name);
  EXPECT_EQ(m.type, "subsurface");
  return m.parameters;
}

TEST(MitsubaSubsurface, ADipoleIsItsMediumBelowTheBoundaryOfTheBsdf) {
  MitsubaScene scene;
  const std::string plastic = "<bsdf type=\"roughplastic\">" + value("float", "alpha", "0.2") +
                              value("string", "distribution", "ggx") + "</bsdf>";
  const SceneDescription d = scene.read(
      sphere(plastic, "dipole",
             value("rgb", "sigmaS", "87.2, 127.2, 143.2") + value("rgb", "sigmaA", "1, 5.6, 11.6") +
                 value("string", "intIOR", "water") + value("float", "scale", "0.5") +
                 value("integer", "irrSamples", "64")));
  const ParameterSet set = material(d, d.shapes.at(0).material.name).parameters;
  EXPECT_EQ(parameter(set, "sigma_s").numbers, (Numbers{87.2, 127.2, 143.2}));
  EXPECT_EQ(parameter(set, "sigma_a").numbers, (Numbers{1, 5.6, 11.6}));
  EXPECT_EQ(number(set, "scale"), 0.5);
  EXPECT_EQ(number(set, "roughness"), 0.2);
  EXPECT_EQ(parameter(set, "remaproughness").bools, std::vector<bool>{false});
  EXPECT_NEAR(number(set, "eta"), 1.333 / 1.000277, 1e-12);
  EXPECT_EQ(scene.warnings().find("unknown"), std::string::npos) << scene.warnings();
}

TEST(MitsubaSubsurface, ExtinctionAndAlbedoAreTheSameMedium) {
  const ParameterSet set =
      below(value("rgb", "sigmaT", "1 2 4") + value("rgb", "albedo", "0.5 0.25 0"));
  EXPECT_EQ(parameter(set, "sigma_s").numbers, (Numbers{0.5, 0.5, 0}));
  EXPECT_EQ(parameter(set, "sigma_a").numbers, (Numbers{0.5, 1.5, 4}));
}

TEST(MitsubaSubsurface, SubstancesAreFoundWithoutCaseAndPerTenCentimetres) {
  const ParameterSet skin =
      below(value("string", "material", "skin2") + value("float", "scale", "2"));
  EXPECT_EQ(text(skin, "name"), "Skin2");
  EXPECT_EQ(number(skin, "scale"), 200);
  EXPECT_EQ(number(skin, "eta"), 1.3);
  MitsubaScene scene;
  const SceneDescription d =
      scene.read("<shape type=\"sphere\"><medium type=\"homogeneous\" name=\"interior\">" +
                 value("string", "material", "head & shoulders Shampoo") + "</medium></shape>\n");
  EXPECT_EQ(text(d.media.at(0).parameters, "preset"), "Head & Shoulders Shampoo");
}

TEST(MitsubaSubsurface, ShapesOfOneModelAndBoundaryShareTheMaterial) {
  MitsubaScene scene;
  const std::string shape = "<shape type=\"sphere\"><ref id=\"wax\"/><ref id=\"coat\"/></shape>\n";
  const SceneDescription d =
      scene.read("<bsdf type=\"plastic\" id=\"coat\"/><subsurface type=\"dipole\" id=\"wax\"/>\n" +
                 shape + shape + "<shape type=\"sphere\"><ref id=\"wax\"/></shape>\n");
  EXPECT_EQ(d.shapes.at(0).material.name, d.shapes.at(1).material.name);
  EXPECT_NE(d.shapes.at(0).material.name, d.shapes.at(2).material.name);
  EXPECT_EQ(scene.warnings().find("outside of other objects"), std::string::npos);
}

TEST(MitsubaSubsurface, OtherModelsLeaveTheBsdf) {
  MitsubaScene scene;
  const SceneDescription d =
      scene.read(sphere("<bsdf type=\"plastic\"/>", "vaescatter", value("float", "g", "0.5")));
  EXPECT_EQ(material(d, d.shapes.at(0).material.name).type, "coateddiffuse");
  EXPECT_NE(
      scene.warnings().find("subsurface \"vaescatter\" is ignored: only the BSDF is rendered"),
      std::string::npos);
}

}  // namespace
}  // namespace nephroid::testing
