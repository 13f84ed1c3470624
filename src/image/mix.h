// Mixes a picture anew from its layers: the light of lamps and routes times gains, without
// rendering. It must not know command lines, scenes or how layers are made.
#pragma once

#include <string>
#include <vector>

#include "core/color.h"
#include "film/image_io.h"
#include "film/layers_by_light.h"

namespace nephroid {

/// Factor of a light or a route.
struct MixGain {
  std::string name;
  Rgb gain{1, 1, 1};
  /// True if the factors of red, green and blue differ: an approximation, as light has a spectrum.
  bool is_tint() const { return gain.r != gain.g || gain.g != gain.b; }
};

/// Gains of a picture. What is not named keeps gain 1.
struct Mix {
  std::vector<MixGain> lights, routes;
  bool empty() const { return lights.empty() && routes.empty(); }
};

/// Parses "NAME=GAIN" or "NAME=R,G,B", numbers from 0. `option` begins the message. Throws
/// UsageError.
MixGain parse_mix_gain(const std::string& option, const std::string& text);

/// The layers of a picture that can be mixed: each list adds up to the picture.
struct MixLayers {
  std::vector<std::string> routes;
  std::vector<LayerByLight> by_light;            ///< one layer for each light
  std::vector<LayerByLight> by_route_and_light;  ///< one layer for each route and light
};
MixLayers mix_layers(const PictureHead& picture);

/// The reasons why a mix differs from a render with those gains; empty if it is exact.
std::vector<std::string> inexact_mix_reasons(bool clamps_samples, bool rejects_outliers);
/// The same for a picture with these metadata.
std::vector<std::string> inexact_mix_reasons(const Metadata& picture);

/// The picture with R G B as the sum of its layers times their gains. It keeps the layers that were
/// added, times their gains, so that they add up again; layers of routes if they are known; and
/// albedo, normals, positions, depth and samples. All other layers belong to the picture before
/// the mix and are left out. Lists all gains in the metadata, multiplied by those of an earlier
/// mix. Throws UsageError if the picture lacks the layers, or a light or route of that name.
Picture mixed(const Picture& picture, const Mix& mix);

}  // namespace nephroid
