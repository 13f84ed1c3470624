// What a render keeps from pass to pass, as spans over the memory in which it lies: enough to write
// it down and to go on from it. Who calls it: the film and estimators tell theirs, exr_file.h
// writes it, state_file.h reads it. It must not know what the bytes mean.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace nephroid {

struct RenderState {
  /// Items of whole 32-bit words, little-endian: one for each pixel of the crop, row by row, or any
  /// other number of them.
  struct Array {
    std::string name;  ///< one of its own
    size_t words = 1;  ///< of an item
    std::span<std::byte> bytes;
    size_t items() const { return bytes.size() / (4 * words); }
  };
  /// Words whose number is not known before they are read.
  struct Stream {
    std::string name;
    size_t most_words = 0;
    std::function<std::vector<uint32_t>()> save;
    /// Throws IoError if they make no sense; the message says what, not where.
    std::function<void(std::span<const uint32_t>)> load;
    /// True for values that can be computed again, so a file need not have them and a reader may
    /// skip them. Their names begin with kOptionalPrefix.
    bool is_optional() const { return is_optional(name); }
    static bool is_optional(std::string_view name) { return name.starts_with(kOptionalPrefix); }
  };
  static constexpr std::string_view kOptionalPrefix = "optional.";

  std::vector<Array> arrays;
  std::vector<Stream> streams;

  /// The memory of `items`, `together` of which belong together. It must stay where it is.
  template <class T>
  void add(std::string name, std::span<T> items, size_t together = 1) {
    static_assert(std::is_trivially_copyable_v<T> && sizeof(T) % 4 == 0);
    arrays.push_back({std::move(name), together * sizeof(T) / 4, std::as_writable_bytes(items)});
  }
};

}  // namespace nephroid
