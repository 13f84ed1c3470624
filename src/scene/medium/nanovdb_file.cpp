// The container of .nvdb files; see nanovdb_file.h.
#include "scene/medium/nanovdb_file.h"

#include <zlib.h>

#include <cstdint>
#include <cstring>

namespace nephroid {

namespace {

constexpr uint64_t kMagic = 0x304244566f6e614e;  // "NanoVDB0", little endian
constexpr uint32_t kMajorVersion = 32;
constexpr size_t kHeaderBytes = 16, kGridHeaderBytes = 176;
/// Bound of the unpacked bytes per packed byte: the limit of deflate is 1032.
constexpr uint64_t kMaxUnpackedPerByte = 1100;

enum class Codec : uint16_t { kNone = 0, kZip = 1 };

/// Reads the bytes of a file from front to back.
class Reader {
 public:
  Reader(const std::string& file, const std::string& path, const SourceLocation& where)
      : file_(file), path_(path), where_(where) {}

  [[noreturn]] void fail(const std::string& what) const {
    throw SceneError(where_, "NanoVDB file \"" + path_ + "\" " + what);
  }
  bool at_end() const { return position_ == file_.size(); }
  const char* take(uint64_t count) {
    if (count > file_.size() - position_) fail("ends too early");
    const char* p = file_.data() + position_;
    position_ += count;
    return p;
  }

 private:
  const std::string& file_;
  const std::string& path_;
  const SourceLocation& where_;
  size_t position_ = 0;
};

template <class T>
T number_at(const char* p) {
  T value;
  std::memcpy(&value, p, sizeof value);
  return value;
}

/// Header fields of one grid.
struct GridEntry {
  uint64_t grid_bytes, file_bytes;
  std::string name;
};

GridEntry read_grid_entry(Reader& reader) {
  const char* p = reader.take(kGridHeaderBytes);
  GridEntry entry{number_at<uint64_t>(p), number_at<uint64_t>(p + 8), {}};
  const uint32_t name_bytes = number_at<uint32_t>(p + 136);
  const char* name = reader.take(name_bytes);
  entry.name.assign(name, strnlen(name, name_bytes));
  return entry;
}

NanoVdbBytes unpack(Reader& reader, const GridEntry& entry, Codec codec) {
  const char* data = reader.take(entry.file_bytes);
  uint64_t packed = entry.file_bytes;
  if (codec == Codec::kZip) {
    // The packed data start with their byte count.
    if (packed < 8 || number_at<uint64_t>(data) > packed - 8)
      reader.fail("is broken: the size of its compressed data is wrong");
    packed = number_at<uint64_t>(data);
    data += 8;
  }
  const bool fits = codec == Codec::kNone ? entry.grid_bytes == packed
                                          : entry.grid_bytes / kMaxUnpackedPerByte <= packed;
  if (!fits) reader.fail("is broken: the sizes of grid \"" + entry.name + "\" do not agree");
  if (entry.grid_bytes % sizeof(NanoVdbBlock) != 0)
    reader.fail("is broken: grid \"" + entry.name + "\" ends within a block of 32 bytes");
  NanoVdbBytes bytes(entry.grid_bytes / sizeof(NanoVdbBlock));
  if (codec == Codec::kNone) {
    std::memcpy(bytes.data(), data, packed);
    return bytes;
  }
  uLongf unpacked = entry.grid_bytes;
  const int status = uncompress(reinterpret_cast<Bytef*>(bytes.data()), &unpacked,
                                reinterpret_cast<const Bytef*>(data), packed);
  if (status != Z_OK || unpacked != entry.grid_bytes)
    reader.fail("is broken: grid \"" + entry.name + "\" cannot be unpacked");
  return bytes;
}

}  // namespace

std::optional<NanoVdbBytes> read_nanovdb_grid(const std::string& file, const std::string& name,
                                              const std::string& path,
                                              const SourceLocation& where) {
  Reader reader(file, path, where);
  if (reader.at_end()) reader.fail("is empty");
  while (!reader.at_end()) {
    const char* header = reader.take(kHeaderBytes);
    if (number_at<uint64_t>(header) != kMagic)
      reader.fail("does not begin with the magic number of NanoVDB, expected a .nvdb file");
    const uint32_t major = number_at<uint32_t>(header + 8) >> 21;
    if (major != kMajorVersion)
      reader.fail("has version " + std::to_string(major) + " of the format, expected " +
                  std::to_string(kMajorVersion));
    const uint16_t grids = number_at<uint16_t>(header + 12);
    const Codec codec{number_at<uint16_t>(header + 14)};
    std::vector<GridEntry> entries;
    for (int i = 0; i < grids; ++i) entries.push_back(read_grid_entry(reader));
    for (const GridEntry& entry : entries) {
      if (entry.name != name) {
        reader.take(entry.file_bytes);
        continue;
      }
      if (codec != Codec::kNone && codec != Codec::kZip)
        reader.fail("is packed with BLOSC, expected ZIP or no compression");
      return unpack(reader, entry, codec);
    }
  }
  return std::nullopt;
}

}  // namespace nephroid
