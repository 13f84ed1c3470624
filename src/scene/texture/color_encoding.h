// How stored numbers of an image stand for linear values: linear, sRGB or a power law.
// Who calls it: the image reader and the image texture, which gets the encoding's name from a
// scene. It must not know files.
#pragma once

#include <array>
#include <compare>
#include <optional>
#include <string>

namespace nephroid {

struct ColorEncoding {
  enum class Kind { kLinear, kSrgb, kGamma };
  Kind kind = Kind::kLinear;
  float gamma = 1.0f;  ///< of kGamma: linear = stored^gamma

  static ColorEncoding linear() { return {}; }
  static ColorEncoding srgb() { return {Kind::kSrgb, 1.0f}; }
  /// "linear", "sRGB" or "gamma X" with X > 0; empty for anything else.
  static std::optional<ColorEncoding> parse(const std::string& name);

  /// Linear value of a stored one in [0,1].
  float decode(float stored) const;
  /// Linear values of the stored bytes 0..255.
  std::array<float, 256> byte_table() const;

  auto operator<=>(const ColorEncoding&) const = default;
};

}  // namespace nephroid
