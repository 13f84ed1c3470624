#include "input/convert/pbrt_text.h"

#include <fmt/format.h>

namespace nephroid {
namespace {

constexpr size_t kNumbersPerLine = 24;

}  // namespace

std::string quoted_text(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    if (c == '\n')
      result += "\\n";
    else if (c == '\r')
      result += "\\r";
    else
      result += c;
  }
  return result + '"';
}

std::string shortest_text(double value) {
  return fmt::format("{}", value);
}

std::string parameter_text(const Parameter& parameter) {
  std::string text = quoted_text(parameter.type + " " + parameter.name) + " [";
  size_t count = 0;
  for (const double value : parameter.numbers) {
    text += count > 0 && count % kNumbersPerLine == 0 ? "\n   " : " ";
    fmt::format_to(std::back_inserter(text), "{}", value);
    ++count;
  }
  for (const std::string& value : parameter.strings) text += " " + quoted_text(value);
  for (const bool value : parameter.bools) text += value ? " true" : " false";
  return text + " ]";
}

std::string matrix_text(const Mat44d& matrix) {
  std::string text = "[";
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) text += " " + shortest_text(matrix[i][j] + 0.0);
  return text + " ]";
}

std::string transform_text(const TransformDescription& transform) {
  const std::string start = "Transform " + matrix_text(transform.start) + "\n";
  if (!transform.is_animated()) return start;
  return "ActiveTransform StartTime\n" + start + "ActiveTransform EndTime\nTransform " +
         matrix_text(transform.end) + "\nActiveTransform All\n";
}

}  // namespace nephroid
