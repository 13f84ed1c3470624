// Inputs of materials: textures (constant ones cost nothing per point), roughness and refractive
// index, read from the scene format's parameters. It must not know the lobes made from the values.
#pragma once

#include "scene/bsdf/microfacet.h"
#include "scene/texture/texture.h"

namespace nephroid {

/// A float that can vary over the surface.
class FloatInput {
 public:
  FloatInput() = default;
  explicit FloatInput(FloatTexturePtr texture)
      : texture_(std::move(texture)), constant_(texture_->constant()) {}

  float at(const SurfaceInteraction& point) const {
    return constant_ ? *constant_ : texture_->eval(TextureContext(point));
  }
  std::optional<float> constant() const { return constant_; }

 private:
  FloatTexturePtr texture_;
  std::optional<float> constant_;
};

/// A spectrum that can vary over the surface.
class SpectrumInput {
 public:
  SpectrumInput() = default;
  explicit SpectrumInput(SpectrumTexturePtr texture)
      : texture_(std::move(texture)), constant_(texture_ ? texture_->constant() : nullptr) {}

  bool is_set() const { return texture_ != nullptr; }
  SampledSpectrum at(const SurfaceInteraction& point, const SampledWavelengths& lambda) const {
    return constant_ ? constant_->sample(lambda) : texture_->eval(TextureContext(point), lambda);
  }
  /// True if the value is known to be zero everywhere.
  bool is_black() const { return constant_ && !(constant_->max_value() > 0.0f); }

 private:
  SpectrumTexturePtr texture_;
  SpectrumPtr constant_;
};

/// Reads the parameter `name` as a spectrum texture, by default the constant `fallback`.
SpectrumInput read_spectrum(const TextureLibrary& textures, const ParameterSet& parameters,
                            const std::string& name, SpectrumKind kind, float fallback);

/// Two roughnesses that become microfacet alphas.
class RoughnessInput {
 public:
  RoughnessInput() = default;
  /// Reads PREFIXuroughness and PREFIXvroughness; each defaults to PREFIXroughness, then to 0.
  RoughnessInput(const TextureLibrary& textures, const ParameterSet& parameters,
                 const std::string& prefix, bool remap);

  TrowbridgeReitz at(const SurfaceInteraction& point) const {
    return constant_ ? *constant_ : facets(u_.at(point), v_.at(point));
  }
  std::optional<TrowbridgeReitz> constant() const { return constant_; }
  /// The larger alpha, if it is the same everywhere.
  std::optional<float> constant_alpha() const {
    return constant_ ? std::optional(constant_->max_alpha()) : std::nullopt;
  }
  /// Classes that a lobe with this roughness can have, for any threshold in the band.
  ClassMask possible_classes(const SpecularBand& band) const;

 private:
  TrowbridgeReitz facets(float u, float v) const;

  FloatInput u_, v_;
  bool remap_ = true;
  std::optional<TrowbridgeReitz> constant_;
};

/// The refractive index of a transparent medium.
class IndexInput {
 public:
  IndexInput() = default;
  /// Reads `name` (number, rgb, spectrum), by default 1.5. Throws SceneError for anything else.
  IndexInput(const ParameterSet& parameters, const std::string& name, SceneFiles& files);

  /// The index, if it is the same at all wavelengths.
  std::optional<float> constant() const { return constant_; }
  /// The index at the hero wavelength. If it varies, the other wavelengths are terminated. Never 0,
  /// and exactly 1 (no boundary at all) only if it is 1 at all wavelengths.
  float at_hero(SampledWavelengths& lambda) const;
  float at_550_nm() const { return constant_ ? *constant_ : (*spectrum_)(550.0f); }
  /// The index at each wavelength, none of them 0.
  SampledSpectrum at(const SampledWavelengths& lambda) const;

 private:
  SpectrumPtr spectrum_;
  std::optional<float> constant_;
};

}  // namespace nephroid
