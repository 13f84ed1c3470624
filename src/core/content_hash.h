// A 64-bit content hash (XXH3), to compare files and to detect damage. It is not cryptographic.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

struct XXH3_state_s;

namespace nephroid {

/// The hash of bytes added in pieces of any size.
class ContentHash {
 public:
  ContentHash();
  void add(std::span<const std::byte> bytes);
  uint64_t value() const;

 private:
  struct Free {
    void operator()(XXH3_state_s* state) const;
  };
  std::unique_ptr<XXH3_state_s, Free> state_;
};

uint64_t hash_of(std::span<const std::byte> bytes);

}  // namespace nephroid
