#include "input/gltf/uri.h"

#include <array>
#include <cctype>
#include <cstdint>
#include <optional>
#include <string_view>

namespace nephroid::gltf {
namespace {

constexpr std::string_view kData = "data:", kBase64 = ";base64";

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

/// A percent sign without two digits stands for itself: exporters write such names.
std::string percent_decoded(std::string_view text) {
  std::string result;
  for (size_t i = 0; i < text.size(); ++i) {
    const bool is_code = text[i] == '%' && i + 2 < text.size() && hex_digit(text[i + 1]) >= 0 &&
                         hex_digit(text[i + 2]) >= 0;
    if (!is_code) {
      result += text[i];
      continue;
    }
    result += static_cast<char>(16 * hex_digit(text[i + 1]) + hex_digit(text[i + 2]));
    i += 2;
  }
  return result;
}

/// The six bits of a base64 letter; 64 for other characters.
constexpr std::array<uint8_t, 256> make_base64_table() {
  constexpr std::string_view kLetters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::array<uint8_t, 256> table{};
  table.fill(64);
  for (size_t i = 0; i < kLetters.size(); ++i)
    table[static_cast<uint8_t>(kLetters[i])] = static_cast<uint8_t>(i);
  table['-'] = 62;  // the letters of URLs
  table['_'] = 63;
  return table;
}

std::optional<std::string> base64_decoded(std::string_view text) {
  static constexpr std::array<uint8_t, 256> kTable = make_base64_table();
  while (!text.empty() && text.back() == '=') text.remove_suffix(1);
  std::string result;
  result.reserve(text.size() / 4 * 3 + 2);
  uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    const uint8_t value = kTable[static_cast<uint8_t>(c)];
    if (value == 64) return std::nullopt;
    bits = bits << 6 | value;
    count += 6;
    if (count < 8) continue;
    count -= 8;
    result += static_cast<char>(bits >> count & 0xff);
  }
  if (count >= 6) return std::nullopt;
  return result;
}

}  // namespace

bool is_data_uri(const std::string& uri) {
  return uri.starts_with(kData);
}

std::string data_of_uri(const std::string& text, const JsonValue& uri) {
  const size_t comma = text.find(',');
  if (comma == std::string::npos)
    uri.fail("this data URI has no comma, expected one before the data");
  const std::string_view type = std::string_view(text).substr(0, comma);
  const std::string_view data = std::string_view(text).substr(comma + 1);
  if (!type.ends_with(kBase64)) return percent_decoded(data);
  std::optional<std::string> bytes = base64_decoded(data);
  if (!bytes) uri.fail("this data URI is damaged, expected base64");
  return *std::move(bytes);
}

std::string file_of_uri(const std::string& text, const JsonValue& uri) {
  const size_t colon = text.find(':');
  const size_t slash = text.find('/');
  // One letter before a colon is a drive of another system, which is no file here either.
  if (colon != std::string::npos && colon > 0 && (slash == std::string::npos || colon < slash))
    uri.fail("\"" + text.substr(0, 100) +
             "\" is not in the scene's folder, expected a relative "
             "file name or a data URI: nothing is fetched from elsewhere");
  if (text.empty()) uri.fail("this file name is empty, expected a relative one");
  return percent_decoded(text);
}

}  // namespace nephroid::gltf
