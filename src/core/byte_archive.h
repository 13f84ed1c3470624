// Serializes values to bytes, for data stored beside a picture. Numbers are stored as in memory,
// lists after their length. A type lists its members in a static function:
//   static void members(auto& self, auto& archive) { archive(self.a, self.b); }
// If it has a public `bool is_sound() const`, values that were read must pass this check.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <type_traits>
#include <vector>

#include "core/errors.h"
#include "core/math.h"

namespace nephroid {

/// A type whose bytes are its value: no padding, no pointers.
template <class T>
concept PlainBytes = std::is_arithmetic_v<T> || std::is_enum_v<T> || std::is_same_v<T, Vec2f> ||
    std::is_same_v<T, Vec3f>;

class ByteWriter {
 public:
  template <class... T>
  void operator()(const T&... values) {
    (write(values), ...);
  }
  const std::vector<std::byte>& bytes() const { return bytes_; }

 private:
  template <class T>
  void write(const T& value) {
    if constexpr (PlainBytes<T>) {
      append(&value, sizeof(T));
    } else {
      T::members(value, *this);
    }
  }
  template <class T>
  void write(const std::vector<T>& list) {
    write(static_cast<uint64_t>(list.size()));
    if constexpr (PlainBytes<T>)
      append(list.data(), list.size() * sizeof(T));
    else
      for (const T& value : list) write(value);
  }
  template <class T, size_t N>
  void write(const T (&list)[N]) {
    for (const T& value : list) write(value);
  }
  template <class T>
  void write(const std::optional<T>& value) {
    write(static_cast<uint8_t>(value.has_value()));
    if (value) write(*value);
  }
  void append(const void* data, size_t size) {
    const auto* begin = static_cast<const std::byte*>(data);
    bytes_.insert(bytes_.end(), begin, begin + size);
  }

  std::vector<std::byte> bytes_;
};

/// Throws IoError unless the value that was read is sound.
inline void expect_sound(bool is_sound) {
  if (!is_sound) throw IoError("stored values are damaged: one of them is invalid");
}

/// Reads the bytes of a ByteWriter. Throws IoError if the bytes end too early, a list claims to be
/// longer than they are, or a value is not sound.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::byte> bytes) : left_(bytes) {}
  template <class... T>
  void operator()(T&... values) {
    (read(values), ...);
  }
  bool at_end() const { return left_.empty(); }

 private:
  template <class T>
  void read(T& value) {
    if constexpr (std::is_same_v<T, bool>) {
      value = flag();
    } else if constexpr (PlainBytes<T>) {
      take(&value, sizeof(T));
    } else {
      T::members(value, *this);
      if constexpr (requires { value.is_sound(); }) expect_sound(value.is_sound());
    }
  }
  template <class T>
  void read(std::vector<T>& list) {
    uint64_t size = 0;
    read(size);
    // Each element has at least one byte.
    constexpr uint64_t kMinBytes = PlainBytes<T> ? sizeof(T) : 1;
    if (size > left_.size() / kMinBytes) damaged();
    list.clear();
    if constexpr (PlainBytes<T>) {
      list.resize(size);
      take(list.data(), size * sizeof(T));
    } else {
      for (uint64_t i = 0; i < size; ++i) read(list.emplace_back());
    }
  }
  template <class T, size_t N>
  void read(T (&list)[N]) {
    for (T& value : list) read(value);
  }
  template <class T>
  void read(std::optional<T>& value) {
    value.reset();
    if (flag()) read(value.emplace());
  }
  /// Reads a bool, whose byte must be 0 or 1.
  bool flag() {
    uint8_t byte = 0;
    read(byte);
    expect_sound(byte <= 1);
    return byte == 1;
  }
  void take(void* data, size_t size) {
    if (size > left_.size()) damaged();
    if (size > 0) std::memcpy(data, left_.data(), size);
    left_ = left_.subspan(size);
  }
  [[noreturn]] static void damaged() {
    throw IoError("stored values are damaged: they end too early");
  }

  std::span<const std::byte> left_;
};

}  // namespace nephroid
