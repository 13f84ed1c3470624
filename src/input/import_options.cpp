#include "input/import_options.h"

#include <fmt/format.h>

namespace nephroid {
namespace {

/// The text without blanks, and without "%" that could be read as one.
std::string as_word(const std::string& text) {
  std::string word;
  for (const char c : text)
    if (c == '%' || static_cast<unsigned char>(c) <= ' ')
      word += fmt::format("%{:02x}", static_cast<unsigned char>(c));
    else
      word += c;
  return word;
}

}  // namespace

std::string import_options_text(const ImportOptions& options) {
  std::string text;
  const auto add = [&](const std::string& key, const std::string& value) {
    text += (text.empty() ? "" : " ") + key + "=" + as_word(value);
  };
  if (!options.camera.empty()) add("camera", options.camera);
  if (!options.variant.empty()) add("variant", options.variant);
  if (options.time != 0) add("at", fmt::format("{}", options.time));
  if (options.shutter != 0) add("shutter", fmt::format("{}", options.shutter));
  if (options.solid_glass) add("solid-glass", "yes");
  for (const auto& define : options.defines) add("define:" + as_word(define.first), define.second);
  if (options.floor) add("floor", "yes");
  if (!options.environment.empty()) add("environment", options.environment);
  if (options.sun) add("sun", fmt::format("{},{}", options.sun->elevation, options.sun->azimuth));
  if (options.exposure) add("exposure", fmt::format("{}", *options.exposure));
  return text;
}

}  // namespace nephroid
