// The mix that a page shows: R, G and B as the sum of layers times gains, without the rest of a
// picture (image/mix.h). It must not know the server.
#pragma once

#include <string_view>
#include <vector>

#include "film/film.h"
#include "film/image_io.h"
#include "image/mix.h"
#include "view/live_state.h"

namespace nephroid {

/// Factors of layers, by the layer's name; none: the picture itself.
using LayerGains = std::vector<MixGain>;

/// The gains of all layers of a kind, from a request as in parse_mix; what is not named keeps 1.
/// Throws UsageError for a layer that is no route or light, and for routes and lights at once.
LayerGains parse_shown_mix(std::string_view text, const std::vector<LiveLayer>& layers);

/// Throw UsageError if a layer is missing.
Picture mixed_colors(const Film& film, const LayerGains& gains);
Picture mixed_colors(const Picture& picture, const LayerGains& gains);

}  // namespace nephroid
