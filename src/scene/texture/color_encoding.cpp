// Decoding of stored image values; see color_encoding.h. The sRGB curve is that of IEC 61966-2-1.
#include "scene/texture/color_encoding.h"

#include <cmath>
#include <sstream>

#include "core/srgb.h"

namespace nephroid {

std::optional<ColorEncoding> ColorEncoding::parse(const std::string& name) {
  if (name == "linear") return linear();
  if (name == "sRGB") return srgb();
  std::istringstream words(name);
  words.imbue(std::locale::classic());
  std::string first, rest;
  float gamma = 0.0f;
  if (words >> first >> gamma && first == "gamma" && gamma > 0.0f && std::isfinite(gamma) &&
      !(words >> rest))
    return ColorEncoding{Kind::kGamma, gamma};
  return std::nullopt;
}

float ColorEncoding::decode(float stored) const {
  switch (kind) {
    case Kind::kLinear:
      break;
    case Kind::kSrgb:
      return decode_srgb(stored);
    case Kind::kGamma:
      return std::pow(stored, gamma);
  }
  return stored;
}

std::array<float, 256> ColorEncoding::byte_table() const {
  std::array<float, 256> table;
  for (int i = 0; i < 256; ++i) table[i] = decode(static_cast<float>(i) / 255.0f);
  return table;
}

}  // namespace nephroid
