#include "film/layers_by_light.h"

#include <optional>
#include <sstream>
#include <string_view>

namespace nephroid {
namespace {

constexpr std::string_view kEquals = " = ", kRoute = "route ", kAnd = ", ", kLight = "light ";

/// The text before `separator`, which is taken from `rest` with it. Empty if there is none.
std::optional<std::string> take_until(std::string_view& rest, std::string_view separator) {
  const size_t end = rest.find(separator);
  if (end == std::string_view::npos) return std::nullopt;
  std::string before(rest.substr(0, end));
  rest.remove_prefix(end + separator.size());
  return before;
}

std::optional<LayerByLight> parse_line(std::string_view rest) {
  LayerByLight layer;
  const std::optional<std::string> name = take_until(rest, kEquals);
  if (!name) return std::nullopt;
  layer.layer = *name;
  if (rest.starts_with(kRoute)) {
    rest.remove_prefix(kRoute.size());
    const std::optional<std::string> route = take_until(rest, kAnd);
    if (!route) return std::nullopt;
    layer.route = *route;
  }
  if (!rest.starts_with(kLight)) return std::nullopt;
  layer.light = rest.substr(kLight.size());
  return layer;
}

}  // namespace

std::string layers_by_light_text(std::span<const LayerByLight> layers) {
  std::string text;
  for (const LayerByLight& layer : layers) {
    text.append(layer.layer).append(kEquals);
    if (!layer.route.empty()) text.append(kRoute).append(layer.route).append(kAnd);
    text.append(kLight).append(layer.light).append("\n");
  }
  return text;
}

std::vector<LayerByLight> parse_layers_by_light(const std::string& text) {
  std::vector<LayerByLight> layers;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (std::optional<LayerByLight> layer = parse_line(line)) layers.push_back(*std::move(layer));
  return layers;
}

}  // namespace nephroid
