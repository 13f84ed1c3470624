// Encodes values for PLY files, for any byte order of this machine.
#include "unit/input/ply_bytes.h"

#include <bit>
#include <cstring>
#include <sstream>
#include <stdexcept>

namespace nephroid::testing {

PlyBytes& PlyBytes::header(const std::string& body) {
  const char* const formats[] = {"ascii", "binary_little_endian", "binary_big_endian"};
  bytes_ += std::string("ply\nformat ") + formats[static_cast<int>(encoding_)] + " 1.0\n" + body +
            "end_header\n";
  return *this;
}

PlyBytes& PlyBytes::add(const std::string& type, double value) {
  if (encoding_ == PlyEncoding::kAscii) {
    std::ostringstream text;
    text.precision(17);
    text << value << ' ';
    bytes_ += text.str();
    return *this;
  }
  const auto write = [&](auto converted) { append(&converted, sizeof(converted)); };
  if (type == "char" || type == "int8") {
    write(static_cast<int8_t>(value));
  } else if (type == "uchar" || type == "uint8") {
    write(static_cast<uint8_t>(value));
  } else if (type == "short" || type == "int16") {
    write(static_cast<int16_t>(value));
  } else if (type == "ushort" || type == "uint16") {
    write(static_cast<uint16_t>(value));
  } else if (type == "int" || type == "int32") {
    write(static_cast<int32_t>(value));
  } else if (type == "uint" || type == "uint32") {
    write(static_cast<uint32_t>(value));
  } else if (type == "float" || type == "float32") {
    write(static_cast<float>(value));
  } else if (type == "double" || type == "float64") {
    write(value);
  } else {
    throw std::runtime_error("no PLY type " + type);
  }
  return *this;
}

void PlyBytes::append(const void* value, size_t size) {
  std::string raw(static_cast<const char*>(value), size);
  const bool little = encoding_ == PlyEncoding::kLittleEndian;
  if (little != (std::endian::native == std::endian::little)) raw.assign(raw.rbegin(), raw.rend());
  bytes_ += raw;
}

}  // namespace nephroid::testing
