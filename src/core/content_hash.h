// A number that stands for bytes, to tell whether two files are the same or one is damaged. Nobody
// is kept from making two files with the same number.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace nephroid {

/// 64 bits that change with any bit of the bytes. They may come in pieces, wherever they are cut.
class ContentHash {
 public:
  void add(std::span<const std::byte> bytes);
  uint64_t value() const;

 private:
  void add_word(uint64_t word) {
    hash_ = (hash_ ^ word) * 0x9e3779b97f4a7c15ull;
    hash_ ^= hash_ >> 29;
  }

  uint64_t hash_ = 0xcbf29ce484222325ull;
  uint64_t count_ = 0;  ///< of bytes so far
  uint64_t word_ = 0;   ///< those behind the last whole word
};

inline uint64_t hash_of(std::span<const std::byte> bytes) {
  ContentHash hash;
  hash.add(bytes);
  return hash.value();
}

}  // namespace nephroid
