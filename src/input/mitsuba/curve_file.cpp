#include "input/mitsuba/curve_file.h"

#include <cmath>
#include <cstring>
#include <optional>
#include <string>

#include "input/mitsuba/value_text.h"
#include "input/number_text.h"

namespace nephroid::mitsuba {
namespace {

constexpr std::string_view kBinaryMark = "BINARY_HAIR";

void drop_empty(std::vector<Strand>& strands) {
  std::erase_if(strands, [](const Strand& s) { return s.points.empty(); });
}

/// A point in a line; `line` counts from 1.
void add_point(Strand& strand, std::string_view text, bool has_radii, size_t line,
               const SourceLocation& where) {
  const std::vector<std::string_view> words = words_of(text);
  float values[4] = {};
  const size_t expected = has_radii ? 4 : 3;
  bool good = words.size() == expected;
  for (size_t i = 0; good && i < expected; ++i) {
    const std::optional<double> value = parse_number(words[i]);
    good = value && std::isfinite(*value);
    if (good) values[i] = static_cast<float>(*value);
  }
  if (!good)
    throw SceneError(where, "line " + std::to_string(line) +
                                " of the file has no point, expected " +
                                (has_radii ? "x, y, z and a radius" : "x, y and z"));
  strand.points.emplace_back(values[0], values[1], values[2]);
  if (has_radii) strand.radii.push_back(values[3]);
}

std::vector<Strand> read_text(std::string_view bytes, bool has_radii, const SourceLocation& where) {
  std::vector<Strand> strands(1);
  size_t line = 1;
  for (size_t start = 0; start < bytes.size(); ++line) {
    const size_t end = std::min(bytes.find('\n', start), bytes.size());
    const std::string_view text = trimmed(bytes.substr(start, end - start));
    start = end + 1;
    if (text.empty()) {
      if (!strands.back().points.empty()) strands.emplace_back();
    } else if (text[0] != '#') {
      add_point(strands.back(), text, has_radii, line, where);
    }
  }
  return strands;
}

/// Three floats per point; an infinite one in front begins a strand.
std::vector<Strand> read_binary(std::string_view bytes, const SourceLocation& where) {
  const auto next_float = [&]() {
    if (bytes.size() < sizeof(float)) throw SceneError(where, "the hair file ends too early");
    float value;
    std::memcpy(&value, bytes.data(), sizeof(value));
    bytes.remove_prefix(sizeof(value));
    return value;
  };
  bytes.remove_prefix(kBinaryMark.size());
  const uint32_t count = std::bit_cast<uint32_t>(next_float());
  std::vector<Strand> strands(1);
  for (uint32_t i = 0; i < count; ++i) {
    float x = next_float();
    if (std::isinf(x)) {
      strands.emplace_back();
      x = next_float();
    }
    const float y = next_float(), z = next_float();
    const Vec3f point(x, y, z);
    if (!is_finite(point))
      throw SceneError(where, "a point of the hair file is not finite, expected finite numbers");
    strands.back().points.push_back(point);
  }
  return strands;
}

}  // namespace

std::vector<Strand> read_strands(std::string_view bytes, bool has_radii,
                                 const SourceLocation& where) {
  const bool is_binary = !has_radii && bytes.starts_with(kBinaryMark);
  std::vector<Strand> strands =
      is_binary ? read_binary(bytes, where) : read_text(bytes, has_radii, where);
  drop_empty(strands);
  return strands;
}

}  // namespace nephroid::mitsuba
