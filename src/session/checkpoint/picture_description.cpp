#include "session/checkpoint/picture_description.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <functional>
#include <span>
#include <string_view>

#include "core/counted.h"
#include "input/file_bytes.h"
#include "input/scene_files.h"
#include "session/checkpoint/checkpoint.h"
#include "session/checkpoint/film_metadata.h"

namespace nephroid {
namespace {

std::string state_line(const StateFile& file) {
  const PassRanges passes = passes_of(file, "describe it");
  const std::optional<uint32_t> open = open_pass_of(file);
  const char* const use = !passes_add_up(file) ? "to be resumed; they depend on each other"
                          : open               ? "to be resumed (only whole passes can be merged)"
                                               : "to be resumed or merged";
  if (passes.empty() && open) return fmt::format("a part of pass {}, {}", *open, use);
  return fmt::format("{} ({}){}, {}", counted(passes.count(), "pass", "passes"), passes.text(),
                     open ? fmt::format(" and a part of pass {}", *open) : "", use);
}

/// The description of the state beside a picture.
std::string state_line_beside(const std::string& path) {
  const std::string state = state_path_beside(path);
  if (!std::filesystem::exists(state))
    return fmt::format("none, there is no {}: it cannot be resumed or merged", state);
  return fmt::format("{}: {}", state, state_line(StateFile(state)));
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

std::string heading(const std::string& what, const std::string& path, const Vec2i& full,
                    const PixelBounds& window) {
  std::string text = fmt::format("{}: {}\nresolution: {}x{}\n", what, path, full.x, full.y);
  if (window != PixelBounds{0, 0, full.x, full.y})
    text +=
        fmt::format("crop: x {} to {}, y {} to {}\n", window.x0, window.x1, window.y0, window.y1);
  return text;
}

std::string entries(const Metadata& metadata) {
  std::string text;
  for (const auto& [key, value] : metadata)
    if (key.starts_with(kKeyPrefix) && key != kLayoutKey)
      text += entry(std::string_view(key).substr(kKeyPrefix.size()), value);
  return text;
}

/// "R, G, B, N, Z, albedo": the names of the channels, those of a layer once.
std::string layers_of(std::vector<std::string> channels) {
  // Files have their channels by name.
  const auto is_of_picture = [](const std::string& c) { return c == "R" || c == "G" || c == "B"; };
  const auto end = std::stable_partition(channels.begin(), channels.end(), is_of_picture);
  std::sort(channels.begin(), end, std::greater<>());
  std::string text;
  std::vector<std::string_view> listed;
  for (const std::string& channel : channels) {
    const std::string_view layer = std::string_view(channel).substr(0, channel.rfind('.'));
    if (std::ranges::find(listed, layer) != listed.end()) continue;
    text += fmt::format("{}{}", listed.empty() ? "" : ", ", layer);
    listed.push_back(layer);
  }
  return text;
}

}  // namespace

bool is_picture(const std::string& path) {
  namespace fs = std::filesystem;
  // Reading would consume the bytes of a pipe.
  if (path == kStandardInput || is_stream(path)) return false;
  constexpr std::array<char, 4> kMagic = {0x76, 0x2f, 0x31, 0x01};
  std::array<char, 4> begin{};
  std::ifstream(path, std::ios::binary).read(begin.data(), begin.size());
  return begin == kMagic || StateFile::is_state(path) ||
         (fs::path(path).extension() == ".exr" && fs::is_regular_file(path));
}

std::string description_of_picture(const std::string& path) {
  if (StateFile::is_state(path)) {
    const StateFile file(path);
    return heading("state", path, file.resolution(), file.window()) +
           fmt::format("state: {}\n", state_line(file)) + entries(file.metadata());
  }
  const PictureHead head = read_picture_head(path);
  return heading("picture", path, {head.full_width, head.full_height}, head.window) +
         fmt::format("layers: {}\n", layers_of(head.channels)) +
         fmt::format("state: {}\n", state_line_beside(path)) + entries(head.metadata);
}

}  // namespace nephroid
