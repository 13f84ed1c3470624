// Texture class "mix": linear interpolation of two textures by a third.
#include "scene/texture/texture_table.h"

namespace nephroid {

namespace {

class MixedFloatTexture final : public FloatTexture {
 public:
  MixedFloatTexture(FloatTexturePtr first, FloatTexturePtr second, FloatTexturePtr amount)
      : first_(std::move(first)), second_(std::move(second)), amount_(std::move(amount)) {}
  float eval(const TextureContext& context) const override {
    const float t = amount_->eval(context);
    // A texture of weight 0 is not evaluated: it can be expensive or not finite.
    if (t == 0.0f) return first_->eval(context);
    if (t == 1.0f) return second_->eval(context);
    return lerp(t, first_->eval(context), second_->eval(context));
  }
  TextureDetail detail() const override {
    return first_->detail().and_also(second_->detail()).and_also(amount_->detail());
  }

 private:
  FloatTexturePtr first_, second_, amount_;
};

class MixedSpectrumTexture final : public SpectrumTexture {
 public:
  MixedSpectrumTexture(SpectrumTexturePtr first, SpectrumTexturePtr second, FloatTexturePtr amount)
      : first_(std::move(first)), second_(std::move(second)), amount_(std::move(amount)) {}
  SampledSpectrum eval(const TextureContext& context,
                       const SampledWavelengths& lambda) const override {
    const float t = amount_->eval(context);
    if (t == 0.0f) return first_->eval(context, lambda);
    if (t == 1.0f) return second_->eval(context, lambda);
    return lerp(t, first_->eval(context, lambda), second_->eval(context, lambda));
  }

 private:
  SpectrumTexturePtr first_, second_;
  FloatTexturePtr amount_;
};

}  // namespace

FloatTexturePtr make_float_mix(const TextureDescription& description, TextureScope& scope) {
  const FloatTexturePtr first = scope.float_texture(description.parameters, "tex1", 0.0f);
  const FloatTexturePtr second = scope.float_texture(description.parameters, "tex2", 1.0f);
  const FloatTexturePtr amount = scope.float_texture(description.parameters, "amount", 0.5f);
  const MixedFloatTexture mixed(first, second, amount);
  if (first->constant() && second->constant() && amount->constant())
    return constant_float_texture(mixed.eval(TextureContext()));
  return std::make_shared<MixedFloatTexture>(mixed);
}

SpectrumTexturePtr make_spectrum_mix(const TextureDescription& description, SpectrumKind kind,
                                     TextureScope& scope) {
  return std::make_shared<MixedSpectrumTexture>(
      scope.spectrum_texture(description.parameters, "tex1", kind, 0.0f),
      scope.spectrum_texture(description.parameters, "tex2", kind, 1.0f),
      scope.float_texture(description.parameters, "amount", 0.5f));
}

}  // namespace nephroid
