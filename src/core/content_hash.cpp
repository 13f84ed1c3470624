#include "core/content_hash.h"

#include <bit>
#include <cstring>

namespace nephroid {

static_assert(std::endian::native == std::endian::little);

void ContentHash::add(std::span<const std::byte> bytes) {
  const auto add_byte = [&](std::byte byte) {
    word_ |= std::to_integer<uint64_t>(byte) << (8 * (count_ % 8));
    if (++count_ % 8 != 0) return;
    add_word(word_);
    word_ = 0;
  };
  while (!bytes.empty() && count_ % 8 != 0) {
    add_byte(bytes[0]);
    bytes = bytes.subspan(1);
  }
  for (; bytes.size() >= 8; bytes = bytes.subspan(8)) {
    uint64_t word;
    std::memcpy(&word, bytes.data(), 8);
    add_word(word);
    count_ += 8;
  }
  for (const std::byte byte : bytes) add_byte(byte);
}

uint64_t ContentHash::value() const {
  ContentHash ended = *this;
  ended.add_word(word_);
  ended.add_word(count_);
  return ended.hash_;
}

}  // namespace nephroid
