// Reads the values in the body of a PLY file in order: text, or binary in either byte order. It
// must not know elements and properties.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "input/number_text.h"
#include "input/ply_header.h"

namespace nephroid {

/// Thrown by the sources when the bytes end inside of a value.
struct PlyTruncated {
  uint64_t missing_bytes = 1;  ///< lower bound
};

/// Thrown by the text source for a word that is not a number.
struct PlyBadValue {
  std::string message;
};

/// Binary values; `kSwap` if the file's byte order is not the machine's.
template <bool kSwap>
class PlyBinarySource {
 public:
  static constexpr bool kAscii = false;
  explicit PlyBinarySource(std::string_view bytes) : bytes_(bytes) {}

  size_t remaining() const { return bytes_.size(); }
  double number(PlyScalar type) {
    if (type == PlyScalar::kFloat32) return take<float, uint32_t>();
    if (type == PlyScalar::kFloat64) return take<double, uint64_t>();
    return static_cast<double>(integer(type));
  }
  int64_t integer(PlyScalar type) {
    switch (type) {
      case PlyScalar::kInt8:
        return take<int8_t, uint8_t>();
      case PlyScalar::kUint8:
        return take<uint8_t, uint8_t>();
      case PlyScalar::kInt16:
        return take<int16_t, uint16_t>();
      case PlyScalar::kUint16:
        return take<uint16_t, uint16_t>();
      case PlyScalar::kInt32:
        return take<int32_t, uint32_t>();
      default:
        return take<uint32_t, uint32_t>();
    }
  }
  void skip(PlyScalar type, uint64_t count) {
    const uint64_t bytes = count * size_of(type);
    expect(bytes);
    bytes_.remove_prefix(bytes);
  }

 private:
  void expect(uint64_t bytes) const {
    if (bytes > bytes_.size()) throw PlyTruncated{bytes - bytes_.size()};
  }
  template <class Value, class Bits>
  Value take() {
    expect(sizeof(Bits));
    Bits bits;
    std::memcpy(&bits, bytes_.data(), sizeof(Bits));
    bytes_.remove_prefix(sizeof(Bits));
    if constexpr (kSwap) {
      if constexpr (sizeof(Bits) == 2) bits = __builtin_bswap16(bits);
      if constexpr (sizeof(Bits) == 4) bits = __builtin_bswap32(bits);
      if constexpr (sizeof(Bits) == 8) bits = __builtin_bswap64(bits);
    }
    return std::bit_cast<Value>(bits);
  }

  std::string_view bytes_;
};

/// Values as words between blanks; lines do not matter.
class PlyTextSource {
 public:
  static constexpr bool kAscii = true;
  explicit PlyTextSource(std::string_view bytes) : bytes_(bytes) {}

  size_t remaining() const { return bytes_.size(); }
  double number(PlyScalar) {
    const std::string_view text = word();
    const std::optional<double> value = parse_number(text);
    if (!value) throw PlyBadValue{"\"" + std::string(text) + "\" is not a number"};
    return *value;
  }
  int64_t integer(PlyScalar) {
    const std::string_view text = word();
    const std::optional<long long> value = parse_integer(text);
    if (!value) throw PlyBadValue{"\"" + std::string(text) + "\" is not an integer"};
    return *value;
  }
  void skip(PlyScalar, uint64_t count) {
    for (uint64_t i = 0; i < count; ++i) word();
  }

 private:
  static bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
  std::string_view word() {
    size_t start = 0;
    while (start < bytes_.size() && is_blank(bytes_[start])) ++start;
    size_t end = start;
    while (end < bytes_.size() && !is_blank(bytes_[end])) ++end;
    if (start == end) throw PlyTruncated{};
    const std::string_view result = bytes_.substr(start, end - start);
    bytes_.remove_prefix(end);
    return result;
  }

  std::string_view bytes_;
};

}  // namespace nephroid
