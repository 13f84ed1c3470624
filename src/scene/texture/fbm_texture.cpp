// Pure noise textures, float only: "fbm" (a sum of octaves), "wrinkled" (a sum of their absolute
// values) and "windy" (waves whose height follows a coarser noise).
#include <algorithm>
#include <cmath>

#include "scene/texture/noise.h"
#include "scene/texture/texture_mapping.h"
#include "scene/texture/texture_table.h"

namespace nephroid {

namespace {

/// Each octave is about twice as fine as the one before, whose details are of unit size.
TextureDetail detail_of(const TextureMapping3D& mapping, int octaves) {
  return mapping.detail(std::ldexp(1.0f, std::clamp(octaves, 1, 16) - 1));
}

class FractalNoiseTexture final : public FloatTexture {
 public:
  explicit FractalNoiseTexture(const TextureDescription& description)
      : mapping_(description), parameters_(read_noise_parameters(description.parameters)) {}
  float eval(const TextureContext& context) const override {
    return fractal_noise(mapping_.map(context), mapping_.footprint(context), parameters_.roughness,
                         parameters_.octaves);
  }
  TextureDetail detail() const override { return detail_of(mapping_, parameters_.octaves); }

 private:
  TextureMapping3D mapping_;
  NoiseParameters parameters_;
};

class WrinkledTexture final : public FloatTexture {
 public:
  explicit WrinkledTexture(const TextureDescription& description)
      : mapping_(description), parameters_(read_noise_parameters(description.parameters)) {}
  float eval(const TextureContext& context) const override {
    return turbulence(mapping_.map(context), mapping_.footprint(context), parameters_.roughness,
                      parameters_.octaves);
  }
  TextureDetail detail() const override { return detail_of(mapping_, parameters_.octaves); }

 private:
  TextureMapping3D mapping_;
  NoiseParameters parameters_;
};

class WindyTexture final : public FloatTexture {
 public:
  explicit WindyTexture(const TextureDescription& description) : mapping_(description) {}
  float eval(const TextureContext& context) const override {
    constexpr float kWindScale = 0.1f, kRoughness = 0.5f;
    constexpr int kWindOctaves = 3;
    const Vec3f p = mapping_.map(context);
    const NoiseFootprint f = mapping_.footprint(context);
    const float wind =
        fractal_noise(p * kWindScale, f.scaled(kWindScale), kRoughness, kWindOctaves);
    return std::abs(wind) * fractal_noise(p, f, kRoughness, kWaveOctaves);
  }
  TextureDetail detail() const override { return detail_of(mapping_, kWaveOctaves); }

 private:
  static constexpr int kWaveOctaves = 6;
  TextureMapping3D mapping_;
};

}  // namespace

FloatTexturePtr make_float_fbm(const TextureDescription& description, TextureScope&) {
  return std::make_shared<FractalNoiseTexture>(description);
}

FloatTexturePtr make_float_wrinkled(const TextureDescription& description, TextureScope&) {
  return std::make_shared<WrinkledTexture>(description);
}

FloatTexturePtr make_float_windy(const TextureDescription& description, TextureScope&) {
  return std::make_shared<WindyTexture>(description);
}

}  // namespace nephroid
