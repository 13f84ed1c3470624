// Tensor files: reading, and robustness against damaged files.
#include "input/tensor_file.h"

#include <gtest/gtest.h>

#include <bit>

#include "unit/input/gzip_bytes.h"
#include "unit/input/parse_text.h"
#include "unit/input/temporary_directory.h"

namespace nephroid {
namespace {

using testing::error_of;

void append(std::string& to, uint64_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) to += static_cast<char>(value >> (8 * i) & 0xFF);
}

/// A file with this field table and these bytes after it.
std::string file_with(uint32_t fields, const std::string& rest) {
  std::string bytes("tensor_file\0\1\0", 14);
  append(bytes, fields, 4);
  return bytes + rest;
}

std::string field(const std::string& name, int type, uint64_t offset,
                  const std::vector<uint64_t>& shape) {
  std::string bytes;
  append(bytes, name.size(), 2);
  bytes += name;
  append(bytes, shape.size(), 2);
  append(bytes, static_cast<uint64_t>(type), 1);
  append(bytes, offset, 8);
  for (const uint64_t extent : shape) append(bytes, extent, 8);
  return bytes;
}

/// A matrix of floats, then a text.
std::string two_fields() {
  std::string table = field("m", 10, 0, {2, 3}) + field("text", 1, 0, {5});
  const uint64_t start = 18 + table.size();
  table = field("m", 10, start, {2, 3}) + field("text", 1, start + 24, {5});
  std::string data;
  for (const float v : {1.0f, 2.5f, -3.0f, 0.0f, 1e-3f, 7.0f})
    append(data, std::bit_cast<uint32_t>(v), 4);
  return file_with(2, table + data + "hello");
}

std::string message_for(const std::string& bytes) {
  const std::string message = error_of([&] { TensorFile(bytes, "f.bsdf", {}); });
  const std::string start = "cannot use \"f.bsdf\": ";
  return message.rfind(start, 0) == 0 ? message.substr(start.size()) : message;
}

TEST(TensorFile, FieldsHaveTypeShapeAndNumbers) {
  const TensorFile file(two_fields(), "f.bsdf", {});
  const TensorField& m = file.require("m", TensorType::kFloat32, 2);
  EXPECT_EQ(m.to_string(), "float32 [2 x 3]");
  EXPECT_EQ(TensorFile::floats(m), (std::vector<float>{1.0f, 2.5f, -3.0f, 0.0f, 1e-3f, 7.0f}));
  ASSERT_NE(file.find("text"), nullptr);
  EXPECT_EQ(file.find("text")->bytes, "hello");
  EXPECT_EQ(file.find("absent"), nullptr);
  EXPECT_NE(error_of([&] {
              file.require("absent", TensorType::kUint8, 1);
            }).find("has no field \"absent\", expected uint8 with 1 dimension"),
            std::string::npos);
  EXPECT_NE(error_of([&] {
              file.require("m", TensorType::kFloat32, 3);
            }).find("field \"m\" is float32 [2 x 3], expected float32 with 3 dimensions"),
            std::string::npos);
  EXPECT_NE(error_of([&] { file.require("text", TensorType::kFloat64, 1); }).find("is uint8 [5]"),
            std::string::npos);
}

TEST(TensorFile, FilesAreReadAndUnpackedAndNamed) {
  SceneFiles files;
  const testing::TemporaryDirectory directory;
  for (const std::string& path : {directory.write("a.bsdf", two_fields()),
                                  directory.write("a.bsdf.gz", testing::gzip(two_fields()))})
    EXPECT_EQ(TensorFile::read(files, path, {}).find("text")->bytes, "hello");
  const SourceLocation wanted{std::make_shared<const std::string>("s.pbrt"), 4, 7};
  const std::string absent = directory.path("absent.bsdf");
  EXPECT_EQ(error_of([&] { TensorFile::read(files, absent, wanted); }),
            "s.pbrt:4:7: cannot read \"" + absent + "\": No such file or directory");
  EXPECT_THROW(TensorFile::read(files, absent, {}), IoError);
  const std::string bad = directory.write("bad.bsdf", "nonsense");
  EXPECT_EQ(error_of([&] { TensorFile::read(files, bad, wanted); }),
            "s.pbrt:4:7: cannot use \"" + bad +
                "\": it does not start with \"tensor_file\", expected a tensor file");
}

TEST(TensorFile, WrongTablesAreRefused) {
  EXPECT_EQ(message_for(std::string("tensor_file\0\2\0\0\0\0\0", 18)),
            "it has version 2.0, expected 1.0");
  EXPECT_EQ(message_for(file_with(1, field("a", 12, 18, {1}))),
            "field \"a\" has the unknown type 12, expected 1 to 11");
  EXPECT_EQ(message_for(file_with(1, field("a", 0, 18, {1}))),
            "field \"a\" has the unknown type 0, expected 1 to 11");
  EXPECT_EQ(message_for(file_with(2, field("a", 1, 18, {1}) + field("a", 1, 18, {1}))),
            "field \"a\" is in the file twice, expected once");
  EXPECT_EQ(message_for(file_with(4000000000u, field("a", 1, 18, {1}))),
            "the file ends inside field 2 of 4000000000 in the table, 2 bytes are missing");
}

TEST(TensorFile, ClaimsBeyondTheFileAreRefused) {
  const uint64_t huge = uint64_t{1} << 63;
  EXPECT_EQ(message_for(file_with(1, field("a", 10, 0, {16}))),
            "the file is too short for field \"a\", float32 [16] at offset 0: it has 40 bytes");
  for (const std::vector<uint64_t>& shape : {std::vector<uint64_t>{huge},
                                             {huge, 2},
                                             {1u << 31, 1u << 31, 4},
                                             {huge, huge, huge},
                                             {~uint64_t{0}, 1}})
    EXPECT_NE(message_for(file_with(1, field("a", 10, 0, shape))).find("the file is too short for"),
              std::string::npos);
  for (const uint64_t offset : {uint64_t{40}, uint64_t{1} << 40, ~uint64_t{0}})
    EXPECT_NE(message_for(file_with(1, field("a", 1, offset, {1}))).find("at offset"),
              std::string::npos);
  // An extent of zero makes a field empty, at any offset and with any other extents.
  const TensorFile empty(file_with(1, field("a", 10, ~uint64_t{0}, {huge, 0, huge})), "f", {});
  EXPECT_TRUE(TensorFile::floats(*empty.find("a")).empty());
}

TEST(TensorFile, EveryTruncationIsRefused) {
  const std::string whole = two_fields();
  for (size_t size = 0; size < whole.size(); ++size) {
    const std::string message = message_for(whole.substr(0, size));
    EXPECT_NE(message, "no error") << size;
  }
}

TEST(TensorFile, FlippedBitsAreHarmless) {
  const std::string whole = two_fields();
  int refused = 0;
  for (size_t bit = 0; bit < whole.size() * 8; ++bit) {
    std::string bytes = whole;
    bytes[bit / 8] = static_cast<char>(bytes[bit / 8] ^ (1 << bit % 8));
    try {
      const TensorFile file(bytes, "f.bsdf", {});
      for (const char* name : {"m", "text"})
        if (const TensorField* f = file.find(name)) {
          EXPECT_LE(f->bytes.size(), whole.size());
          EXPECT_LE(TensorFile::floats(*f).size() * 4, whole.size());
        }
    } catch (const SceneError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 300);
}

}  // namespace
}  // namespace nephroid
