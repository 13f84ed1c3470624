// The state that a render keeps from pass to pass, as spans over its memory, for saving and
// resuming. It must not know what the bytes mean.
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
  /// Items of 32-bit little-endian words: one item per pixel of the crop, row by row, or any other
  /// number.
  struct Array {
    std::string name;  ///< unique
    size_t words = 1;  ///< words per item
    std::span<std::byte> bytes;
    size_t items() const { return bytes.size() / (4 * words); }
  };
  /// Words whose number is unknown until they are read.
  struct Stream {
    std::string name;
    size_t most_words = 0;
    std::function<std::vector<uint32_t>()> save;
    /// Throws IoError if the words are invalid; the message has the reason without the file's name.
    std::function<void(std::span<const uint32_t>)> load;
    /// True for values that can be recomputed: a file may lack them, and a reader may skip them.
    /// Their names begin with kOptionalPrefix.
    bool is_optional() const { return is_optional(name); }
    static bool is_optional(std::string_view name) { return name.starts_with(kOptionalPrefix); }
  };
  static constexpr std::string_view kOptionalPrefix = "optional.";

  std::vector<Array> arrays;
  std::vector<Stream> streams;

  /// Adds the memory of `items`, of which `together` form one item. It must not move.
  template <class T>
  void add(std::string name, std::span<T> items, size_t together = 1) {
    static_assert(std::is_trivially_copyable_v<T> && sizeof(T) % 4 == 0);
    arrays.push_back({std::move(name), together * sizeof(T) / 4, std::as_writable_bytes(items)});
  }
};

}  // namespace nephroid
