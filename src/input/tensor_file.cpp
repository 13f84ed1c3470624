// Layout, all numbers little-endian: "tensor_file" and a zero byte, version 1 0, number of fields
// (32 bits). Then per field: length of its name (16), name, number of dimensions (16), type (8),
// offset of its data from the start of the file (64), extents (64 each).
#include "input/tensor_file.h"

#include <bit>
#include <cstring>
#include <utility>

#include "core/counted.h"
#include "input/file_bytes.h"

namespace nephroid {
namespace {

struct TensorTypeRow {
  const char* name;
  uint64_t bytes;
};

constexpr TensorTypeRow kTensorTypes[] = {
    {"nothing", 0}, {"uint8", 1},  {"int8", 1},  {"uint16", 2},  {"int16", 2},   {"uint32", 4},
    {"int32", 4},   {"uint64", 8}, {"int64", 8}, {"float16", 2}, {"float32", 4}, {"float64", 8}};

const TensorTypeRow& row_of(TensorType type) {
  return kTensorTypes[static_cast<size_t>(type)];
}

constexpr std::string_view kTensorMagic("tensor_file\0", 12);

/// The unsigned number with these bytes, least significant first.
uint64_t little_endian(std::string_view bytes) {
  uint64_t value = 0;
  for (size_t i = bytes.size(); i-- > 0;) value = value << 8 | static_cast<uint8_t>(bytes[i]);
  return value;
}

/// A file's name for something, made short and printable for messages.
std::string shown(std::string_view name) {
  std::string text(name.substr(0, 40));
  for (char& c : text)
    if (c < ' ' || c > '~') c = '?';
  return name.size() > 40 ? text + "..." : text;
}

/// Reads the bytes of the table of fields.
class TableReader {
 public:
  TableReader(const TensorFile& file, std::string_view bytes) : file_(file), rest_(bytes) {}

  size_t remaining() const { return rest_.size(); }
  std::string_view take(size_t count, const std::string& what) {
    if (count > rest_.size())
      file_.fail("the file ends inside " + what + ", " + counted(count - rest_.size(), "byte") +
                 in_number(count - rest_.size(), " is", " are") + " missing");
    const std::string_view taken = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return taken;
  }
  uint64_t number(size_t bytes, const std::string& what) {
    return little_endian(take(bytes, what));
  }

 private:
  const TensorFile& file_;
  std::string_view rest_;
};

/// Bytes that the field needs; more than `limit` is reported as limit + 1.
uint64_t needed_bytes(const TensorField& field, uint64_t limit) {
  uint64_t needed = row_of(field.type).bytes;
  bool too_many = false;
  for (const uint64_t extent : field.shape) {
    if (extent == 0) return 0;
    too_many = too_many || extent > limit / needed;
    if (!too_many) needed *= extent;
  }
  return too_many ? limit + 1 : needed;
}

TensorField read_field(const TensorFile& file, TableReader& table, std::string_view bytes,
                       const std::string& what) {
  TensorField field;
  const uint64_t dimensions = table.number(2, what);
  const uint64_t type = table.number(1, what);
  const uint64_t offset = table.number(8, what);
  if (type < 1 || type >= std::size(kTensorTypes))
    file.fail(what + " has the unknown type " + std::to_string(type) + ", expected 1 to " +
              std::to_string(std::size(kTensorTypes) - 1));
  field.type = static_cast<TensorType>(type);
  const std::string_view extents = table.take(dimensions * 8, what);
  for (size_t i = 0; i < extents.size(); i += 8)
    field.shape.push_back(little_endian(extents.substr(i, 8)));

  const uint64_t present = offset <= bytes.size() ? bytes.size() - offset : 0;
  const uint64_t needed = needed_bytes(field, bytes.size());
  if (needed > present)
    file.fail("the file is too short for " + what + ", " + field.to_string() + " at offset " +
              std::to_string(offset) + ": it has " + counted(bytes.size(), "byte"));
  if (needed > 0) field.bytes = bytes.substr(offset, needed);
  return field;
}

}  // namespace

std::string TensorField::to_string() const {
  std::string text = std::string(row_of(type).name) + " [";
  constexpr size_t kShown = 8;
  for (size_t i = 0; i < shape.size() && i < kShown; ++i)
    text += (i > 0 ? " x " : "") + std::to_string(shape[i]);
  return text + (shape.size() > kShown ? " x ...]" : "]");
}

TensorFile TensorFile::read(SceneFiles& files, const std::string& path,
                            const SourceLocation& wanted_by) {
  std::string bytes;
  try {
    bytes = files.read(path);
  } catch (const IoError& error) {
    file_is_unreadable(wanted_by, error.what());
  }
  return TensorFile(std::move(bytes), path, wanted_by);
}

TensorFile::TensorFile(std::string bytes, std::string name, SourceLocation wanted_by)
    : bytes_(std::move(bytes)), name_(std::move(name)), wanted_by_(std::move(wanted_by)) {
  const std::string_view all = bytes_;
  if (all.substr(0, kTensorMagic.size()) != kTensorMagic)
    fail("it does not start with \"tensor_file\", expected a tensor file");
  TableReader table(*this, all.substr(kTensorMagic.size()));
  const std::string_view version = table.take(2, "the version");
  if (version[0] != 1 || version[1] != 0)
    fail("it has version " + std::to_string(static_cast<uint8_t>(version[0])) + "." +
         std::to_string(static_cast<uint8_t>(version[1])) + ", expected 1.0");
  const uint64_t count = table.number(4, "the number of fields");
  for (uint64_t i = 0; i < count; ++i) {
    const std::string nth =
        "field " + std::to_string(i + 1) + " of " + std::to_string(count) + " in the table";
    const uint64_t length = table.number(2, nth);
    const std::string field_name(table.take(length, nth));
    TensorField field = read_field(*this, table, all, "field \"" + shown(field_name) + "\"");
    if (!fields_.emplace(field_name, std::move(field)).second)
      fail("field \"" + shown(field_name) + "\" is in the file twice, expected once");
  }
}

const TensorField* TensorFile::find(const std::string& name) const {
  const auto found = fields_.find(name);
  return found == fields_.end() ? nullptr : &found->second;
}

const TensorField& TensorFile::require(const std::string& name, TensorType type,
                                       size_t dimensions) const {
  const TensorField* const field = find(name);
  const std::string expected =
      std::string(row_of(type).name) + " with " + counted(dimensions, "dimension");
  if (!field) fail("it has no field \"" + name + "\", expected " + expected);
  if (field->type != type || field->shape.size() != dimensions)
    fail("field \"" + name + "\" is " + field->to_string() + ", expected " + expected);
  return *field;
}

std::vector<float> TensorFile::floats(const TensorField& field) {
  std::vector<float> values(field.bytes.size() / sizeof(float));
  if constexpr (std::endian::native == std::endian::little) {
    if (!values.empty())
      std::memcpy(values.data(), field.bytes.data(), values.size() * sizeof(float));
  } else {
    for (size_t i = 0; i < values.size(); ++i)
      values[i] =
          std::bit_cast<float>(static_cast<uint32_t>(little_endian(field.bytes.substr(i * 4, 4))));
  }
  return values;
}

void TensorFile::fail(const std::string& message) const {
  throw SceneError(wanted_by_, "cannot use \"" + name_ + "\": " + message);
}

}  // namespace nephroid
