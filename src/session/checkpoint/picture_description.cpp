// Line by line from the metadata.
#include "session/checkpoint/picture_description.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <string_view>

#include "session/checkpoint/checkpoint.h"
#include "session/checkpoint/film_metadata.h"

namespace nephroid {
namespace {

std::string state_line(const StateFile& file) {
  if (!file.has_state()) return "none: it cannot be resumed or merged";
  const PassRanges passes = passes_of(file, "describe it");
  const std::optional<uint32_t> open = open_pass_of(file);
  return fmt::format(
      "{} passes ({}){}, {}", passes.count(), passes.text(),
      open ? fmt::format(" and a part of pass {}", *open) : "",
      passes_add_up(file) ? "to be resumed or merged" : "to be resumed; they depend on each other");
}

/// "name: text", or its lines below the name.
std::string entry(std::string_view name, const std::string& text) {
  if (text.find('\n') == std::string::npos) return fmt::format("{}: {}\n", name, text);
  std::string lines = fmt::format("{}:\n", name);
  for (size_t begin = 0; begin < text.size();) {
    const size_t end = std::min(text.find('\n', begin), text.size());
    lines += fmt::format("  {}\n", text.substr(begin, end - begin));
    begin = end + 1;
  }
  return lines;
}

}  // namespace

bool is_picture(const std::string& path) {
  constexpr std::array<char, 4> kMagic = {0x76, 0x2f, 0x31, 0x01};
  std::array<char, 4> first{};
  return std::ifstream(path, std::ios::binary).read(first.data(), first.size()) && first == kMagic;
}

std::string description_of_picture(const std::string& path) {
  const StateFile file(path);
  const Vec2i full = file.resolution();
  const PixelBounds window = file.window();
  std::string text = fmt::format("picture: {}\nresolution: {}x{}\n", path, full.x, full.y);
  if (window != PixelBounds{0, 0, full.x, full.y})
    text +=
        fmt::format("crop: x {} to {}, y {} to {}\n", window.x0, window.x1, window.y0, window.y1);
  text += fmt::format("state: {}\n", state_line(file));
  for (const auto& [key, value] : file.metadata())
    if (key.starts_with(kKeyPrefix) && key != kLayoutKey)
      text += entry(std::string_view(key).substr(kKeyPrefix.size()), value);
  return text;
}

}  // namespace nephroid
