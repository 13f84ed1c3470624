// Which layers of a picture hold the light of which lamp, as text in its metadata. It must not know
// scenes or how such layers are made.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace nephroid {

/// A layer with the light of one lamp, or of one lamp by one route.
struct LayerByLight {
  std::string layer;
  std::string route;  ///< empty: of all routes
  std::string light;
  bool operator==(const LayerByLight&) const = default;
};

/// One layer a line: "key = light key" or "caustic_key = route caustic, light key".
std::string layers_by_light_text(std::span<const LayerByLight> layers);

/// The layers of such a text. Lines of another form are left out.
std::vector<LayerByLight> parse_layers_by_light(const std::string& text);

}  // namespace nephroid
