// Texture class "bilerp": four values at the corners of the unit square of (s,t), with bilinear
// interpolation, also outside of the square.
#include <array>

#include "scene/texture/texture_mapping.h"
#include "scene/texture/texture_table.h"

namespace nephroid {

namespace {

/// Order of the corners: the first digit is s, the second is t.
constexpr std::array<const char*, 4> kCorners = {"v00", "v10", "v01", "v11"};
constexpr std::array<float, 4> kDefaults = {0.0f, 0.0f, 1.0f, 1.0f};

std::array<float, 4> corner_weights(const Vec2f& st) {
  return {(1 - st.x) * (1 - st.y), st.x * (1 - st.y), (1 - st.x) * st.y, st.x * st.y};
}

class BilerpFloatTexture final : public FloatTexture {
 public:
  explicit BilerpFloatTexture(const TextureDescription& description) : mapping_(description) {
    for (size_t i = 0; i < 4; ++i)
      values_[i] = description.parameters.get_float(kCorners[i], kDefaults[i]);
  }
  float eval(const TextureContext& context) const override {
    const std::array<float, 4> weights = corner_weights(mapping_.map(context));
    float sum = 0.0f;
    for (size_t i = 0; i < 4; ++i) sum += weights[i] * values_[i];
    return sum;
  }

 private:
  TextureMapping2D mapping_;
  std::array<float, 4> values_{};
};

class BilerpSpectrumTexture final : public SpectrumTexture {
 public:
  BilerpSpectrumTexture(const TextureDescription& description, SpectrumKind kind, SceneFiles& files)
      : mapping_(description) {
    for (size_t i = 0; i < 4; ++i) {
      const Parameter* p = description.parameters.find(kCorners[i]);
      values_[i] = p ? spectrum_from_parameter(*p, kind, files) : constant_spectrum(kDefaults[i]);
    }
  }
  SampledSpectrum eval(const TextureContext& context,
                       const SampledWavelengths& lambda) const override {
    const std::array<float, 4> weights = corner_weights(mapping_.map(context));
    SampledSpectrum sum;
    for (size_t i = 0; i < 4; ++i) sum += values_[i]->sample(lambda) * weights[i];
    return sum;
  }

 private:
  TextureMapping2D mapping_;
  std::array<SpectrumPtr, 4> values_;
};

}  // namespace

FloatTexturePtr make_float_bilerp(const TextureDescription& description, TextureScope&) {
  return std::make_shared<BilerpFloatTexture>(description);
}

SpectrumTexturePtr make_spectrum_bilerp(const TextureDescription& description, SpectrumKind kind,
                                        TextureScope& scope) {
  return std::make_shared<BilerpSpectrumTexture>(description, kind, scope.files());
}

}  // namespace nephroid
