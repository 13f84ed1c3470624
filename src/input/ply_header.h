// The header of a PLY file: its format, its elements and their properties. It must not know
// vertices and faces. Format: G. Turk, "The PLY Polygon File Format", 1994.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace nephroid {

enum class PlyScalar { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat32, kFloat64 };

/// Bytes of a scalar in binary files.
constexpr size_t size_of(PlyScalar type) {
  switch (type) {
    case PlyScalar::kInt8:
    case PlyScalar::kUint8:
      return 1;
    case PlyScalar::kInt16:
    case PlyScalar::kUint16:
      return 2;
    case PlyScalar::kFloat64:
      return 8;
    default:
      return 4;
  }
}
constexpr bool is_integer(PlyScalar type) {
  return type != PlyScalar::kFloat32 && type != PlyScalar::kFloat64;
}

struct PlyProperty {
  std::string name;
  PlyScalar type = PlyScalar::kFloat32;  ///< type of the value, or of a list's values
  bool is_list = false;
  PlyScalar count_type = PlyScalar::kUint8;  ///< type of a list's length
};

struct PlyElement {
  std::string name;
  uint64_t count = 0;  ///< as claimed, not checked against the file
  std::vector<PlyProperty> properties;

  /// Index of the property with that name, or -1.
  int find(std::string_view property) const;
  bool has_lists() const;
  /// Least bytes of one element: lists are empty, and a value in text takes two characters.
  size_t least_bytes(bool ascii) const;
};

struct PlyHeader {
  enum class Format { kAscii, kLittleEndian, kBigEndian };
  Format format = Format::kAscii;
  std::vector<PlyElement> elements;
  size_t size = 0;  ///< bytes up to and including the end of the line "end_header"
};

/// Reads the header at the start of a file's bytes. Throws std::runtime_error with the line and the
/// fault; the caller adds the file's name.
PlyHeader read_ply_header(std::string_view bytes);

}  // namespace nephroid
