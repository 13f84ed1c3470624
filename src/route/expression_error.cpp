#include "route/expression_error.h"

#include <algorithm>

namespace nephroid {
namespace {

bool begins_character(char c) {
  return (static_cast<unsigned char>(c) & 0xc0u) != 0x80u;  // UTF-8
}

}  // namespace

UsageError expression_error(const ExpressionSource& source, size_t offset,
                            const std::string& message) {
  offset = std::min(offset, source.text.size());
  std::string caret;
  size_t column = 1;
  for (size_t i = 0; i < offset; ++i)
    if (begins_character(source.text[i])) {
      caret += source.text[i] == '\t' ? '\t' : ' ';
      ++column;
    }
  return UsageError(source.where + ": column " + std::to_string(column) + ": " + message + "\n  " +
                    source.text + "\n  " + caret + "^");
}

std::string found_text(std::string_view text, size_t offset, const char* at_end) {
  if (offset >= text.size()) return at_end;
  size_t end = offset + 1;
  while (end < text.size() && !begins_character(text[end])) ++end;
  return "'" + std::string(text.substr(offset, end - offset)) + "'";
}

}  // namespace nephroid
