// Texture class "scale": a texture times a float texture. As in pbrt-v4, a constant scale of an
// image multiplies the stored values, so it precedes "invert" and the clamping of reflectances to
// 1.
#include "scene/texture/texture_table.h"

namespace nephroid {

namespace {

class ScaledFloatTexture final : public FloatTexture {
 public:
  ScaledFloatTexture(FloatTexturePtr texture, FloatTexturePtr scale)
      : texture_(std::move(texture)), scale_(std::move(scale)) {}
  float eval(const TextureContext& context) const override {
    const float s = scale_->eval(context);
    return s == 0.0f ? 0.0f : s * texture_->eval(context);
  }
  TextureDetail detail() const override { return texture_->detail().and_also(scale_->detail()); }

 private:
  FloatTexturePtr texture_, scale_;
};

class ScaledSpectrumTexture final : public SpectrumTexture {
 public:
  ScaledSpectrumTexture(SpectrumTexturePtr texture, FloatTexturePtr scale)
      : texture_(std::move(texture)), scale_(std::move(scale)) {}
  SampledSpectrum eval(const TextureContext& context,
                       const SampledWavelengths& lambda) const override {
    const float s = scale_->eval(context);
    return s == 0.0f ? SampledSpectrum() : texture_->eval(context, lambda) * s;
  }

 private:
  SpectrumTexturePtr texture_;
  FloatTexturePtr scale_;
};

}  // namespace

FloatTexturePtr make_float_scale(const TextureDescription& description, TextureScope& scope) {
  const FloatTexturePtr texture = scope.float_texture(description.parameters, "tex", 1.0f);
  const FloatTexturePtr scale = scope.float_texture(description.parameters, "scale", 1.0f);
  if (texture->constant() && scale->constant())
    return constant_float_texture(*texture->constant() * *scale->constant());
  // For floats, the two factors can also be swapped.
  for (const auto& [image, factor] : {std::pair(texture, scale), std::pair(scale, texture)}) {
    if (!factor->constant()) continue;
    if (*factor->constant() == 1.0f) return image;
    if (FloatTexturePtr product = image->with_values_times(*factor->constant())) return product;
  }
  return std::make_shared<ScaledFloatTexture>(texture, scale);
}

SpectrumTexturePtr make_spectrum_scale(const TextureDescription& description, SpectrumKind kind,
                                       TextureScope& scope) {
  const SpectrumTexturePtr texture =
      scope.spectrum_texture(description.parameters, "tex", kind, 1.0f);
  const FloatTexturePtr scale = scope.float_texture(description.parameters, "scale", 1.0f);
  if (const auto factor = scale->constant()) {
    if (*factor == 1.0f) return texture;
    if (SpectrumTexturePtr product = texture->with_values_times(*factor)) return product;
  }
  return std::make_shared<ScaledSpectrumTexture>(texture, scale);
}

}  // namespace nephroid
