// Layout ("OpenEXR File Layout", openexr.com): magic number, version and flags. Then each part has
// attributes (name, type, size and value) up to an empty name. Several parts end with an empty one.
#include "input/exr_header.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string_view>
#include <system_error>

namespace nephroid {
namespace {

constexpr uint32_t kExrMagic = 20000630;
constexpr uint32_t kManyParts = 0x1000;
constexpr size_t kLongestName = 255;
/// No real picture is compressed so well; small ones are always accepted.
constexpr uint64_t kMaxPixelsPerByte = 1 << 16, kFewPixels = 1 << 24;
constexpr int64_t kWidest = 1 << 16;
/// The same for the tiles or blocks of rows that the library allocates before it reads the first.
constexpr uint64_t kMaxBufferBytesPerByte = 512, kFewBufferBytes = 1 << 30;
constexpr uint64_t kBytesPerChunkOffset = 8;
constexpr uint32_t kHalf = 1;  // channel type; the other types have four bytes
/// [compression]: none, RLE, ZIPS, ZIP, PIZ, PXR24, B44, B44A, DWAA, DWAB.
constexpr std::array<uint64_t, 10> kRowsInBlock = {1, 1, 1, 16, 32, 16, 32, 32, 32, 256};
constexpr uint64_t kMaxRowsInBlock = 256;

constexpr int kChannelBytesAfterType = 12;
struct FixedSize {
  std::string_view type;
  uint32_t bytes;
};
constexpr FixedSize kFixedSizes[] = {{"box2i", 16},      {"box2f", 16},   {"chromaticities", 32},
                                     {"compression", 1}, {"double", 8},   {"envmap", 1},
                                     {"float", 4},       {"int", 4},      {"keycode", 28},
                                     {"lineOrder", 1},   {"m33f", 36},    {"m33d", 72},
                                     {"m44f", 64},       {"m44d", 128},   {"rational", 8},
                                     {"tiledesc", 9},    {"timecode", 8}, {"v2i", 8},
                                     {"v2f", 8},         {"v2d", 16},     {"v3i", 12},
                                     {"v3f", 12},        {"v3d", 24},     {"deepImageState", 1}};

class Header {
 public:
  Header(const std::string& path, uint64_t size, int threads)
      : file_(path, std::ios::binary),
        size_(size),
        buffers_(threads > 0 ? 2 * static_cast<uint64_t>(threads) : 1) {}

  std::string fault() {
    if (number() != kExrMagic || !file_) return "";
    const bool many = (number() & kManyParts) != 0;
    for (;;) {
      size_t attributes = 0;
      part_ = {};
      for (;; ++attributes) {
        const std::optional<std::string> name = text();
        if (!name) return "its header ends too early";
        if (name->empty()) break;
        const std::optional<std::string> type = text();
        const uint32_t bytes = number();
        if (!type || !file_ || bytes > size_ - position()) return "its header ends too early";
        const uint64_t end = position() + bytes;
        if (!has_possible_size(*type, bytes, end)) return "its header is damaged";
        file_.seekg(static_cast<std::streamoff>(end - bytes));
        if (*name == "dataWindow" && *type == "box2i" && !is_possible_window())
          return "its header claims more pixels than the file can hold";
        if (*name == "type" && *type == "string" && is_deep(bytes)) return "it is a deep image";
        if (*name == "compression" && *type == "compression") part_.rows_in_block = rows_in_block();
        if (*name == "tiles" && *type == "tiledesc") part_.tile = Extent{number(), number()};
        file_.seekg(static_cast<std::streamoff>(end));
      }
      if (!has_possible_chunks()) return "its header claims larger blocks than the file can hold";
      if (!many || attributes == 0) return "";
    }
  }

 private:
  uint64_t position() { return file_.tellg(); }
  uint32_t number() {
    std::array<char, 4> bytes{};
    file_.read(bytes.data(), bytes.size());
    uint32_t value;
    std::memcpy(&value, bytes.data(), sizeof value);
    return value;
  }
  /// The text up to a zero byte; empty if there is none within kLongestName bytes.
  std::optional<std::string> text() {
    std::string result;
    for (char c; file_.get(c);) {
      if (c == '\0') return result;
      if (result.size() == kLongestName) break;
      result += c;
    }
    return std::nullopt;
  }
  /// Checks sizes by type: the library reads values by their type and ignores the size.
  bool has_possible_size(const std::string& type, uint32_t bytes, uint64_t end) {
    if (type == "chlist") {
      for (;;) {
        const std::optional<std::string> channel = text();
        if (!channel || position() > end) return false;
        if (channel->empty()) return position() == end;
        part_.pixel_bytes += number() == kHalf ? 2 : 4;
        file_.seekg(kChannelBytesAfterType, std::ios::cur);
      }
    }
    if (type == "preview") {
      const uint64_t width = number(), height = number();
      return bytes == 8 + 4 * width * height;
    }
    const auto fixed = std::ranges::find(kFixedSizes, type, &FixedSize::type);
    return fixed == std::end(kFixedSizes) || fixed->bytes == bytes;
  }
  bool is_possible_window() {
    std::array<int64_t, 4> corners;  // x0, y0, x1, y1
    for (int64_t& c : corners) c = static_cast<int32_t>(number());
    const int64_t width = std::max<int64_t>(0, corners[2] - corners[0] + 1);
    const int64_t height = std::max<int64_t>(0, corners[3] - corners[1] + 1);
    const uint64_t pixels = static_cast<uint64_t>(width) * height;
    part_.window = {static_cast<uint64_t>(width), static_cast<uint64_t>(height)};
    // The library keeps blocks of whole rows.
    if (width > kWidest && static_cast<uint64_t>(width) > size_) return false;
    return pixels <= kFewPixels || pixels / kMaxPixelsPerByte <= size_;
  }

  /// True for a deep image: the library would allocate as many samples as the file claims.
  bool is_deep(uint32_t bytes) {
    std::string type(std::min<uint32_t>(bytes, 4), '\0');
    file_.read(type.data(), static_cast<std::streamsize>(type.size()));
    return type == "deep";
  }

  uint64_t rows_in_block() {
    const size_t compression = file_.get();
    return compression < kRowsInBlock.size() ? kRowsInBlock[compression] : kMaxRowsInBlock;
  }

  /// Checks the tiles or blocks of rows that the library holds at once, with all channels. Also the
  /// number of tiles, each of which has an offset in the file.
  bool has_possible_chunks() const {
    const auto is_possible = [&](const Extent& chunk) {
      const double bytes = static_cast<double>(chunk.width) * static_cast<double>(chunk.height) *
                           static_cast<double>(buffers_ * part_.pixel_bytes);
      return bytes <=
             static_cast<double>(std::max(kFewBufferBytes, size_ * kMaxBufferBytesPerByte));
    };
    // A part may have a tile size without tiles.
    if (!is_possible({part_.window.width, std::min(part_.window.height, part_.rows_in_block)}))
      return false;
    if (!part_.tile) return true;
    const Extent& tile = *part_.tile;
    if (!is_possible(tile)) return false;
    // The library refuses empty tiles.
    if (tile.width == 0 || tile.height == 0) return true;
    const auto count = [](uint64_t all, uint64_t each) { return (all + each - 1) / each; };
    return count(part_.window.width, tile.width) * count(part_.window.height, tile.height) <=
           size_ / kBytesPerChunkOffset;
  }

  struct Extent {
    uint64_t width = 0, height = 0;
  };
  struct Part {
    Extent window;
    std::optional<Extent> tile;
    uint64_t pixel_bytes = 0;
    uint64_t rows_in_block = kMaxRowsInBlock;
  };
  std::ifstream file_;
  uint64_t size_, buffers_;
  Part part_;
};

}  // namespace

std::string fault_of_exr_header(const std::string& path, int threads) {
  std::error_code error;
  const uint64_t size = std::filesystem::file_size(path, error);
  if (error) return "";
  return Header(path, size, threads).fault();
}

}  // namespace nephroid
