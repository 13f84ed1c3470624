#include "input/ply_header.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <stdexcept>
#include <utility>

namespace nephroid {
namespace {

struct ScalarName {
  std::string_view name;
  PlyScalar type;
};

constexpr std::array kScalarNames = {
    ScalarName{"char", PlyScalar::kInt8},      ScalarName{"int8", PlyScalar::kInt8},
    ScalarName{"uchar", PlyScalar::kUint8},    ScalarName{"uint8", PlyScalar::kUint8},
    ScalarName{"short", PlyScalar::kInt16},    ScalarName{"int16", PlyScalar::kInt16},
    ScalarName{"ushort", PlyScalar::kUint16},  ScalarName{"uint16", PlyScalar::kUint16},
    ScalarName{"int", PlyScalar::kInt32},      ScalarName{"int32", PlyScalar::kInt32},
    ScalarName{"uint", PlyScalar::kUint32},    ScalarName{"uint32", PlyScalar::kUint32},
    ScalarName{"float", PlyScalar::kFloat32},  ScalarName{"float32", PlyScalar::kFloat32},
    ScalarName{"double", PlyScalar::kFloat64}, ScalarName{"float64", PlyScalar::kFloat64},
};

/// Yields the words of a header line and reports errors in them.
class HeaderLine {
 public:
  HeaderLine(std::string_view text, int number) : rest_(text), number_(number) {}

  [[noreturn]] void fail(const std::string& message) const {
    throw std::runtime_error("header line " + std::to_string(number_) + ": " + message);
  }
  /// The next word, empty at the end of the line.
  std::string_view word() {
    const size_t start = std::min(rest_.find_first_not_of(" \t"), rest_.size());
    const size_t end = std::min(rest_.find_first_of(" \t", start), rest_.size());
    const std::string_view result = rest_.substr(start, end - start);
    rest_.remove_prefix(end);
    return result;
  }
  std::string_view word(const char* what) {
    const std::string_view result = word();
    if (result.empty()) fail(std::string("the line ends too early, expected ") + what);
    return result;
  }
  PlyScalar scalar() {
    const std::string_view name = word("a type");
    const auto* const found =
        std::find_if(kScalarNames.begin(), kScalarNames.end(),
                     [&](const ScalarName& known) { return known.name == name; });
    if (found == kScalarNames.end())
      fail("unknown type \"" + std::string(name) +
           "\", expected char, uchar, short, ushort, int, "
           "uint, float or double");
    return found->type;
  }

 private:
  std::string_view rest_;
  int number_;
};

PlyHeader::Format read_format(HeaderLine& line) {
  const std::string_view name = line.word("a format");
  if (name == "ascii") return PlyHeader::Format::kAscii;
  if (name == "binary_little_endian") return PlyHeader::Format::kLittleEndian;
  if (name == "binary_big_endian") return PlyHeader::Format::kBigEndian;
  line.fail("unknown format \"" + std::string(name) +
            "\", expected ascii, binary_little_endian or binary_big_endian");
}

PlyElement read_element(HeaderLine& line, const PlyHeader& header) {
  PlyElement element;
  element.name = line.word("the name of an element");
  const std::string_view count = line.word("the number of elements");
  const auto result = std::from_chars(count.data(), count.data() + count.size(), element.count);
  // The bound keeps sums of bytes far from overflowing; no file comes near it.
  constexpr uint64_t kMaxElements = uint64_t{1} << 40;
  if (result.ec != std::errc() || result.ptr != count.data() + count.size() ||
      element.count > kMaxElements)
    line.fail("expected a number of elements, found \"" + std::string(count) + "\"");
  for (const PlyElement& other : header.elements) {
    if (other.name == element.name)
      line.fail("element \"" + element.name + "\" is declared twice, expected once");
  }
  return element;
}

PlyProperty read_property(HeaderLine& line, const PlyHeader& header) {
  if (header.elements.empty())
    line.fail("the property has no element, expected an element line before it");
  PlyProperty property;
  HeaderLine ahead = line;
  if (ahead.word() == "list") {
    line = ahead;
    property.is_list = true;
    property.count_type = line.scalar();
    if (!is_integer(property.count_type))
      line.fail("the length of the list has a float type, expected an integer type");
  }
  property.type = line.scalar();
  property.name = line.word("the name of a property");
  if (header.elements.back().find(property.name) >= 0)
    line.fail("property \"" + property.name + "\" is declared twice, expected once");
  return property;
}

}  // namespace

int PlyElement::find(std::string_view property) const {
  for (size_t i = 0; i < properties.size(); ++i) {
    if (properties[i].name == property) return static_cast<int>(i);
  }
  return -1;
}

bool PlyElement::has_lists() const {
  return std::any_of(properties.begin(), properties.end(),
                     [](const PlyProperty& property) { return property.is_list; });
}

size_t PlyElement::least_bytes(bool ascii) const {
  size_t bytes = 0;
  for (const PlyProperty& property : properties)
    bytes += ascii ? 2 : size_of(property.is_list ? property.count_type : property.type);
  return bytes;
}

PlyHeader read_ply_header(std::string_view bytes) {
  PlyHeader header;
  bool has_format = false;
  size_t start = 0;
  for (int number = 1;; ++number) {
    const size_t end = bytes.find('\n', start);
    if (number == 1 && bytes.substr(0, 3) != "ply")
      throw std::runtime_error("it does not start with \"ply\", expected a PLY file");
    if (end == std::string_view::npos)
      throw std::runtime_error("the file ends inside the header, expected end_header");
    std::string_view text = bytes.substr(start, end - start);
    start = end + 1;
    if (!text.empty() && text.back() == '\r') text.remove_suffix(1);

    HeaderLine line(text, number);
    const std::string_view keyword = line.word();
    if (number == 1) {
      if (keyword != "ply") line.fail("found \"" + std::string(keyword) + "\", expected \"ply\"");
    } else if (keyword == "format") {
      header.format = read_format(line);
      has_format = true;
    } else if (keyword == "element") {
      header.elements.push_back(read_element(line, header));
    } else if (keyword == "property") {
      PlyProperty property = read_property(line, header);
      header.elements.back().properties.push_back(std::move(property));
    } else if (keyword == "end_header") {
      if (!has_format) line.fail("the header has no format line, expected one before end_header");
      header.size = start;
      return header;
    } else if (keyword != "comment" && keyword != "obj_info" && !keyword.empty()) {
      line.fail("unknown keyword \"" + std::string(keyword) +
                "\", expected format, element, property, comment or end_header");
    }
  }
}

}  // namespace nephroid
