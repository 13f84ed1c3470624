#include "bench/html_text.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "film/image_io.h"

namespace nephroid {
namespace {

std::string base64(const std::vector<uint8_t>& bytes) {
  constexpr const char* kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (size_t i = 0; i < bytes.size(); i += 3) {
    uint32_t group = 0;
    for (size_t k = 0; k < 3; ++k) group = group << 8 | (i + k < bytes.size() ? bytes[i + k] : 0u);
    for (size_t k = 0; k < 4; ++k)
      text += i + k > bytes.size() ? '=' : kDigits[group >> (18 - 6 * k) & 63];
  }
  return text;
}

}  // namespace

std::string html_escape(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default: {
        const auto code = static_cast<unsigned char>(c);
        const bool control = (code < 0x20 && c != '\n' && c != '\t') || code == 0x7f;
        result += control ? ' ' : c;
      }
    }
  }
  return result;
}

std::string number_text(double value) {
  if (!std::isfinite(value)) return "—";
  if (value < 0) return "−" + number_text(-value);
  if (value >= 1000 && value < 1e6) return fmt::format("{:.0f}", value);
  return fmt::format("{:.3g}", value);
}

std::string count_text(double value) {
  constexpr const char* kUnits[] = {"", " k", " M", " G", " T"};
  size_t unit = 0;
  for (; std::abs(value) >= 999.5 && unit + 1 < std::size(kUnits); ++unit) value /= 1000;
  return fmt::format("{:.3g}{}", value, kUnits[unit]);
}

std::string bytes_in_words(double value) {
  const std::string text = count_text(value);
  return text + (text.find(' ') == std::string::npos ? " B" : "B");
}

std::string seconds_in_words(double seconds) {
  if (!(seconds >= 1)) return number_text(1000 * seconds) + " ms";
  if (seconds < 120) return number_text(seconds) + " s";
  return seconds < 7200 ? number_text(seconds / 60) + " min" : number_text(seconds / 3600) + " h";
}

std::string png_data_url(int width, int height, const std::vector<uint8_t>& rgb) {
  return "data:image/png;base64," + base64(encode_png(width, height, rgb));
}

}  // namespace nephroid
