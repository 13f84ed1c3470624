// A number that stands for bytes (XXH3, 64 bits), to tell whether two files are the same or one is
// damaged. It does not keep anybody from making two files with the same number.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

struct XXH3_state_s;

namespace nephroid {

/// The hash of bytes that come in pieces; where these are cut does not change it.
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
