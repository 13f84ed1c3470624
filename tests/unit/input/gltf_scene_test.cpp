// Nodes, meshes, cameras and lights of glTF as parts of the description.
#include <gtest/gtest.h>

#include <cmath>

#include "input/staging/surroundings.h"
#include "unit/input/gltf_text.h"

namespace nephroid::testing {
namespace {

ReadScene read_triangle(const TriangleScene& t, const std::string& more = "",
                        const ImportOptions& options = {}) {
  return read_gltf_text(t.file.text(t.members(more)), options);
}

Vec3d moved(const Mat44d& m, const Vec3d& p) {
  Vec3d result;
  m.multVecMatrix(p, result);
  return result;
}

void expect_near(const Vec3d& a, const Vec3d& b) {
  EXPECT_LT((a - b).length(), 1e-6) << a << " " << b;
}

TEST(GltfNodes, TranslationRotationScaleInThisOrder) {
  TriangleScene t;
  // A quarter turn about z.
  t.node_members =
      R"(,"translation":[10,0,0],"rotation":[0,0,0.70710678118654752,0.70710678118654752],"scale":[2,3,1])";
  const ReadScene read = read_triangle(t);
  const Mat44d& m = read.scene.shapes[0].transform.start;
  expect_near(moved(m, {1, 0, 0}), {10, 2, 0});
  expect_near(moved(m, {0, 1, 0}), {7, 0, 0});
}

TEST(GltfNodes, MatricesAreColumnByColumn) {
  TriangleScene t;
  t.node_members = R"(,"matrix":[0,1,0,0, -1,0,0,0, 0,0,1,0, 5,6,7,1])";
  expect_near(moved(read_triangle(t).scene.shapes[0].transform.start, {1, 0, 0}), {5, 7, 7});
}

TEST(GltfNodes, ChildrenAreBelowTheirParents) {
  const TriangleScene t;
  std::string text = t.file.text(t.members());
  const std::string nodes = R"("nodes":[{"mesh":0}])";
  text.replace(text.find(nodes), nodes.size(),
               R"("nodes":[{"mesh":0,"translation":[1,0,0]},{"children":[0],"scale":[2,2,2]},)"
               R"({"children":[1],"translation":[0,0,5]}],"scenes":[{"nodes":[2]}],"scene":0)");
  expect_near(moved(read_gltf_text(text).scene.shapes[0].transform.start, {1, 0, 0}), {4, 0, 5});
}

TEST(GltfNodes, OnlyTheChosenSceneIsShown) {
  const TriangleScene t;
  std::string text = t.file.text(t.members(R"(,"scenes":[{"nodes":[]},{"nodes":[0]}],"scene":0)"));
  EXPECT_TRUE(read_gltf_text(text).scene.shapes.empty());
  text.replace(text.find(R"("scene":0)"), 9, R"("scene":1)");
  EXPECT_EQ(read_gltf_text(text).scene.shapes.size(), 1u);
}

TEST(GltfNodes, CyclesAreErrors) {
  const std::string head = R"({"asset":{"version":"2.0"},"nodes":)";
  EXPECT_EQ(gltf_error(head + R"([{"children":[0]}]})"),
            "scene.gltf#/nodes/0: this node is a descendant of itself, expected a tree of nodes");
  EXPECT_NE(gltf_error(head + R"([{},{"children":[2]},{"children":[1]}]})"), "");
  EXPECT_EQ(gltf_error(head + R"([{"children":[2]},{"children":[2]},{}]})"),
            "scene.gltf#/nodes/1/children/0: node 2 is a child of two nodes, expected one parent");
  EXPECT_EQ(gltf_error(head + R"([{"children":[9]}]})"),
            "scene.gltf#/nodes/0/children/0: index 9 into \"nodes\" is out of range, expected an "
            "index below 1");
}

TEST(GltfNodes, ALongChainDoesNotOverflowTheStack) {
  std::string nodes = "{}";
  for (int i = 0; i < 100000; ++i) nodes += fmt::format(R"(,{{"children":[{}]}})", i);
  EXPECT_EQ(gltf_error(R"({"asset":{"version":"2.0"},"nodes":[)" + nodes + "]}"), "");
}

TEST(GltfNodes, AMeshScaledToNothingIsLeftOut) {
  TriangleScene t;
  t.node_members = R"(,"scale":[0,0,0])";
  const ReadScene read = read_triangle(t);
  EXPECT_TRUE(read.scene.shapes.empty());
  ASSERT_EQ(read.warnings.size(), 1u);
}

TEST(GltfMeshes, IndicesStripsAndFans) {
  const auto indices_of = [](int mode, const std::vector<uint16_t>& indices) {
    GltfText file;
    const size_t p = file.vec3({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0});
    std::string primitive = fmt::format(R"("attributes":{{"POSITION":{}}},"mode":{})", p, mode);
    if (!indices.empty())
      primitive += fmt::format(R"(,"indices":{})", file.add_accessor(indices, "SCALAR", 5123, 1));
    const ReadScene read = read_gltf_text(
        file.text(R"("nodes":[{"mesh":0}],"meshes":[{"primitives":[{)" + primitive + "}]}]"));
    return read.scene.shapes.empty() ? std::vector<double>()
                                     : numbers_of(read.scene.shapes[0].parameters, "indices");
  };
  EXPECT_EQ(indices_of(4, {0, 1, 2, 1, 3, 2}), (std::vector<double>{0, 1, 2, 1, 3, 2}));
  EXPECT_EQ(indices_of(5, {0, 1, 2, 3}), (std::vector<double>{0, 1, 2, 1, 3, 2}));
  EXPECT_EQ(indices_of(6, {0, 1, 3, 2}), (std::vector<double>{1, 3, 0, 3, 2, 0}));
  EXPECT_EQ(indices_of(5, {}), (std::vector<double>{0, 1, 2, 1, 3, 2}));
  EXPECT_TRUE(indices_of(0, {}).empty());
  EXPECT_TRUE(indices_of(1, {}).empty());
}

TEST(GltfMeshes, UnusedVerticesAreDropped) {
  GltfText file;
  const size_t p = file.vec3({9, 9, 9, 0, 0, 0, 1, 0, 0, 0, 1, 0});
  const size_t i = file.add_accessor<uint8_t>({3, 1, 2}, "SCALAR", 5121, 1);
  const ReadScene read = read_gltf_text(file.text(fmt::format(
      R"("nodes":[{{"mesh":0}}],"meshes":[{{"primitives":[{{"attributes":{{"POSITION":{}}},"indices":{}}}]}}])",
      p, i)));
  EXPECT_EQ(numbers_of(read.scene.shapes[0].parameters, "indices"), (std::vector<double>{2, 0, 1}));
  EXPECT_EQ(numbers_of(read.scene.shapes[0].parameters, "P").size(), 9u);
}

TEST(GltfMeshes, IndicesOutOfRangeAreErrors) {
  TriangleScene t;
  t.primitive_members =
      fmt::format(R"(,"indices":{})", t.file.add_accessor<uint16_t>({0, 1, 3}, "SCALAR", 5123, 1));
  EXPECT_EQ(gltf_error(t.file.text(t.members())),
            "scene.gltf#/meshes/0/primitives/0: vertex index 3 is out of range, there are 3 "
            "vertices");
}

TEST(GltfMeshes, RepeatedMeshesBecomeInstances) {
  const TriangleScene t;
  std::string text = t.file.text(t.members());
  const std::string nodes = R"("nodes":[{"mesh":0}])";
  text.replace(text.find(nodes), nodes.size(),
               R"("nodes":[{"mesh":0},{"mesh":0,"translation":[3,0,0]}])");
  const SceneDescription scene = read_gltf_text(text).scene;
  EXPECT_TRUE(scene.shapes.empty());
  ASSERT_EQ(scene.objects.size(), 1u);
  EXPECT_EQ(scene.objects.begin()->second.shapes.size(), 1u);
  ASSERT_EQ(scene.instances.size(), 2u);
  expect_near(moved(scene.instances[1].transform.start, {0, 0, 0}), {3, 0, 0});
}

TEST(GltfMeshes, RepeatedLampsStandInTheWorld) {
  TriangleScene t;
  t.primitive_members = R"(,"material":0)";
  std::string text = t.file.text(t.members(R"(,"materials":[{"emissiveFactor":[1,0,0]}])"));
  const std::string nodes = R"("nodes":[{"mesh":0}])";
  text.replace(text.find(nodes), nodes.size(),
               R"("nodes":[{"mesh":0},{"mesh":0,"translation":[3,0,0]}])");
  const SceneDescription scene = read_gltf_text(text).scene;
  EXPECT_TRUE(scene.instances.empty());
  ASSERT_EQ(scene.shapes.size(), 2u);
  EXPECT_TRUE(scene.shapes[1].area_light);
  expect_near(moved(scene.shapes[1].transform.start, {0, 0, 0}), {3, 0, 0});
}

TEST(GltfMeshes, GpuInstancesHaveTransformsOfTheirOwn) {
  TriangleScene t;
  const size_t translations = t.file.vec3({1, 0, 0, 2, 0, 0});
  t.node_members = fmt::format(
      R"(,"scale":[10,10,10],"extensions":{{"EXT_mesh_gpu_instancing":{{"attributes":{{"TRANSLATION":{}}}}}}})",
      translations);
  const SceneDescription scene = read_triangle(t).scene;
  ASSERT_EQ(scene.instances.size(), 2u);
  expect_near(moved(scene.instances[1].transform.start, {0.1, 0, 0}), {21, 0, 0});
}

TEST(GltfMeshes, InstancesWithoutDataAreFew) {
  const auto error_of = [](size_t count) {
    TriangleScene t;
    const size_t zeros = t.file.add_raw_accessor(
        fmt::format(R"("componentType":5126,"type":"VEC3","count":{})", count));
    t.node_members = fmt::format(
        R"(,"extensions":{{"EXT_mesh_gpu_instancing":{{"attributes":{{"TRANSLATION":{}}}}}}})",
        zeros);
    return gltf_error(t.file.text(t.members()));
  };
  EXPECT_EQ(error_of(1000), "");
  EXPECT_EQ(error_of(2000000),
            "scene.gltf#/nodes/0/extensions/EXT_mesh_gpu_instancing/attributes: the file claims "
            "more than 512 MB by elements without data, expected data for so many");
}

TEST(GltfMeshes, ElementsWithoutDataAreCountedOverTheFile) {
  // Each primitive takes 48 MB.
  const auto error_of = [](int primitives) {
    TriangleScene t;
    const size_t zeros =
        t.file.add_raw_accessor(R"("componentType":5126,"type":"VEC3","count":2000000)");
    const size_t corner = t.file.add_accessor<uint8_t>({0, 1, 2}, "SCALAR", 5121, 1);
    std::string more;
    for (int i = 0; i < primitives; ++i)
      more += fmt::format(R"(}},{{"attributes":{{"POSITION":{}}},"indices":{})", zeros, corner);
    t.primitive_members = more;
    return gltf_error(t.file.text(t.members()));
  };
  EXPECT_EQ(error_of(2), "");
  EXPECT_NE(error_of(12).find("by elements without data"), std::string::npos);
}

TEST(GltfCameras, PerspectiveLooksAlongMinusZ) {
  const std::string file =
      R"({"asset":{"version":"2.0"},"cameras":[{"type":"perspective","perspective":)"
      R"({"yfov":1,"aspectRatio":2,"znear":0.1}}],"nodes":[{"camera":0,"translation":[0,0,5]}]})";
  const SceneDescription scene = read_gltf_text(file).scene;
  ASSERT_TRUE(scene.camera);
  EXPECT_EQ(scene.camera->type, "perspective");
  EXPECT_NEAR(number_of(scene.camera->parameters, "fov"), 180 / 3.14159265358979, 1e-9);
  // A point ahead has positive z in pbrt's camera space, x and y stay.
  expect_near(moved(scene.camera->world_to_camera.start, {1, 2, 0}), {1, 2, 5});
  ASSERT_TRUE(scene.film);
  EXPECT_EQ(number_of(scene.film->parameters, "xresolution"), 1280);
  EXPECT_EQ(number_of(scene.film->parameters, "yresolution"), 640);
}

TEST(GltfCameras, SteepOnesLeaveTheWorldsUpWhereItIs) {
  const std::string file =
      R"({"asset":{"version":"2.0"},"cameras":[{"type":"perspective","perspective":)"
      R"({"yfov":1,"aspectRatio":2,"znear":0.1}}],"nodes":[{"camera":0,"translation":[0,9,3],)"
      R"("rotation":[-0.6,0,0,0.8]}]})";
  EXPECT_EQ(surroundings_of(read_gltf_text(file).scene).up, Vec3d(0, 1, 0));
}

TEST(GltfCameras, FovIsThatOfTheShorterSide) {
  const std::string file =
      R"({"asset":{"version":"2.0"},"cameras":[{"type":"perspective","perspective":)"
      R"({"yfov":1,"aspectRatio":0.5,"znear":0.1}}],"nodes":[{"camera":0}]})";
  const SceneDescription scene = read_gltf_text(file).scene;
  const double expected = 2 * std::atan(0.5 * std::tan(0.5)) * 180 / 3.14159265358979;
  EXPECT_NEAR(number_of(scene.camera->parameters, "fov"), expected, 1e-9);
  EXPECT_EQ(number_of(scene.film->parameters, "xresolution"), 640);
}

TEST(GltfCameras, TheChosenOneByNameOrIndex) {
  const std::string file =
      R"({"asset":{"version":"2.0"},"cameras":[{"type":"perspective","perspective":{"yfov":1}},)"
      R"({"type":"orthographic","orthographic":{"xmag":2,"ymag":1,"zfar":9,"znear":0}}],)"
      R"("nodes":[{"camera":0,"name":"front"},{"camera":1,"name":"top","scale":[3,3,3]}]})";
  const auto type_of = [&](const std::string& camera) {
    ImportOptions options;
    options.camera = camera;
    return read_gltf_text(file, options).scene.camera->type;
  };
  EXPECT_EQ(type_of(""), "perspective");
  EXPECT_EQ(type_of("top"), "orthographic");
  EXPECT_EQ(type_of("1"), "orthographic");
  EXPECT_EQ(type_of("front"), "perspective");
  EXPECT_EQ(read_gltf_text(file).scene.choices.cameras, (std::vector<std::string>{"front", "top"}));
  ImportOptions options;
  options.camera = "side";
  EXPECT_EQ(gltf_error(file, options),
            "scene.gltf: there is no camera \"side\", expected one of \"front\", \"top\" or an "
            "index below 2");
  options.camera = "1";
  EXPECT_EQ(numbers_of(read_gltf_text(file, options).scene.camera->parameters, "screenwindow"),
            (std::vector<double>{-2, 2, -1, 1}));
}

TEST(GltfLights, PunctualLightsKeepTheirUnits) {
  const std::string file =
      R"({"asset":{"version":"2.0"},"extensions":{"KHR_lights_punctual":{"lights":[)"
      R"({"type":"point","color":[1,0.5,0],"intensity":10},)"
      R"({"type":"spot","intensity":2,"spot":{"innerConeAngle":0.2,"outerConeAngle":0.5}},)"
      R"({"type":"directional","intensity":3}]}},"nodes":[)"
      R"({"extensions":{"KHR_lights_punctual":{"light":0}},"translation":[1,2,3],"scale":[9,9,9]},)"
      R"({"extensions":{"KHR_lights_punctual":{"light":1}}},)"
      R"({"extensions":{"KHR_lights_punctual":{"light":2}}}]})";
  const SceneDescription scene = read_gltf_text(file).scene;
  ASSERT_EQ(scene.lights.size(), 3u);
  EXPECT_EQ(scene.lights[0].type, "point");
  EXPECT_EQ(numbers_of(scene.lights[0].parameters, "I"), (std::vector<double>{10, 5, 0}));
  expect_near(moved(scene.lights[0].transform.start, {0, 0, 1}), {1, 2, 4});
  EXPECT_EQ(scene.lights[1].type, "spot");
  EXPECT_NEAR(number_of(scene.lights[1].parameters, "coneangle"), 28.6478897565, 1e-6);
  EXPECT_NEAR(number_of(scene.lights[1].parameters, "conedeltaangle"), 17.1887338539, 1e-6);
  EXPECT_EQ(numbers_of(scene.lights[1].parameters, "to"), (std::vector<double>{0, 0, -1}));
  EXPECT_EQ(scene.lights[2].type, "distant");
  EXPECT_EQ(numbers_of(scene.lights[2].parameters, "L"), (std::vector<double>{3, 3, 3}));
}

TEST(GltfLights, SpotsMayHaveASharpEdge) {
  const auto file = [](double inner, double outer) {
    return fmt::format(
        R"({{"asset":{{"version":"2.0"}},"extensions":{{"KHR_lights_punctual":{{"lights":[)"
        R"({{"type":"spot","spot":{{"innerConeAngle":{},"outerConeAngle":{}}}}}]}}}},"nodes":[)"
        R"({{"extensions":{{"KHR_lights_punctual":{{"light":0}}}}}}]}})",
        inner, outer);
  };
  const SceneDescription scene = read_gltf_text(file(0.5, 0.5)).scene;
  EXPECT_EQ(number_of(scene.lights.at(0).parameters, "conedeltaangle"), 0);
  EXPECT_NE(gltf_error(file(0.6, 0.5)), "");
  EXPECT_NE(gltf_error(file(0, 0)), "");
}

/// A file whose scene has an image-based light with these members.
std::string image_based(const std::string& members) {
  return R"({"asset":{"version":"2.0"},"images":[{"uri":"0.png"},{"uri":"1.png"},{"uri":"2.png"},)"
         R"({"uri":"3.png"},{"uri":"4.png"},{"uri":"5.png"}],"scenes":[{"extensions":)"
         R"({"EXT_lights_image_based":{"light":0}}}],"extensions":{"EXT_lights_image_based":)"
         R"({"lights":[{)" +
         members + "}]}}}";
}

TEST(GltfLights, ImageBasedLightsAreTheirSharpestCube) {
  // Turned by a quarter about y.
  const ReadScene read = read_gltf_text(image_based(
      R"("name":"sky","intensity":0.5,"rotation":[0,0.70710678118654752,0,0.70710678118654752],)"
      R"("specularImages":[[0,1,2,3,4,5],[5,5,5,5,5,5]])"));
  ASSERT_EQ(read.scene.lights.size(), 1u);
  const LightDescription& light = read.scene.lights[0];
  EXPECT_EQ(light.type, "infinite");
  const Parameter* faces = light.parameters.find("faces");
  ASSERT_TRUE(faces);
  EXPECT_EQ(faces->strings,
            (std::vector<std::string>{"0.png", "1.png", "2.png", "3.png", "4.png", "5.png"}));
  EXPECT_FALSE(light.mean_luminance);
  EXPECT_EQ(number_of(light.parameters, "scale"), 0.5);
  EXPECT_EQ(string_of(light.parameters, "name"), "sky");
  expect_near(moved(light.transform.start, {0, 0, 1}), {1, 0, 0});
  EXPECT_TRUE(read.warnings.empty());
  EXPECT_TRUE(read_gltf_text(image_based(R"("intensity":0)")).scene.lights.empty());
}

TEST(GltfLights, TheirIrradianceIsTheMeanLuminance) {
  // Surroundings of radiance 2 give the irradiance 2 pi, whose coefficient is over Y00.
  const double first = 2 * 3.14159265358979 / 0.28209479177387814;
  const auto luminance = [](const std::string& coefficients) {
    return read_gltf_text(image_based(R"("specularImages":[[0,1,2,3,4,5]],)"
                                      R"("irradianceCoefficients":)" +
                                      coefficients))
        .scene.lights.at(0)
        .mean_luminance;
  };
  EXPECT_NEAR(luminance(fmt::format("[[{0},{0},{0}],[1,2,3]]", first)).value(), 2, 1e-5);
  EXPECT_FALSE(luminance("[]"));
  EXPECT_FALSE(luminance("[[1]]"));
}

TEST(GltfLights, DamagedImageBasedLightsAreErrors) {
  const std::string at = "scene.gltf#/extensions/EXT_lights_image_based/lights/0";
  EXPECT_EQ(gltf_error(image_based("")), at + ": \"specularImages\" is missing");
  EXPECT_EQ(gltf_error(image_based(R"("specularImages":[])")),
            at + "/specularImages: this list is empty, expected the six faces of a cube");
  EXPECT_EQ(gltf_error(image_based(R"("specularImages":[[0,1,2]])")),
            at + "/specularImages: the cube has 3 faces, expected 6");
  EXPECT_NE(gltf_error(image_based(R"("specularImages":[[0,1,2,3,4,6]])")), "");
}

}  // namespace
}  // namespace nephroid::testing
