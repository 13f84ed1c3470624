#include "apps/messages.h"

#include <fmt/format.h>

#include <cstdio>

namespace nephroid {
namespace {

/// Number of bytes of the well-formed printable UTF-8 character at `i`, or 0 if there is none.
size_t printable_length(const std::string& text, size_t i) {
  const auto byte = [&](size_t k) {
    return k < text.size() ? static_cast<unsigned char>(text[k]) : 0u;
  };
  const unsigned first = byte(i);
  if (first < 0x80) return (first >= 0x20 && first != 0x7f) || first == '\n' ? 1 : 0;
  const size_t length = first < 0xc2   ? 0
                        : first < 0xe0 ? 2
                        : first < 0xf0 ? 3
                        : first < 0xf5 ? 4
                                       : 0;
  for (size_t k = 1; k < length; ++k)
    if ((byte(i + k) & 0xc0) != 0x80) return 0;
  // U+0080 to U+009F are also control characters.
  return first == 0xc2 && byte(i + 1) < 0xa0 ? 0 : length;
}

}  // namespace

std::string printable(const std::string& text) {
  std::string result;
  for (size_t i = 0; i < text.size();) {
    const size_t length = printable_length(text, i);
    if (length == 0)
      result += fmt::format("\\x{:02x}", static_cast<unsigned char>(text[i]));
    else
      result.append(text, i, length);
    i += length == 0 ? 1 : length;
  }
  return result;
}

void say(const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
  std::clearerr(stderr);
}

void print_error(const std::string& message) {
  say(fmt::format("nephroid: error: {}\n", printable(message)));
}

void print_warning(const std::string& message) {
  say(fmt::format("nephroid: warning: {}\n", printable(message)));
}

void print_warnings(const std::vector<std::string>& messages) {
  for (const std::string& message : messages) print_warning(message);
}

void print_notes(const std::vector<std::string>& messages) {
  for (const std::string& message : messages) say(fmt::format("note: {}\n", printable(message)));
}

}  // namespace nephroid
