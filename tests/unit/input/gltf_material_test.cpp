// Materials of glTF in the terms of "principled", their textures, opacity, emission and interior.
#include "unit/input/gltf_material.h"

#include <gtest/gtest.h>

#include <cmath>

namespace nephroid::testing {
namespace {

TEST(GltfMaterials, FactorsOfMetallicRoughness) {
  const ReadScene read = read_material(
      R"("name":"paint","pbrMetallicRoughness":{"baseColorFactor":[0.1,0.2,0.3,1],"metallicFactor":0.25,"roughnessFactor":0.5})");
  EXPECT_EQ(read.scene.materials.at(0).type, "principled");
  EXPECT_EQ(read.scene.materials.at(0).name, "paint");
  const ParameterSet& p = parameters_of(read);
  EXPECT_EQ(numbers_of(p, "base_color"), (std::vector<double>{0.1, 0.2, 0.3}));
  EXPECT_EQ(number_of(p, "base_metalness"), 0.25);
  EXPECT_EQ(number_of(p, "specular_roughness"), 0.5);
  EXPECT_EQ(number_of(p, "specular_ior"), 1.5);
  EXPECT_EQ(read.scene.shapes.at(0).material.index, 0);
  EXPECT_FALSE(read.scene.shapes[0].area_light);
  EXPECT_TRUE(numbers_of(read.scene.shapes[0].parameters, "uv").empty());
}

TEST(GltfMaterials, TheDefaultIsARoughWhiteMetal) {
  const TriangleScene t;
  const ReadScene read = read_gltf_text(t.file.text(t.members()));
  const ParameterSet& p = parameters_of(read);
  EXPECT_EQ(numbers_of(p, "base_color"), (std::vector<double>{1, 1, 1}));
  EXPECT_EQ(number_of(p, "base_metalness"), 1);
  EXPECT_EQ(number_of(p, "specular_roughness"), 1);
}

TEST(GltfMaterials, TexturesAreLookupsOfChannels) {
  const ReadScene read = read_material(
      R"("pbrMetallicRoughness":{"baseColorTexture":{"index":0},"baseColorFactor":[1,0.5,1,1],)"
      R"("metallicRoughnessTexture":{"index":1,"texCoord":1},"roughnessFactor":0.5})");
  const ParameterSet& p = parameters_of(read);
  const TextureDescription& color = texture_of(read, p, "base_color");
  EXPECT_EQ(color.type, "imagemap");
  EXPECT_EQ(color.value_type, "spectrum");
  EXPECT_EQ(string_of(color.parameters, "filename"), "a.png");
  EXPECT_EQ(string_of(color.parameters, "encoding"), "sRGB");
  EXPECT_EQ(numbers_of(color.parameters, "factor"), (std::vector<double>{1, 0.5, 1}));
  EXPECT_TRUE(numbers_of(color.parameters, "uvset").empty());
  const TextureDescription& metal = texture_of(read, p, "base_metalness");
  const TextureDescription& rough = texture_of(read, p, "specular_roughness");
  EXPECT_EQ(string_of(metal.parameters, "channel"), "b");
  EXPECT_EQ(string_of(rough.parameters, "channel"), "g");
  EXPECT_EQ(string_of(rough.parameters, "encoding"), "linear");
  EXPECT_EQ(number_of(rough.parameters, "scale"), 0.5);
  EXPECT_EQ(string_of(rough.parameters, "uwrap"), "clamp");
  EXPECT_EQ(string_of(rough.parameters, "vwrap"), "mirror");
  EXPECT_EQ(number_of(rough.parameters, "uvset"), 1);
  // v runs upwards.
  const ParameterSet& shape = read.scene.shapes.at(0).parameters;
  EXPECT_EQ(numbers_of(shape, "uv"), (std::vector<double>{0, 1, 1, 1, 0, 0.75}));
  EXPECT_EQ(numbers_of(shape, "uv2"), (std::vector<double>{0, 1, 0.5, 1, 0, 0.5}));
}

TEST(GltfMaterials, TextureTransformsActOnCoordinatesWithVUpwards) {
  const ReadScene read = read_material(
      R"("pbrMetallicRoughness":{"baseColorTexture":{"index":0,"extensions":{"KHR_texture_transform":)"
      R"({"offset":[0,1],"rotation":1.57079632679489662,"scale":[0.5,0.5]}}}})");
  const std::vector<double> m =
      numbers_of(texture_of(read, parameters_of(read), "base_color").parameters, "uvtransform");
  ASSERT_EQ(m.size(), 6u);
  // The example of the specification: the lower left quadrant of the image, turned clockwise.
  const auto at = [&](double u, double v_down) {
    const double v = 1 - v_down;
    return Vec2f(static_cast<float>(m[0] * u + m[1] * v + m[2]),
                 static_cast<float>(1 - (m[3] * u + m[4] * v + m[5])));
  };
  EXPECT_LT((at(0, 0) - Vec2f(0, 1)).length(), 1e-6f);
  EXPECT_LT((at(1, 0) - Vec2f(0, 0.5f)).length(), 1e-6f);
  EXPECT_LT((at(0, 1) - Vec2f(0.5f, 1)).length(), 1e-6f);
}

TEST(GltfMaterials, EqualLookupsAreOneTexture) {
  const ReadScene read = read_material(
      R"("pbrMetallicRoughness":{"baseColorTexture":{"index":0}},"extensions":{"KHR_materials_transmission":{"transmissionFactor":1}})");
  const ParameterSet& p = parameters_of(read);
  EXPECT_EQ(string_of(p, "base_color"), string_of(p, "transmission_color"));
  EXPECT_EQ(read.scene.textures.size(), 1u);
}

TEST(GltfMaterials, AlphaModes) {
  const std::string pbr =
      R"(,"pbrMetallicRoughness":{"baseColorFactor":[1,1,1,0.4],"baseColorTexture":{"index":0}})";
  EXPECT_EQ(string_of(read_material(R"("alphaMode":"OPAQUE")" + pbr).scene.shapes.at(0).parameters,
                      "alpha"),
            "");
  const ReadScene blend = read_material(R"("alphaMode":"BLEND")" + pbr);
  const TextureDescription& t = texture_of(blend, blend.scene.shapes.at(0).parameters, "alpha");
  EXPECT_EQ(string_of(t.parameters, "channel"), "a");
  EXPECT_EQ(number_of(t.parameters, "scale"), 0.4);
  EXPECT_EQ(t.parameters.find("cutoff"), nullptr);
  const ReadScene mask = read_material(R"("alphaMode":"MASK","alphaCutoff":0.3)" + pbr);
  const TextureDescription& m = texture_of(mask, mask.scene.shapes.at(0).parameters, "alpha");
  EXPECT_EQ(number_of(m.parameters, "cutoff"), 0.3);
  const std::string factor = R"(,"pbrMetallicRoughness":{"baseColorFactor":[1,1,1,0.4]})";
  EXPECT_EQ(
      number_of(read_material(R"("alphaMode":"BLEND")" + factor).scene.shapes.at(0).parameters,
                "alpha"),
      0.4);
  EXPECT_EQ(number_of(read_material(R"("alphaMode":"MASK")" + factor).scene.shapes.at(0).parameters,
                      "alpha"),
            0);
}

TEST(GltfMaterials, EmissionIsAnAreaLight) {
  const ReadScene read = read_material(
      R"("name":"lamp","doubleSided":true,"emissiveFactor":[1,0.5,0],"extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":4}})");
  const auto& light = read.scene.shapes.at(0).area_light;
  ASSERT_TRUE(light);
  EXPECT_EQ(light->type, "diffuse");
  EXPECT_EQ(numbers_of(light->parameters, "L"), (std::vector<double>{4, 2, 0}));
  EXPECT_TRUE(flag_of(light->parameters, "twosided"));
  EXPECT_EQ(string_of(light->parameters, "name"), "lamp");
  const ReadScene image = read_material(
      R"("emissiveFactor":[1,1,1],"emissiveTexture":{"index":1,"texCoord":1},"pbrMetallicRoughness":{"baseColorTexture":{"index":0}})");
  const auto& textured = image.scene.shapes.at(0).area_light;
  ASSERT_TRUE(textured);
  EXPECT_EQ(string_of(textured->parameters, "filename"), "b.jpg");
  EXPECT_EQ(string_of(textured->parameters, "uwrap"), "clamp");
  // Its coordinates are the first set of the mesh, those of the colour the second one.
  EXPECT_EQ(numbers_of(image.scene.shapes[0].parameters, "uv"),
            (std::vector<double>{0, 1, 0.5, 1, 0, 0.5}));
  EXPECT_EQ(number_of(texture_of(image, parameters_of(image), "base_color").parameters, "uvset"),
            1);
}

TEST(GltfMaterials, TransmissionIsThinWithoutVolume) {
  const std::string transmission = R"("KHR_materials_transmission":{"transmissionFactor":0.9})";
  const ReadScene thin = read_material(R"("extensions":{)" + transmission + "}");
  EXPECT_EQ(number_of(parameters_of(thin), "transmission_weight"), 0.9);
  EXPECT_TRUE(flag_of(parameters_of(thin), "geometry_thin_walled"));
  ASSERT_EQ(thin.warnings.size(), 1u);
  EXPECT_NE(thin.warnings[0].message.find("--solid-glass"), std::string::npos);
  ImportOptions solid;
  solid.solid_glass = true;
  const ReadScene solid_read = read_material(R"("extensions":{)" + transmission + "}", solid);
  EXPECT_FALSE(flag_of(parameters_of(solid_read), "geometry_thin_walled"));
  EXPECT_TRUE(solid_read.warnings.empty());
}

TEST(GltfMaterials, VolumesAreMediaInside) {
  const ReadScene read = read_material(
      R"("extensions":{"KHR_materials_transmission":{"transmissionFactor":1},"KHR_materials_ior":{"ior":1.33},)"
      R"("KHR_materials_volume":{"thicknessFactor":1,"attenuationDistance":2,"attenuationColor":[0.5,1,0]},)"
      R"("KHR_materials_dispersion":{"dispersion":0.5}})");
  ASSERT_EQ(read.scene.media.size(), 1u);
  EXPECT_EQ(read.scene.shapes.at(0).inside_medium, read.scene.media[0].name);
  const std::vector<double> absorption = numbers_of(read.scene.media[0].parameters, "sigma_a");
  ASSERT_EQ(absorption.size(), 3u);
  EXPECT_NEAR(std::exp(-2 * absorption[0]), 0.5, 1e-12);
  EXPECT_EQ(absorption[1], 0);
  EXPECT_LE(std::exp(-2 * absorption[2]), 1e-5);
  EXPECT_FALSE(flag_of(parameters_of(read), "geometry_thin_walled"));
  EXPECT_EQ(number_of(parameters_of(read), "specular_ior"), 1.33);
  EXPECT_EQ(number_of(parameters_of(read), "transmission_dispersion_abbe_number"), 40);
}

TEST(GltfMaterials, LayersOfExtensions) {
  const ReadScene read = read_material(
      R"("extensions":{"KHR_materials_clearcoat":{"clearcoatFactor":0.8,"clearcoatRoughnessFactor":0.1},)"
      R"("KHR_materials_sheen":{"sheenColorFactor":[0.5,0.25,0],"sheenRoughnessFactor":0.7},)"
      R"("KHR_materials_specular":{"specularFactor":0.6,"specularColorFactor":[1,0.5,0.5]},)"
      R"("KHR_materials_iridescence":{"iridescenceFactor":1,"iridescenceIor":1.4,"iridescenceThicknessMaximum":500},)"
      R"("KHR_materials_diffuse_transmission":{"diffuseTransmissionFactor":0.3}})");
  const ParameterSet& p = parameters_of(read);
  EXPECT_EQ(number_of(p, "coat_weight"), 0.8);
  EXPECT_EQ(number_of(p, "coat_roughness"), 0.1);
  EXPECT_EQ(number_of(p, "coat_ior"), 1.5);
  EXPECT_EQ(number_of(p, "coat_darkening"), 0);
  ASSERT_TRUE(p.find("coat_affects_specular"));
  EXPECT_FALSE(flag_of(p, "coat_affects_specular"));
  EXPECT_EQ(number_of(p, "fuzz_weight"), 0.5);
  EXPECT_EQ(numbers_of(p, "fuzz_color"), (std::vector<double>{1, 0.5, 0}));
  EXPECT_EQ(number_of(p, "fuzz_roughness"), 0.7);
  EXPECT_EQ(number_of(p, "specular_weight"), 0.6);
  EXPECT_EQ(numbers_of(p, "specular_color"), (std::vector<double>{1, 0.5, 0.5}));
  EXPECT_EQ(number_of(p, "thin_film_weight"), 1);
  EXPECT_EQ(number_of(p, "thin_film_thickness"), 0.5);
  EXPECT_EQ(number_of(p, "thin_film_ior"), 1.4);
  EXPECT_EQ(number_of(p, "diffuse_transmission_weight"), 0.3);
}

TEST(GltfMaterials, AnisotropyKeepsTheAlphasOfBothAxes) {
  const ReadScene read = read_material(
      R"("pbrMetallicRoughness":{"roughnessFactor":0.4},"extensions":{"KHR_materials_anisotropy":{"anisotropyStrength":0.7}})");
  const double r = number_of(parameters_of(read), "specular_roughness");
  const double s = number_of(parameters_of(read), "specular_roughness_anisotropy");
  const double along = r * r * std::sqrt(2 / (1 + (1 - s) * (1 - s)));
  EXPECT_NEAR(along, 0.16 + (1 - 0.16) * 0.49, 1e-9);
  EXPECT_NEAR((1 - s) * along, 0.16, 1e-9);
}

TEST(GltfMaterials, AnisotropyTexturesMixBothEnds) {
  const ReadScene read = read_material(
      R"("pbrMetallicRoughness":{"roughnessFactor":0.4},"extensions":{"KHR_materials_anisotropy":)"
      R"({"anisotropyStrength":0.7,"anisotropyTexture":{"index":0}}})");
  const ReadScene whole = read_material(
      R"("pbrMetallicRoughness":{"roughnessFactor":0.4},"extensions":{"KHR_materials_anisotropy":{"anisotropyStrength":0.7}})");
  for (const char* name : {"specular_roughness", "specular_roughness_anisotropy"}) {
    const ParameterSet& mix = texture_of(read, parameters_of(read), name).parameters;
    EXPECT_EQ(number_of(mix, "tex2"), number_of(parameters_of(whole), name)) << name;
    const ParameterSet& amount = texture_of(read, mix, "amount").parameters;
    EXPECT_EQ(string_of(amount, "channel"), "b");
  }
  const ParameterSet& p = parameters_of(read);
  EXPECT_NEAR(number_of(texture_of(read, p, "specular_roughness").parameters, "tex1"), 0.4, 1e-9);
  ASSERT_EQ(read.warnings.size(), 1u);
  EXPECT_NE(read.warnings[0].message.find("its directions do not"), std::string::npos);
}

TEST(GltfMaterials, ACoatWithAnotherNormalMapIsAWarning) {
  const auto warnings = [](const std::string& below, const std::string& coat) {
    GltfText file;
    const size_t normals = file.vec3({0, 0, 1, 0, 0, 1, 0, 0, 1});
    return read_material(below + R"("extensions":{"KHR_materials_clearcoat":{"clearcoatFactor":1)" +
                             coat + "}}",
                         {}, fmt::format(R"(,"NORMAL":{})", normals), file)
        .warnings.size();
  };
  const std::string below = R"("normalTexture":{"index":0,"scale":0.5},)";
  EXPECT_EQ(warnings("", ""), 0u);
  EXPECT_EQ(warnings(below, R"(,"clearcoatNormalTexture":{"index":0,"scale":0.5})"), 0u);
  EXPECT_EQ(warnings(below, R"(,"clearcoatNormalTexture":{"index":0})"), 1u);
  EXPECT_EQ(warnings(below, ""), 1u);
  EXPECT_EQ(warnings("", R"(,"clearcoatNormalTexture":{"index":0})"), 1u);
}

TEST(GltfMaterials, SpecularGlossinessIsADielectricOfThatReflectance) {
  const ReadScene read = read_material(
      R"("extensions":{"KHR_materials_pbrSpecularGlossiness":{"diffuseFactor":[0.2,0.2,0.2,1],"specularFactor":[0.25,0.125,0.25],"glossinessFactor":0.75}})");
  const ParameterSet& p = parameters_of(read);
  EXPECT_EQ(number_of(p, "specular_ior"), 3);  // ((3 - 1) / (3 + 1))^2 = 1/4
  EXPECT_EQ(numbers_of(p, "specular_color"), (std::vector<double>{1, 0.5, 1}));
  EXPECT_EQ(number_of(p, "specular_roughness"), 0.25);
  EXPECT_EQ(numbers_of(p, "base_color"), (std::vector<double>{0.2, 0.2, 0.2}));
  EXPECT_EQ(read.warnings.size(), 1u);
}

TEST(GltfMaterials, VertexColorsMultiplyTheBaseColor) {
  GltfText file;
  const size_t colors = file.add_accessor<uint8_t>({255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 51},
                                                   "VEC4", 5121, 4, R"(,"normalized":true)");
  const ReadScene read =
      read_material(R"("alphaMode":"BLEND","pbrMetallicRoughness":{"baseColorFactor":[1,1,0.5,1]})",
                    {}, fmt::format(R"(,"COLOR_0":{})", colors), file);
  const TextureDescription& t = texture_of(read, parameters_of(read), "base_color");
  EXPECT_EQ(t.type, "vertexcolor");
  EXPECT_EQ(numbers_of(t.parameters, "factor"), (std::vector<double>{1, 1, 0.5}));
  const TextureDescription& alpha = texture_of(read, read.scene.shapes.at(0).parameters, "alpha");
  EXPECT_EQ(string_of(alpha.parameters, "channel"), "a");
  const std::vector<double> stored = numbers_of(read.scene.shapes[0].parameters, "vertexcolors");
  ASSERT_EQ(stored.size(), 12u);
  EXPECT_EQ(stored[0], 1);
  EXPECT_NEAR(stored[11], 0.2, 1e-6);
}

TEST(GltfMaterials, VariantsReplaceMaterials) {
  TriangleScene t;
  t.primitive_members =
      R"(,"material":0,"extensions":{"KHR_materials_variants":{"mappings":[{"material":1,"variants":[1]}]}})";
  const std::string text = t.file.text(t.members(
      R"(,"materials":[{"name":"a"},{"name":"b"}],"extensions":{"KHR_materials_variants":{"variants":[{"name":"day"},{"name":"night"}]}})"));
  const auto material_for = [&](const std::string& variant) {
    ImportOptions options;
    options.variant = variant;
    return read_gltf_text(text, options).scene.materials.at(0).name;
  };
  EXPECT_EQ(read_gltf_text(text).scene.choices.variants,
            (std::vector<std::string>{"day", "night"}));
  EXPECT_EQ(material_for(""), "a");
  EXPECT_EQ(material_for("day"), "a");
  EXPECT_EQ(material_for("night"), "b");
  ImportOptions options;
  options.variant = "dusk";
  EXPECT_EQ(gltf_error(text, options),
            "scene.gltf: there is no material variant \"dusk\", expected one of \"day\", "
            "\"night\"");
}

TEST(GltfMaterials, NormalMapsGetTangents) {
  GltfText file;
  const size_t normals = file.vec3({0, 0, 1, 0, 0, 1, 0, 0, 1});
  const ReadScene read = read_material(R"("normalTexture":{"index":0,"scale":0.5})", {},
                                       fmt::format(R"(,"NORMAL":{})", normals), file);
  const ParameterSet& p = parameters_of(read);
  EXPECT_EQ(string_of(p, "normalmap"), "a.png");
  EXPECT_EQ(number_of(p, "normalmap.scale"), 0.5);
  const std::vector<double> tangents = numbers_of(read.scene.shapes.at(0).parameters, "S");
  ASSERT_EQ(tangents.size(), 9u);
  EXPECT_NEAR(tangents[0], 1, 1e-6);
  EXPECT_NEAR(tangents[1], 0, 1e-6);
}

TEST(GltfMaterials, UnlitSurfacesEmitTheirColor) {
  const ReadScene read = read_material(
      R"("pbrMetallicRoughness":{"baseColorFactor":[0.1,0.2,0.3,1]},"extensions":{"KHR_materials_unlit":{}})");
  ASSERT_TRUE(read.scene.shapes.at(0).area_light);
  EXPECT_EQ(numbers_of(read.scene.shapes[0].area_light->parameters, "L"),
            (std::vector<double>{0.1, 0.2, 0.3}));
  EXPECT_EQ(numbers_of(parameters_of(read), "base_color"), (std::vector<double>{0, 0, 0}));
}

TEST(GltfMaterials, CompressedTexturesAreRefusedWithoutAFallback) {
  TriangleScene t;
  t.primitive_members = R"(,"material":0)";
  const auto text = [&](const std::string& source) {
    return t.file.text(t.members(
        R"(,"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],"textures":[{)" +
        source + R"("extensions":{"KHR_texture_basisu":{"source":1}}}],)" +
        R"("images":[{"uri":"a.png"},{"uri":"a.ktx2"}])"));
  };
  EXPECT_NE(gltf_error(text("")).find("#/textures/0/extensions/KHR_texture_basisu: images of"),
            std::string::npos);
  EXPECT_EQ(gltf_error(text(R"("source":0,)")), "");
}

TEST(GltfMaterials, NamesAreUnique) {
  TriangleScene t;
  t.primitive_members = R"(,"material":0},{"attributes":{"POSITION":0},"material":1)";
  const ReadScene read =
      read_gltf_text(t.file.text(t.members(R"(,"materials":[{"name":"m"},{"name":"m"}])")));
  ASSERT_EQ(read.scene.materials.size(), 2u);
  EXPECT_NE(read.scene.materials[0].name, read.scene.materials[1].name);
}

}  // namespace
}  // namespace nephroid::testing
