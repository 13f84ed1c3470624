// OBJ files in Mitsuba scenes: BSDFs of their parts, and MTL materials.
#include "unit/input/mitsuba_scene.h"

namespace nephroid::testing {
namespace {

const std::string kFile = "<string name=\"filename\" value=\"parts/two.obj\"/>";

/// A scene with a file of two triangles, of the materials "Glass" and "Water".
class TwoParts : public MitsubaScene {
 public:
  TwoParts() {
    folder().write("parts/two.obj",
                   "mtllib two.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\n"
                   "usemtl Glass\nf 1/1 2/1 3/1\nusemtl Water\nf 1/1 2/1 4/1\n");
    folder().write("parts/two.mtl",
                   "newmtl Water\nKd 0.1 0.2 0.3\nmap_Kd water.png\nnewmtl Glass\nKd 0.5 0.5 0.5\n"
                   "d 0.25\n");
  }
  SceneDescription with(const std::string& body, const std::string& version = "0.6.0") {
    return read("<shape type=\"obj\">" + kFile + body + "</shape>\n", version);
  }
};

TEST(MitsubaObj, BsdfsMayHaveTheNamesOfMaterialsInTheFile) {
  TwoParts scene;
  const SceneDescription d = scene.with(
      "<bsdf type=\"diffuse\"/><bsdf name=\"Water\" type=\"dielectric\" id=\"water\"/>", "3.0.0");
  ASSERT_EQ(d.shapes.size(), 2u);
  EXPECT_EQ(material(d, d.shapes[0].material.name).type, "diffuse");
  EXPECT_EQ(d.shapes[1].material.name, "water");
  EXPECT_EQ(scene.warnings().find("several BSDFs"), std::string::npos);
}

TEST(MitsubaObj, ABsdfOfAnotherNameIsThatOfTheShape) {
  TwoParts scene;
  const SceneDescription d = scene.with("<bsdf name=\"bsdf\" type=\"conductor\"/>", "3.0.0");
  ASSERT_EQ(d.shapes.size(), 1u);
  EXPECT_EQ(material(d, d.shapes[0].material.name).type, "conductor");
}

TEST(MitsubaObj, MtlMaterialsCountInTheOldVersionWithoutABsdf) {
  TwoParts scene;
  const SceneDescription d = scene.with("");
  ASSERT_EQ(d.shapes.size(), 2u);
  EXPECT_EQ(d.shapes[0].material.name, "Glass");
  EXPECT_EQ(number(d.shapes[0].parameters, "alpha"), 0.25);
  const MaterialDescription water = material(d, "Water");
  EXPECT_EQ(water.type, "principled");
  ASSERT_EQ(d.textures.size(), 1u);
  EXPECT_EQ(text(water.parameters, "base_color"), d.textures[0].name);
  EXPECT_EQ(text(d.textures[0].parameters, "filename"), "parts/water.png");
  EXPECT_EQ(scene.with("<bsdf type=\"diffuse\"/>").shapes.size(), 1u);
  EXPECT_EQ(scene.with("<boolean name=\"loadMaterials\" value=\"false\"/>").shapes.size(), 1u);
  EXPECT_EQ(scene.with("<boolean name=\"collapse\" value=\"true\"/>").shapes.size(), 1u);
  EXPECT_EQ(scene.with("", "3.0.0").shapes.size(), 1u);
}

TEST(MitsubaObj, MaterialsOfTwoFilesKeepTheirTextures) {
  TwoParts scene;
  scene.folder().write("other/two.obj",
                       "mtllib two.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\n"
                       "usemtl Water\nf 1/1 2/1 3/1\n");
  scene.folder().write("other/two.mtl", "newmtl Water\nmap_Kd sea.png\n");
  const SceneDescription d =
      scene.with("</shape><shape type=\"obj\"><string name=\"filename\" value=\"other/two.obj\"/>");
  ASSERT_EQ(d.textures.size(), 2u);
  EXPECT_NE(d.textures[0].name, d.textures[1].name);
  const MaterialDescription sea = material(d, d.shapes.at(2).material.name);
  EXPECT_EQ(text(sea.parameters, "base_color"), d.textures[1].name);
}

TEST(MitsubaObj, AWrongMtlFileIsAWarning) {
  TwoParts scene;
  scene.folder().write("parts/two.mtl", "newmtl Water\nmap_Kd ../../../etc/passwd\n");
  EXPECT_EQ(scene.with("").shapes.size(), 1u);
  EXPECT_NE(scene.warnings().find("its MTL materials are ignored"), std::string::npos)
      << scene.warnings();
}

}  // namespace
}  // namespace nephroid::testing
