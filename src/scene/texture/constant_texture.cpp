// Texture class "constant", and constant textures for plain parameter values.
#include "scene/texture/texture_table.h"

namespace nephroid {

namespace {

class ConstantFloatTexture final : public FloatTexture {
 public:
  explicit ConstantFloatTexture(float value) : value_(value) {}
  float eval(const TextureContext&) const override { return value_; }
  std::optional<float> constant() const override { return value_; }

 private:
  float value_;
};

class ConstantSpectrumTexture final : public SpectrumTexture {
 public:
  explicit ConstantSpectrumTexture(SpectrumPtr spectrum) : spectrum_(std::move(spectrum)) {}
  SampledSpectrum eval(const TextureContext&, const SampledWavelengths& lambda) const override {
    return spectrum_->sample(lambda);
  }
  SpectrumPtr constant() const override { return spectrum_; }

 private:
  SpectrumPtr spectrum_;
};

}  // namespace

FloatTexturePtr constant_float_texture(float value) {
  return std::make_shared<ConstantFloatTexture>(value);
}

SpectrumTexturePtr constant_spectrum_texture(SpectrumPtr spectrum) {
  return std::make_shared<ConstantSpectrumTexture>(std::move(spectrum));
}

FloatTexturePtr make_float_constant(const TextureDescription& description, TextureScope&) {
  return constant_float_texture(description.parameters.get_float("value", 1.0f));
}

SpectrumTexturePtr make_spectrum_constant(const TextureDescription& description, SpectrumKind kind,
                                          TextureScope& scope) {
  const Parameter* value = description.parameters.find("value");
  if (!value) return constant_spectrum_texture(constant_spectrum(1.0f));
  return constant_spectrum_texture(spectrum_from_parameter(*value, kind, scope.files()));
}

}  // namespace nephroid
