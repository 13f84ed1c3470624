// Accessors of glTF: component types, normalised integers, strides, sparse values, and their
// limits.
#include <gtest/gtest.h>

#include "input/gltf/accessor.h"
#include "unit/input/gltf_text.h"

namespace nephroid::gltf {
namespace {

using testing::GltfText;

/// Reads accessor 0 of a file.
class AccessorFile {
 public:
  explicit AccessorFile(const GltfText& file)
      : path_(folder_.write("a.gltf", file.text(""))),
        files_(folder_.path()),
        document_(path_, files_, options_, diagnostics_) {}
  NumberArray numbers() { return read_accessor(document_, 0, document_.root()); }
  std::vector<uint32_t> integers() { return read_integers(document_, 0, document_.root()); }
  std::string error() {
    try {
      numbers();
    } catch (const SceneError& e) {
      return std::string(e.what()).substr(path_.size());
    }
    return "";
  }

 private:
  testing::TemporaryDirectory folder_;
  std::string path_;
  SceneFiles files_;
  ImportOptions options_;
  Diagnostics diagnostics_;
  Document document_;
};

template <class T>
std::vector<float> read(const std::vector<T>& values, int component, const std::string& members) {
  GltfText file;
  file.add_accessor(values, "SCALAR", component, 1, members);
  return AccessorFile(file).numbers().values;
}

TEST(GltfAccessor, ReadsAllComponentTypes) {
  const std::vector<float> expected = {0, 3, 7};
  EXPECT_EQ(read<int8_t>({0, 3, 7}, 5120, ""), expected);
  EXPECT_EQ(read<uint8_t>({0, 3, 7}, 5121, ""), expected);
  EXPECT_EQ(read<int16_t>({0, 3, 7}, 5122, ""), expected);
  EXPECT_EQ(read<uint16_t>({0, 3, 7}, 5123, ""), expected);
  EXPECT_EQ(read<uint32_t>({0, 3, 7}, 5125, ""), expected);
  EXPECT_EQ(read<float>({0, 3, 7}, 5126, ""), expected);
  EXPECT_EQ(read<int8_t>({-128, 5}, 5120, "")[0], -128.0f);
}

TEST(GltfAccessor, NormalisesIntegers) {
  const std::string normalised = R"(,"normalized":true)";
  EXPECT_EQ(read<uint8_t>({0, 255}, 5121, normalised), (std::vector<float>{0, 1}));
  EXPECT_EQ(read<uint16_t>({0, 65535}, 5123, normalised), (std::vector<float>{0, 1}));
  // The most negative integer is -1, too.
  EXPECT_EQ(read<int8_t>({-128, -127, 0, 127}, 5120, normalised),
            (std::vector<float>{-1, -1, 0, 1}));
  EXPECT_EQ(read<int16_t>({-32768, 32767}, 5122, normalised), (std::vector<float>{-1, 1}));
}

TEST(GltfAccessor, ObeysStridesAndOffsets) {
  GltfText file;
  const std::vector<float> numbers = {9, 1, 2, 9, 3, 4, 9};
  const size_t view = file.add_view(testing::bytes_of_values(numbers), R"(,"byteStride":12)");
  file.add_raw_accessor(fmt::format(
      R"("bufferView":{},"byteOffset":4,"componentType":5126,"count":2,"type":"VEC2")", view));
  const NumberArray array = AccessorFile(file).numbers();
  EXPECT_EQ(array.count, 2u);
  EXPECT_EQ(array.values, (std::vector<float>{1, 2, 3, 4}));
}

TEST(GltfAccessor, ColumnsOfMatricesStartAtWords) {
  GltfText file;
  file.add_view(testing::bytes_of_values(std::vector<uint8_t>{1, 2, 0, 0, 3, 4, 0, 0}));
  file.add_raw_accessor(R"("bufferView":0,"componentType":5121,"count":1,"type":"MAT2")");
  EXPECT_EQ(AccessorFile(file).numbers().values, (std::vector<float>{1, 2, 3, 4}));
}

TEST(GltfAccessor, SparseValuesReplaceOthers) {
  const std::string sparse =
      R"("componentType":5126,"count":4,"type":"SCALAR","sparse":{"count":2,)"
      R"("indices":{"bufferView":0,"componentType":5121},"values":{"bufferView":1}})";
  GltfText file;
  file.add_view(testing::bytes_of_values(std::vector<uint8_t>{1, 3}));
  file.add_view(testing::bytes_of_values(std::vector<float>{7, 8}));
  GltfText zeros = file;
  zeros.add_raw_accessor(sparse);
  EXPECT_EQ(AccessorFile(zeros).numbers().values, (std::vector<float>{0, 7, 0, 8}));
  file.add_view(testing::bytes_of_values(std::vector<float>{1, 2, 3, 4}));
  file.add_raw_accessor(R"("bufferView":2,)" + sparse);
  EXPECT_EQ(AccessorFile(file).numbers().values, (std::vector<float>{1, 7, 3, 8}));
}

TEST(GltfAccessor, IntegersAreExact) {
  GltfText file;
  file.add_accessor<uint32_t>({16777217, 4294967295u}, "SCALAR", 5125, 1);
  EXPECT_EQ(AccessorFile(file).integers(), (std::vector<uint32_t>{16777217, 4294967295u}));
}

/// The error for an accessor of these members over 16 bytes.
std::string accessor_error(const std::string& members) {
  GltfText file;
  file.add_view(testing::bytes_of_values(std::vector<float>{1, 2, 3, 4}));
  file.add_raw_accessor(members);
  return AccessorFile(file).error();
}

TEST(GltfAccessor, RefusesWhatReachesBeyondItsView) {
  const std::string floats = R"("bufferView":0,"componentType":5126,"type":"SCALAR",)";
  EXPECT_EQ(accessor_error(floats + R"("count":4)"), "");
  EXPECT_EQ(accessor_error(floats + R"("count":5)"),
            "#/accessors/0: 5 elements reach beyond the buffer view, which has 16 bytes");
  EXPECT_NE(accessor_error(floats + R"("count":9000000000000000)"), "");
  EXPECT_NE(accessor_error(floats + R"("count":1,"byteOffset":13)"), "");
  EXPECT_NE(accessor_error(floats + R"("count":1,"byteOffset":9000000000000000)"), "");
  EXPECT_NE(accessor_error(floats + R"("count":-1)"), "");
  EXPECT_NE(accessor_error(R"("componentType":5126,"type":"SCALAR","count":100000000)"), "");
}

TEST(GltfAccessor, PackedBytesHoldSoManyElements) {
  const auto is_lie = [](const std::string& mode, size_t count) {
    GltfText file;
    file.add_view(std::string(100, '\0'),
                  fmt::format(R"(,"extensions":{{"EXT_meshopt_compression":{{"buffer":0,)"
                              R"("byteLength":100,"byteStride":4,"count":{},"mode":"{}"}}}})",
                              count, mode));
    file.add_raw_accessor(R"("bufferView":0,"componentType":5125,"type":"SCALAR","count":1)");
    const std::string error = AccessorFile(file).error();
    EXPECT_NE(error, "");
    return error.find("claims more elements") != std::string::npos;
  };
  EXPECT_FALSE(is_lie("ATTRIBUTES", 1600));
  EXPECT_TRUE(is_lie("ATTRIBUTES", 1601));
  EXPECT_FALSE(is_lie("TRIANGLES", 300));
  EXPECT_TRUE(is_lie("TRIANGLES", 303));
  EXPECT_FALSE(is_lie("INDICES", 100));
  EXPECT_TRUE(is_lie("INDICES", 101));
}

TEST(GltfAccessor, RefusesUnknownTypes) {
  EXPECT_EQ(accessor_error(R"("bufferView":0,"componentType":5124,"type":"SCALAR","count":1)"),
            "#/accessors/0/componentType: unknown component type 5124, expected 5120 to 5123, 5125 "
            "or 5126");
  EXPECT_EQ(accessor_error(R"("bufferView":0,"componentType":5126,"type":"VEC5","count":1)"),
            "#/accessors/0/type: unknown type \"VEC5\", expected SCALAR, VEC2 to VEC4 or MAT2 to "
            "MAT4");
  EXPECT_EQ(
      accessor_error(R"("bufferView":7,"componentType":5126,"type":"VEC3","count":1)"),
      "#/accessors/0: index 7 into \"bufferViews\" is out of range, expected an index below 1");
}

TEST(GltfAccessor, RefusesNumbersThatAreNotFinite) {
  GltfText file;
  file.floats({1, std::nanf(""), 3}, "SCALAR", 1);
  EXPECT_EQ(AccessorFile(file).error(),
            "#/accessors/0: element 1 is not finite, expected finite numbers");
}

TEST(GltfAccessor, RefusesSparseIndicesOutOfRange) {
  GltfText file;
  file.add_view(testing::bytes_of_values(std::vector<uint8_t>{4, 0}));
  file.add_view(testing::bytes_of_values(std::vector<float>{7}));
  file.add_raw_accessor(
      R"("componentType":5126,"count":4,"type":"SCALAR","sparse":{"count":1,)"
      R"("indices":{"bufferView":0,"componentType":5121},"values":{"bufferView":1}})");
  EXPECT_EQ(AccessorFile(file).error(),
            "#/accessors/0/sparse/indices: index 4 is out of range, the accessor has 4 elements");
}

}  // namespace
}  // namespace nephroid::gltf
