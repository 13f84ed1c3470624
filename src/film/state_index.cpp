// Numbers are little-endian, as in memory; texts are preceded by their length.
#include "film/state_index.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "core/errors.h"

namespace nephroid {
namespace {

static_assert(std::endian::native == std::endian::little);

/// Unpacked size of a block: it fits the cache and is large enough for a thread.
constexpr size_t kBlockBytes = 256 << 10;
/// Largest item of a section.
constexpr uint32_t kMaxWords = 4096;

class Writer {
 public:
  template <class T>
  void number(T value) {
    const auto bytes = std::as_bytes(std::span(&value, 1));
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  }
  void text(const std::string& value) {
    number(static_cast<uint32_t>(value.size()));
    const auto bytes = std::as_bytes(std::span(value));
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  }
  std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  std::vector<std::byte> bytes_;
};

class Reader {
 public:
  explicit Reader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  template <class T>
  T number() {
    T value;
    std::memcpy(&value, take(sizeof(T)).data(), sizeof(T));
    return value;
  }
  std::string text() {
    const auto bytes = take(number<uint32_t>());
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
  }
  /// A count of items, each of which takes at least `least` of the remaining bytes.
  size_t count(size_t least) {
    const size_t count = number<uint32_t>();
    if (count > bytes_.size() / least) damaged();
    return count;
  }
  bool at_end() const { return bytes_.empty(); }
  [[noreturn]] static void damaged() { throw IoError("its index is damaged"); }

 private:
  std::span<const std::byte> take(size_t size) {
    if (size > bytes_.size()) damaged();
    const auto taken = bytes_.first(size);
    bytes_ = bytes_.subspan(size);
    return taken;
  }
  std::span<const std::byte> bytes_;
};

}  // namespace

size_t StateIndex::Section::block_bytes() const {
  return std::max<size_t>(1, kBlockBytes / stride()) * stride();
}

size_t StateIndex::Section::block_count() const {
  return (bytes + block_bytes() - 1) / block_bytes();
}

std::vector<std::byte> StateIndex::to_bytes() const {
  Writer out;
  for (const int n : {resolution.x, resolution.y, window.x0, window.y0, window.x1, window.y1})
    out.number(static_cast<int32_t>(n));
  out.number(static_cast<uint32_t>(metadata.size()));
  for (const auto& [key, value] : metadata) {
    out.text(key);
    out.text(value);
  }
  out.number(static_cast<uint32_t>(sections.size()));
  for (const Section& section : sections) {
    out.text(section.name);
    out.number(section.words);
    out.number(section.bytes);
    out.number(section.hash);
    out.number(section.offset);
    out.number(static_cast<uint32_t>(section.blocks.size()));
    for (const uint32_t size : section.blocks) out.number(size);
  }
  return out.take();
}

StateIndex StateIndex::from_bytes(std::span<const std::byte> bytes, uint64_t file_bytes) {
  Reader in(bytes);
  StateIndex index;
  index.resolution.x = in.number<int32_t>();
  index.resolution.y = in.number<int32_t>();
  for (int* n : {&index.window.x0, &index.window.y0, &index.window.x1, &index.window.y1})
    *n = in.number<int32_t>();
  const auto& [x0, y0, x1, y1] = index.window;
  if (!(0 <= x0 && x0 < x1 && x1 <= index.resolution.x && 0 <= y0 && y0 < y1 &&
        y1 <= index.resolution.y))
    Reader::damaged();
  for (size_t i = in.count(2 * sizeof(uint32_t)); i > 0; --i) {
    std::string key = in.text();
    index.metadata.emplace_back(std::move(key), in.text());
  }
  constexpr size_t kMinSectionBytes = 3 * sizeof(uint32_t) + 3 * sizeof(uint64_t);
  for (size_t i = in.count(kMinSectionBytes); i > 0; --i) {
    Section section;
    section.name = in.text();
    section.words = in.number<uint32_t>();
    section.bytes = in.number<uint64_t>();
    section.hash = in.number<uint64_t>();
    section.offset = in.number<uint64_t>();
    section.blocks.resize(in.count(sizeof(uint32_t)));
    if (section.words < 1 || section.words > kMaxWords || section.bytes % section.stride() != 0 ||
        section.blocks.size() != section.block_count())
      Reader::damaged();
    uint64_t end = section.offset;
    for (uint32_t& size : section.blocks) {
      size = in.number<uint32_t>();
      if (end > file_bytes || size > file_bytes - end) Reader::damaged();
      end += size;
    }
    index.sections.push_back(std::move(section));
  }
  if (!in.at_end()) Reader::damaged();
  return index;
}

}  // namespace nephroid
