// MTL materials as "principled", area lights and opacity.
#include <gtest/gtest.h>

#include "input/contained_file.h"
#include "input/obj/obj_scene.h"
#include "input/scene_reader.h"
#include "unit/input/parse_text.h"
#include "unit/input/temporary_directory.h"

namespace nephroid {
namespace {

using testing::error_of;
using testing::TemporaryDirectory;

class MtlTest : public ::testing::Test {
 protected:
  /// A triangle of material "m", which is defined by `mtl`.
  SceneDescription read(const std::string& mtl, const ImportOptions& options = {}) {
    directory_.write("m.mtl", "newmtl m\n" + mtl);
    return read_triangle("mtllib m.mtl\nusemtl m\n", options);
  }
  SceneDescription read_triangle(const std::string& head, const ImportOptions& options = {}) {
    const std::string path =
        directory_.write("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n" + head + "f 1 2 3\n");
    return read_obj_scene(path, options, diagnostics_);
  }
  std::string warnings() {
    std::string all;
    for (const Warning& warning : diagnostics_.warnings()) all += warning.message + "\n";
    return all;
  }
  static float number(const SceneDescription& scene, const char* name, float fallback) {
    return scene.materials.at(0).parameters.get_float(name, fallback);
  }
  static std::vector<double> color(const SceneDescription& scene, const char* name) {
    const Parameter* found = scene.materials.at(0).parameters.find(name);
    return found ? found->numbers : std::vector<double>();
  }
  static std::string texture(const ParameterSet& parameters, const char* name) {
    const Parameter* found = parameters.find(name);
    return found && found->type == "texture" ? found->strings.at(0) : "";
  }

  TemporaryDirectory directory_;
  Diagnostics diagnostics_;
};

TEST_F(MtlTest, PlasticHasALobeOfItsExponent) {
  const SceneDescription scene = read("Kd .5 .25 0\nKs .2 .1 .1\nNs 30\nNi 1.4\nillum 2\n");
  EXPECT_EQ(scene.materials.at(0).type, "principled");
  EXPECT_EQ(scene.materials.at(0).name, "m");
  EXPECT_EQ(color(scene, "base_color"), (std::vector<double>{0.5, 0.25, 0}));
  EXPECT_FLOAT_EQ(number(scene, "specular_weight", 1), 0.2f);
  EXPECT_EQ(color(scene, "specular_color"), (std::vector<double>{1, 0.5, 0.5}));
  EXPECT_FLOAT_EQ(number(scene, "specular_ior", 0), 1.4f);
  // alpha = sqrt(2 / 32) = 1/4 = roughness^2
  EXPECT_FLOAT_EQ(number(scene, "specular_roughness", 0), 0.5f);
  EXPECT_EQ(warnings(), "");
}

TEST_F(MtlTest, WithoutHighlightAMaterialIsMatte) {
  EXPECT_EQ(number(read("Kd 1 1 1\nKs 1 1 1\nillum 1\n"), "specular_weight", 1), 0);
  EXPECT_EQ(number(read("Kd 1 1 1\n"), "specular_weight", 1), 0);
}

TEST_F(MtlTest, MirrorsAreMetalsOfTheirSpecularColour) {
  const SceneDescription scene = read("Kd 0 0 0\nKs 1 .8 .3\nNs 1000\nillum 3\n");
  EXPECT_EQ(number(scene, "base_metalness", 0), 1);
  EXPECT_EQ(number(scene, "specular_roughness", 1), 0);
  EXPECT_EQ(color(scene, "base_color"), (std::vector<double>{1, 0.8, 0.3}));
}

TEST_F(MtlTest, IllumAndIndexSayWhetherDIsGlassOrOpacity) {
  const SceneDescription glass = read("Kd 0 0 0\nd .1\nNi 1.5\nTf .9 1 .9\nillum 4\n");
  EXPECT_FLOAT_EQ(number(glass, "transmission_weight", 0), 0.9f);
  EXPECT_EQ(color(glass, "transmission_color"), (std::vector<double>{0.9, 1, 0.9}));
  EXPECT_EQ(number(glass, "specular_roughness", 1), 0);
  EXPECT_EQ(glass.shapes.at(0).parameters.find("alpha"), nullptr);

  EXPECT_EQ(number(read("illum 7\nNi 1.3\n"), "transmission_weight", 0), 1);

  const SceneDescription leaf = read("Kd 1 1 1\nTr .75\n");
  EXPECT_EQ(number(leaf, "transmission_weight", 0), 0);
  EXPECT_EQ(leaf.shapes.at(0).parameters.get_float("alpha", 1), 0.25f);
  EXPECT_EQ(read("d .25\nillum 4\nNi 1\n").shapes.at(0).parameters.get_float("alpha", 1), 0.25f);

  ImportOptions solid;
  solid.solid_glass = true;
  EXPECT_EQ(number(read("d .25\n", solid), "transmission_weight", 0), 0.75f);
}

TEST_F(MtlTest, PhysicallyBasedKeywordsWin) {
  const SceneDescription scene =
      read("Kd .5 .5 .5\nNs 10\nPr .2\nPm 1\nPs .1\nPc .3\nPcr .4\naniso .5\n");
  EXPECT_FLOAT_EQ(number(scene, "specular_roughness", 0), 0.2f);
  EXPECT_EQ(number(scene, "base_metalness", 0), 1);
  EXPECT_FLOAT_EQ(number(scene, "fuzz_weight", 0), 0.1f);
  EXPECT_FLOAT_EQ(number(scene, "coat_weight", 0), 0.3f);
  EXPECT_FLOAT_EQ(number(scene, "coat_roughness", 0), 0.4f);
  EXPECT_FLOAT_EQ(number(scene, "specular_roughness_anisotropy", 0), 0.5f);
}

TEST_F(MtlTest, EmissionIsAnAreaLight) {
  const SceneDescription scene = read("Kd 0 0 0\nKe 5 4 3\n");
  const auto& light = scene.shapes.at(0).area_light;
  ASSERT_TRUE(light);
  EXPECT_EQ(light->parameters.find("L")->numbers, (std::vector<double>{5, 4, 3}));
  EXPECT_TRUE(light->parameters.get_bool("twosided", false));
  EXPECT_EQ(light->parameters.get_string("name", ""), "m") << "the name of the material";
  EXPECT_FALSE(read("Ke 0 0 0\n").shapes.at(0).area_light);
}

TEST_F(MtlTest, ImagesHaveTheirOptions) {
  const SceneDescription scene = read(
      "Kd .5 .5 .5\nmap_Kd -s 2 3 1 -o .1 .2 -clamp on dir\\a b.png\nmap_d leaf.png\n"
      "map_Bump -bm 0.02 bump.png\nMAP_PR r.png\n");
  ASSERT_EQ(scene.textures.size(), 4u);
  const auto find = [&](const std::string& name) -> const TextureDescription& {
    for (const TextureDescription& t : scene.textures)
      if (t.name == name) return t;
    ADD_FAILURE() << name;
    return scene.textures[0];
  };
  const ParameterSet& m = scene.materials.at(0).parameters;
  const TextureDescription& base = find(texture(m, "base_color"));
  EXPECT_EQ(base.value_type, "spectrum");
  EXPECT_EQ(base.parameters.get_string("filename", ""), "dir/a b.png");
  EXPECT_EQ(base.parameters.get_float("uscale", 1), 2);
  EXPECT_EQ(base.parameters.get_float("vscale", 1), 3);
  EXPECT_FLOAT_EQ(base.parameters.get_float("vdelta", 0), 0.2f);
  EXPECT_EQ(base.parameters.get_string("wrap", ""), "clamp");
  EXPECT_EQ(base.parameters.get_float("scale", 1), 0.5f);
  EXPECT_FLOAT_EQ(find(texture(m, "displacement")).parameters.get_float("scale", 1), 0.02f);
  EXPECT_EQ(find(texture(m, "specular_roughness")).value_type, "float");
  const TextureDescription& alpha = find(texture(scene.shapes.at(0).parameters, "alpha"));
  EXPECT_EQ(alpha.parameters.get_string("filename", ""), "leaf.png");
}

TEST_F(MtlTest, NormalMapsAndEmissionHaveTheOptionsOfTheirImages) {
  const SceneDescription scene =
      read("norm -s 4 2 1 -o .5 0 0 -clamp on n.png\nKe .1 .4 .2\nmap_Ke -s 2 2 1 e.png\n");
  const ParameterSet& surface = scene.materials.at(0).parameters;
  EXPECT_EQ(surface.get_floats("normalmap.uvtransform"), (std::vector<float>{4, 0, 0.5f, 0, 2, 0}));
  EXPECT_EQ(surface.get_string("normalmap.uwrap", ""), "clamp");
  const ParameterSet& light = scene.shapes.at(0).area_light->parameters;
  EXPECT_EQ(light.get_floats("uvtransform"), (std::vector<float>{2, 0, 0, 0, 2, 0}));
  EXPECT_EQ(light.get_string("vwrap", ""), "repeat");
  EXPECT_EQ(light.get_float("scale", 0), 0.4f);
  EXPECT_EQ(light.find("factor")->numbers, (std::vector<double>{0.25, 1, 0.5}));
}

TEST_F(MtlTest, AnIndexOfOneLeavesTheHighlight) {
  EXPECT_EQ(
      read("Ks .5 .5 .5\nNi 1\nillum 2\n").materials.at(0).parameters.get_float("specular_ior", 0),
      1.5f);
  EXPECT_EQ(read("Ks .5 .5 .5\nNi 1.3\nillum 2\n")
                .materials.at(0)
                .parameters.get_float("specular_ior", 0),
            1.3f);
}

TEST_F(MtlTest, ImagesOfNumbersAreLinear) {
  const SceneDescription scene =
      read("map_Kd a.jpg\nmap_d b.jpg\nmap_Pr c.png\nmap_Pm d.tga\nmap_bump e.jpg\n");
  ASSERT_EQ(scene.textures.size(), 5u);
  for (const TextureDescription& t : scene.textures) {
    const bool is_number = t.value_type == "float";
    EXPECT_EQ(is_number, t.parameters.get_string("filename", "") != "a.jpg");
    EXPECT_EQ(t.parameters.get_string("encoding", ""), is_number ? "linear" : "");
    EXPECT_EQ(t.parameters.get_bool("forceencoding", false), is_number);
  }
}

TEST_F(MtlTest, ImagesAreInTheFolderOfTheirLibrary) {
  directory_.write("lib/m.mtl", "newmtl m\nmap_Kd a.png\nnorm n.png\n");
  const SceneDescription scene = read_triangle("mtllib lib/m.mtl\nusemtl m\n");
  EXPECT_EQ(scene.textures.at(0).parameters.get_string("filename", ""), "lib/a.png");
  EXPECT_EQ(scene.materials.at(0).parameters.get_string("normalmap", ""), "lib/n.png");
}

TEST_F(MtlTest, FilesOutsideOfTheFolderNeedPermission) {
  TemporaryDirectory other;
  other.write("o.mtl", "newmtl m\nKd 1 0 0\n");
  const std::string head = "mtllib " + other.path("o.mtl") + "\nusemtl m\n";
  EXPECT_NE(error_of([&] { read_triangle(head); }).find("lies outside of the scene's folder"),
            std::string::npos);
  EXPECT_NE(error_of([&] { read("map_Kd ../../a.png\n"); }).find("m.mtl:2: \"../../a.png\" lies"),
            std::string::npos);
  std::filesystem::create_symlink(other.path("o.mtl"), directory_.path("link.mtl"));
  EXPECT_NE(error_of([&] { read_triangle("mtllib link.mtl\n"); }).find("lies outside"),
            std::string::npos);
  ImportOptions allowed;
  allowed.allow_outside = true;
  EXPECT_EQ(read_triangle(head, allowed).materials.at(0).type, "principled");
}

TEST_F(MtlTest, AMissingFileInTheCurrentFolderIsNotOutside) {
  const SceneFiles files(".");
  EXPECT_EQ(contained_file(files, "no-such-file.png", false, {}), "no-such-file.png");
  EXPECT_NE(error_of([&] {
              contained_file(files, "../no-such-file.png", false, {});
            }).find("lies outside"),
            std::string::npos);
}

TEST_F(MtlTest, WhatIsMissingIsGreyWithAWarning) {
  EXPECT_EQ(read_triangle("mtllib no.mtl\nusemtl m\n").materials.at(0).type, "diffuse");
  EXPECT_NE(warnings().find("no.mtl"), std::string::npos);
  EXPECT_NE(warnings().find("material \"m\" is not defined"), std::string::npos);
}

TEST_F(MtlTest, AFileWithoutFacesIsAnError) {
  const std::string path = directory_.write("e.obj", "v 0 0 0\n");
  EXPECT_NE(error_of([&] { read_obj_scene(path, {}, diagnostics_); }).find("has no faces"),
            std::string::npos);
}

TEST_F(MtlTest, WrongValuesAreErrorsAndUnknownKeywordsWarnings) {
  const auto error = [&](const std::string& mtl) {
    const std::string message = error_of([&] { read(mtl); });
    return message.substr(message.find("m.mtl"));
  };
  EXPECT_EQ(error("Kd 1 x 0\n"), "m.mtl:2: \"x\" is not a number, expected a finite one");
  EXPECT_EQ(error("Kd\n"), "m.mtl:2: \"Kd\" has no number, expected one");
  EXPECT_EQ(error("Kd 1 0\n"), "m.mtl:2: \"Kd\" has 2 numbers, expected 3 or 1");
  EXPECT_EQ(error("Ns\n"), "m.mtl:2: \"Ns\" has no number, expected one");
  EXPECT_EQ(error("Ns nan\n"), "m.mtl:2: \"nan\" is not a number, expected a finite one");
  read("Kd 1\nKd spectral a.rfl\nmap_Kd\nfoo 1\nKdd 1\nrefl a.png\nKa 1 1 1\n");
  EXPECT_EQ(warnings(),
            "\"Kd spectral\" is ignored, expected three numbers\n"
            "\"map_Kd\" names no file and is ignored\n"
            "\"Kdd\" is ignored: the format has no such keyword, did you mean \"Kd\"?\n"
            "\"foo\" is ignored: the format has no such keyword\n"
            "\"refl\" is ignored: reflections are rendered, not looked up\n");
}

}  // namespace
}  // namespace nephroid
