#include "input/obj/text_lines.h"

#include <algorithm>

namespace nephroid {
namespace {

bool is_obj_blank(char c) {
  return c == ' ' || (c >= '\t' && c <= '\r');
}

/// True if the line names a material, as in usemtl Material #2.
bool names_material(std::string_view line) {
  const std::string_view word = take_word(&line);
  return word == "newmtl" || word == "usemtl";
}

/// The line without its comment. A "#" inside of a word begins none, nor does one before the number
/// of a material.
std::string_view without_comment(std::string_view line) {
  for (size_t i = 0; i < line.size(); ++i) {
    if (line[i] != '#' || (i > 0 && !is_obj_blank(line[i - 1]))) continue;
    const bool is_number = i + 1 < line.size() && line[i + 1] >= '0' && line[i + 1] <= '9';
    if (!(is_number && names_material(line))) return line.substr(0, i);
  }
  return line;
}

}  // namespace

std::string_view take_word(std::string_view* text) {
  size_t start = 0;
  while (start < text->size() && is_obj_blank((*text)[start])) ++start;
  size_t end = start;
  while (end < text->size() && !is_obj_blank((*text)[end])) ++end;
  const std::string_view word = text->substr(start, end - start);
  text->remove_prefix(end);
  return word;
}

std::string_view stripped(std::string_view text) {
  while (!text.empty() && is_obj_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_obj_blank(text.back())) text.remove_suffix(1);
  return text;
}

TextLines::TextLines(std::string_view bytes) : rest_(bytes) {
  if (rest_.starts_with("\xef\xbb\xbf")) rest_.remove_prefix(3);
}

/// The next line without its end, which is "\n", "\r\n" or "\r".
std::string_view TextLines::take_line() {
  const size_t end = std::min(rest_.find_first_of("\r\n"), rest_.size());
  const std::string_view line = rest_.substr(0, end);
  const bool has_two = rest_.substr(end).starts_with("\r\n");
  rest_.remove_prefix(std::min(end + (has_two ? 2 : 1), rest_.size()));
  ++number_;
  return line;
}

bool TextLines::next(TextLine* line) {
  while (!rest_.empty()) {
    std::string_view text = take_line();
    line->number = number_;
    if (text.ends_with('\\') && !rest_.empty()) {
      joined_.clear();
      for (; text.ends_with('\\') && !rest_.empty(); text = take_line())
        joined_.append(text.substr(0, text.size() - 1)).append(" ");
      text = joined_.append(text);
    }
    line->text = stripped(without_comment(text));
    if (!line->text.empty()) return true;
  }
  return false;
}

}  // namespace nephroid
