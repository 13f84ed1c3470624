// The gains of a mixed picture as text in its metadata. It must not know pictures.
#pragma once

#include <string>
#include <vector>

#include "image/mix.h"

namespace nephroid {

/// A gain and its kind, "light" or "route".
struct KindOfGain {
  std::string kind;
  MixGain gain;
};
using MixGains = std::vector<KindOfGain>;

/// One gain a line: "light key = 2" or "route caustic = 1, 0.9, 0.8 (tint: an RGB approximation)".
std::string mix_text(const MixGains& gains);

/// The gains of such a text. Lines of another form are left out.
MixGains parse_mix_text(const std::string& text);

/// The gains of two mixes, one after the other.
MixGains product(const MixGains& first, const MixGains& second);

}  // namespace nephroid
