// Files of glTF: containers, data URIs, external buffers and the rule about folders.
#include <gtest/gtest.h>

#include <filesystem>

#include "unit/input/gltf_text.h"

namespace nephroid::testing {
namespace {

/// A file whose triangle is in buffer `uri`.
std::string with_external_buffer(const std::string& uri) {
  return R"({"asset":{"version":"2.0"},"buffers":[{"uri":")" + uri +
         R"(","byteLength":36}],"bufferViews":[{"buffer":0,"byteLength":36}],"accessors":[{)"
         R"("bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],"nodes":[{"mesh":0}],)"
         R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}]})";
}
const std::string& triangle_bytes() {
  static const std::string bytes = bytes_of_values(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0});
  return bytes;
}

TEST(GltfFile, BothContainersGiveTheSameScene) {
  const TriangleScene t;
  const ReadScene text = read_gltf_text(t.file.text(t.members()));
  const ReadScene binary = read_gltf_text(t.file.glb(t.members()), {}, "scene.GLB");
  ASSERT_EQ(text.scene.shapes.size(), 1u);
  ASSERT_EQ(binary.scene.shapes.size(), 1u);
  const std::vector<double> positions = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  EXPECT_EQ(numbers_of(text.scene.shapes[0].parameters, "P"), positions);
  EXPECT_EQ(numbers_of(binary.scene.shapes[0].parameters, "P"), positions);
  EXPECT_TRUE(text.warnings.empty());
}

TEST(GltfFile, ExternalBuffersCountInTheHash) {
  const TemporaryDirectory folder;
  folder.write("the buffer.bin", triangle_bytes());
  Diagnostics diagnostics;
  const std::string path = folder.write("s.gltf", with_external_buffer("the%20buffer.bin"));
  const SceneDescription scene = read_gltf(path, {}, diagnostics);
  ASSERT_EQ(scene.shapes.size(), 1u);
  EXPECT_EQ(scene.files->names(), std::vector<std::string>{"the buffer.bin"});
  std::string other = triangle_bytes();
  other[8] = 1;
  folder.write("the buffer.bin", other);
  EXPECT_NE(read_gltf(path, {}, diagnostics).files->hash(), scene.files->hash());
}

TEST(GltfFile, ImagesInsideBecomeFilesInMemory) {
  TriangleScene t;
  const size_t view = t.file.add_view("picture");
  t.primitive_members = R"(,"material":0)";
  const ReadScene read = read_gltf_text(
      t.file.glb(
          t.members(R"(,"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],)"
                    R"("textures":[{"source":0}],"images":[{"mimeType":"image/png","bufferView":)" +
                    std::to_string(view) + "}]")),
      {}, "scene.glb");
  ASSERT_EQ(read.scene.textures.size(), 1u);
  const std::string name = string_of(read.scene.textures[0].parameters, "filename");
  EXPECT_EQ(name, "scene.glb#/images/0");
  const FileSource source = read.scene.files->source_of(name);
  ASSERT_TRUE(source.bytes);
  EXPECT_EQ(*source.bytes, "picture");
  EXPECT_TRUE(read.scene.files->names().empty());
}

TEST(GltfFile, FilesOutsideOfTheFolderAreRefused) {
  const TemporaryDirectory outer;
  outer.write("secret.bin", triangle_bytes());
  std::filesystem::create_directory(outer.path("inner"));
  std::filesystem::create_symlink(outer.path("secret.bin"), outer.path("inner/link.bin"));
  const auto read = [&](const std::string& uri, bool allow_outside) {
    Diagnostics diagnostics;
    ImportOptions options;
    options.allow_outside = allow_outside;
    return read_gltf(outer.write("inner/s.gltf", with_external_buffer(uri)), options, diagnostics)
        .shapes.size();
  };
  for (const std::string& uri : {std::string("../secret.bin"), std::string("link.bin"),
                                 std::string("x/../../secret.bin"), outer.path("secret.bin")}) {
    SCOPED_TRACE(uri);
    EXPECT_THROW(read(uri, false), SceneError);
  }
  EXPECT_EQ(read("../secret.bin", true), 1u);
  EXPECT_EQ(read("link.bin", true), 1u);
  outer.write("inner/own.bin", triangle_bytes());
  EXPECT_EQ(read("./own.bin", false), 1u);
}

TEST(GltfFile, NothingIsFetched) {
  EXPECT_NE(
      gltf_error(with_external_buffer("https://example.org/a.bin"))
          .find("#/buffers/0/uri: \"https://example.org/a.bin\" is not in the scene's folder"),
      std::string::npos);
  EXPECT_NE(gltf_error(with_external_buffer("missing.bin")).find("scene.gltf#/buffers/0/uri: "),
            std::string::npos);
}

TEST(GltfFile, DamagedContainersAreErrors) {
  const TriangleScene t;
  const std::string whole = t.file.glb(t.members());
  const auto error = [](const std::string& bytes) { return gltf_error(bytes, {}, "s.glb"); };
  EXPECT_EQ(error(whole), "");
  for (const size_t length : {size_t{0}, size_t{6}, size_t{12}, size_t{19}, whole.size() - 1})
    EXPECT_NE(error(whole.substr(0, length)), "") << length;
  std::string version = whole;
  version[4] = 1;
  EXPECT_EQ(error(version), "s.glb: this GLB file has version 1, expected version 2");
  std::string chunk = whole;
  chunk[14] = 127;
  EXPECT_NE(error(chunk).find("a chunk of the GLB file claims"), std::string::npos);
}

TEST(GltfFile, SyntaxErrorsHaveTheirLine) {
  EXPECT_EQ(
      gltf_error("{\n  \"asset\": {},\n  oops\n}"),
      "scene.gltf:3:3: the text is not JSON from here on, expected the JSON text of a glTF file");
  EXPECT_EQ(gltf_error(""), "scene.gltf: the file is empty, expected a glTF scene");
  EXPECT_EQ(gltf_error("[]"),
            "scene.gltf:1:1: the JSON text is not an object, expected a glTF file");
  EXPECT_EQ(gltf_error("{}"), "scene.gltf: \"asset\" is missing");
  EXPECT_EQ(gltf_error(R"({"asset":{"version":"1.0"}})"),
            "scene.gltf#/asset/version: this is glTF 1.0, expected version 2.0");
  EXPECT_NE(gltf_error(std::string(100000, '[')).find("nested more than"), std::string::npos);
}

TEST(GltfFile, BracketsAreCountedWhereTheyAreOpenAndOutsideOfStrings) {
  const auto extras = [](const std::string& value) {
    return gltf_error(R"({"asset":{"version":"2.0"},"extras":)" + value + "}");
  };
  const auto nested = [](int levels) {
    return std::string(levels, '[') + std::string(levels, ']');
  };
  EXPECT_EQ(extras(nested(199)), "");
  EXPECT_EQ(extras(nested(200)),
            "scene.gltf: the JSON text is nested more than 200 levels deep, expected fewer");
  EXPECT_EQ(extras("[" + nested(198) + "," + nested(198) + "]"), "");
  EXPECT_EQ(extras("\"" + std::string(300, '[') + "\\\"" + std::string(300, '{') + "\""), "");
  // The string ends behind an escaped backslash, so what follows is open.
  EXPECT_NE(extras("[\"\\\\\"," + nested(199) + "]"), "");
}

TEST(GltfFile, ExtensionsThatAreRequiredMustBeKnown) {
  EXPECT_EQ(gltf_error(R"({"asset":{"version":"2.0"},"extensionsRequired":["ACME_magic"]})"),
            "scene.gltf#/extensionsRequired/0: the file requires the extension \"ACME_magic\", "
            "which is not supported");
  EXPECT_NE(
      gltf_error(R"({"asset":{"version":"2.0"},"extensionsRequired":["KHR_texture_basisu"]})"), "");
  const ReadScene used = read_gltf_text(
      R"({"asset":{"version":"2.0"},"extensionsUsed":["ACME_magic","KHR_materials_ior"]})");
  ASSERT_EQ(used.warnings.size(), 1u);
  EXPECT_EQ(used.warnings[0].message,
            "the extension \"ACME_magic\" is not supported, it is ignored");
}

}  // namespace
}  // namespace nephroid::testing
