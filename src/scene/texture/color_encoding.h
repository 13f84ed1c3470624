// Conversion of an image's stored numbers to linear values: linear, sRGB or a power law. It must
// not know files.
#pragma once

#include <array>
#include <compare>
#include <optional>
#include <string>

namespace nephroid {

struct ColorEncoding {
  enum class Kind { kLinear, kSrgb, kGamma };
  Kind kind = Kind::kLinear;
  float gamma = 1.0f;  ///< exponent of kGamma: linear = stored^gamma

  static ColorEncoding linear() { return {}; }
  static ColorEncoding srgb() { return {Kind::kSrgb, 1.0f}; }
  /// Parses "linear", "sRGB" or "gamma X" with X > 0. Empty for anything else.
  static std::optional<ColorEncoding> parse(const std::string& name);

  /// Linear value of a stored one in [0,1].
  float decode(float stored) const;
  /// Linear values of the stored bytes 0..255.
  std::array<float, 256> byte_table() const;

  auto operator<=>(const ColorEncoding&) const = default;
};

}  // namespace nephroid
