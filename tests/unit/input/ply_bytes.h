// Writes small PLY files in each of the three encodings, value by value.
#pragma once

#include <cstdint>
#include <string>

namespace nephroid::testing {

enum class PlyEncoding { kAscii, kLittleEndian, kBigEndian };

class PlyBytes {
 public:
  explicit PlyBytes(PlyEncoding encoding) : encoding_(encoding) {}

  /// Adds the header; `body` is its lines between "format" and "end_header".
  PlyBytes& header(const std::string& body);
  /// Adds one value of the named PLY type.
  PlyBytes& add(const std::string& type, double value);
  const std::string& bytes() const { return bytes_; }

 private:
  void append(const void* value, size_t size);

  PlyEncoding encoding_;
  std::string bytes_;
};

}  // namespace nephroid::testing
