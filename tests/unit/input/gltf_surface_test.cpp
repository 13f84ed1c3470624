// Materials of glTF together with the mesh or volume that they need: tangents, sets of texture
// coordinates, vertex colours, interiors, and names among many.
#include <gtest/gtest.h>

#include <cmath>

#include "unit/input/gltf_material.h"

namespace nephroid::testing {
namespace {

TEST(GltfSurfaces, AnisotropyStretchesMirrors) {
  const ReadScene read = read_material(
      R"("pbrMetallicRoughness":{"roughnessFactor":0},"extensions":{"KHR_materials_anisotropy":{"anisotropyStrength":0.5}})");
  const double r = number_of(parameters_of(read), "specular_roughness");
  const double s = number_of(parameters_of(read), "specular_roughness_anisotropy");
  const double along = r * r * std::sqrt(2 / (1 + (1 - s) * (1 - s)));
  EXPECT_NEAR(along, 0.25, 1e-3);
  EXPECT_NEAR((1 - s) * along, 0, 1e-3);
}

TEST(GltfSurfaces, AnisotropyTurnsOnFlatMeshes) {
  const std::string material =
      R"("extensions":{"KHR_materials_anisotropy":{"anisotropyStrength":0.5,"anisotropyRotation":0.4}})";
  GltfText file;
  const size_t normals = file.vec3({0, 0, 1, 0, 0, 1, 0, 0, 1});
  const ReadScene flat = read_material(material);
  const ReadScene smooth =
      read_material(material, {}, fmt::format(R"(,"NORMAL":{})", normals), file);
  const std::vector<double> expected = numbers_of(smooth.scene.shapes.at(0).parameters, "S");
  const std::vector<double> tangents = numbers_of(flat.scene.shapes.at(0).parameters, "S");
  ASSERT_EQ(tangents.size(), 9u);
  ASSERT_EQ(expected.size(), 9u);
  EXPECT_NEAR(std::abs(tangents[1]), std::sin(0.4), 1e-6);
  for (size_t i = 0; i < 9; ++i) EXPECT_NEAR(tangents[i], expected[i], 1e-6);
}

TEST(GltfSurfaces, VolumesOfDiffuseTransmissionAreMediaInside) {
  const std::string volume =
      R"("KHR_materials_volume":{"thicknessFactor":1,"attenuationDistance":2,"attenuationColor":[0.5,1,1]})";
  const auto read = [&](const std::string& transmission) {
    return read_material(
        R"("extensions":{"KHR_materials_diffuse_transmission":{"diffuseTransmissionFactor":0.5},)" +
        transmission + volume + "}");
  };
  const ReadScene diffuse = read("");
  ASSERT_EQ(diffuse.scene.media.size(), 1u);
  EXPECT_EQ(diffuse.scene.shapes.at(0).inside_medium, diffuse.scene.media[0].name);
  const ReadScene both = read(R"("KHR_materials_transmission":{"transmissionFactor":0.2},)");
  EXPECT_EQ(both.scene.media.size(), 1u);
}

TEST(GltfSurfaces, NormalMapsTakeTheSetOfTheirTransform) {
  const ReadScene read = read_material(
      R"("normalTexture":{"index":0,"extensions":{"KHR_texture_transform":{"texCoord":1}}})");
  const ParameterSet& shape = read.scene.shapes.at(0).parameters;
  EXPECT_EQ(numbers_of(shape, "uv"), (std::vector<double>{0, 1, 0.5, 1, 0, 0.5}));
  EXPECT_TRUE(numbers_of(shape, "uv2").empty());
  EXPECT_TRUE(numbers_of(parameters_of(read), "normalmap.uvset").empty());
}

TEST(GltfSurfaces, UnlitSurfacesEmitTheMeanOfVertexColors) {
  GltfText file;
  const size_t colors = file.vec3({1, 0, 0, 0, 1, 0, 0.5f, 0.5f, 0});
  const auto read = [&](const std::string& texture) {
    return read_material(R"("pbrMetallicRoughness":{"baseColorFactor":[1,0.5,1,1])" + texture +
                             R"(},"extensions":{"KHR_materials_unlit":{}})",
                         {}, fmt::format(R"(,"COLOR_0":{})", colors), file);
  };
  const ReadScene plain = read("");
  const ShapeDescription& shape = plain.scene.shapes.at(0);
  EXPECT_EQ(numbers_of(shape.area_light.value().parameters, "L"),
            (std::vector<double>{0.5, 0.25, 0}));
  EXPECT_TRUE(numbers_of(shape.parameters, "vertexcolors").empty());
  EXPECT_EQ(plain.warnings.size(), 2u);
  const ReadScene image = read(R"(,"baseColorTexture":{"index":0})");
  EXPECT_EQ(numbers_of(image.scene.shapes.at(0).area_light.value().parameters, "factor"),
            (std::vector<double>{0.5, 0.25, 0}));
}

TEST(GltfSurfaces, ManyTakenNamesDoNotOverflowTheStack) {
  // "a.2" to "a.100001", and then "a" twice.
  constexpr int kTaken = 100000;
  std::string materials, primitives;
  auto add = [&, count = 0](const std::string& name) mutable {
    const std::string comma = count > 0 ? "," : "";
    materials += fmt::format(R"({}{{"name":"{}"}})", comma, name);
    primitives += fmt::format(R"({}{{"attributes":{{}},"material":{}}})", comma, count++);
  };
  for (int i = 0; i < kTaken; ++i) add(fmt::format("a.{}", i + 2));
  add("a");
  add("a");
  const ReadScene read = read_gltf_text(
      R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0}],"meshes":[{"primitives":[)" + primitives +
      R"(]}],"materials":[)" + materials + "]}");
  ASSERT_EQ(read.scene.materials.size(), static_cast<size_t>(kTaken) + 2);
  EXPECT_EQ(read.scene.materials.back().name, fmt::format("a.{}", kTaken + 2));
}

}  // namespace
}  // namespace nephroid::testing
