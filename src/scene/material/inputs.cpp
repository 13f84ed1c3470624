// Reads the inputs of materials; see inputs.h.
#include "scene/material/inputs.h"

namespace nephroid {

SpectrumInput read_spectrum(const TextureLibrary& textures, const ParameterSet& parameters,
                            const std::string& name, SpectrumKind kind, float fallback) {
  SpectrumTexturePtr texture = textures.spectrum_texture(parameters, name, kind);
  if (!texture) texture = constant_spectrum_texture(constant_spectrum(fallback));
  return SpectrumInput(std::move(texture));
}

RoughnessInput::RoughnessInput(const TextureLibrary& textures, const ParameterSet& parameters,
                               const std::string& prefix, bool remap)
    : remap_(remap) {
  const FloatTexturePtr both = textures.float_texture(parameters, prefix + "roughness", 0.0f);
  FloatTexturePtr u = textures.float_texture(parameters, prefix + "uroughness");
  FloatTexturePtr v = textures.float_texture(parameters, prefix + "vroughness");
  u_ = FloatInput(u ? u : both);
  v_ = FloatInput(v ? v : both);
  for (const char* name : {"roughness", "uroughness", "vroughness"}) {
    const Parameter* number = parameters.find(prefix + name, {"float"});
    if (number && !(number->numbers[0] >= 0.0))
      throw SceneError(number->where,
                       "\"" + prefix + name + "\" is negative, expected a roughness of at least 0");
  }
  if (u_.constant() && v_.constant()) constant_ = facets(*u_.constant(), *v_.constant());
}

TrowbridgeReitz RoughnessInput::facets(float u, float v) const {
  if (!remap_) return {u, v};
  return {TrowbridgeReitz::roughness_to_alpha(u), TrowbridgeReitz::roughness_to_alpha(v)};
}

ClassMask RoughnessInput::possible_classes(const SpecularBand& band) const {
  if (!constant_) return ClassMask::kGlossy | ClassMask::kSpecular;
  return mask_of(constant_->event_class(band.low)) | mask_of(constant_->event_class(band.high));
}

IndexInput::IndexInput(const ParameterSet& parameters, const std::string& name, SceneFiles& files) {
  if (const Parameter* number = parameters.find(name, {"float"})) {
    if (number->numbers.size() != 1)
      throw SceneError(number->where, "\"" + name + "\" has " +
                                          std::to_string(number->numbers.size()) +
                                          " numbers, expected one refractive index");
    constant_ = static_cast<float>(number->numbers[0]);
  } else if (const Parameter* spectrum = parameters.find(name, {"spectrum", "rgb", "blackbody"})) {
    spectrum_ = spectrum_from_parameter(*spectrum, SpectrumKind::kUnbounded, files);
    if (spectrum_->is_constant()) constant_ = spectrum_->max_value();
  } else if (const Parameter* other = parameters.find(name)) {
    throw SceneError(other->where, "\"" + name + "\" is of type " + other->type +
                                       ", expected a float or a spectrum");
  } else {
    constant_ = 1.5f;
  }
  if (constant_ && *constant_ == 0.0f) constant_ = 1.0f;
  if (constant_ && !(*constant_ > 0.0f))
    throw SceneError(parameters.find(name)->where,
                     "\"" + name + "\" is a negative refractive index, expected a positive one");
}

float IndexInput::at_hero(SampledWavelengths& lambda) const {
  if (constant_) return *constant_;
  const float eta = (*spectrum_)(lambda.hero());
  lambda.terminate_secondary();
  return eta == 0.0f || eta == 1.0f ? 1.0f + 1e-6f : eta;
}

SampledSpectrum IndexInput::at(const SampledWavelengths& lambda) const {
  if (constant_) return SampledSpectrum(*constant_);
  return spectrum_->sample(lambda).map([](float eta) { return eta == 0.0f ? 1.0f : eta; });
}

}  // namespace nephroid
