// Texture class "dots": a disc of radius 0.35 in about half of the unit cells around the integer
// points of (s,t), shifted within its cell. Noise decides which cells and how far.
#include "scene/texture/noise.h"
#include "scene/texture/texture_mapping.h"
#include "scene/texture/texture_table.h"

namespace nephroid {

namespace {

constexpr float kRadius = 0.35f;
/// Largest shift that keeps the disc in its cell.
constexpr float kLargestShift = 0.5f - kRadius;

float plane_noise(float x, float y) {
  return noise(Vec3f(x, y, 0.5f));
}

bool is_in_dot(const Vec2f& st) {
  const float s = std::floor(st.x + 0.5f), t = std::floor(st.y + 0.5f);
  if (!(plane_noise(s + 0.5f, t + 0.5f) > 0.0f)) return false;
  const float ds = st.x - (s + kLargestShift * plane_noise(s + 1.5f, t + 2.8f));
  const float dt = st.y - (t + kLargestShift * plane_noise(s + 4.5f, t + 9.8f));
  return ds * ds + dt * dt < kRadius * kRadius;
}

/// Parameters of the dots and of the rest. They look swapped, but in pbrt-v4 the discs show
/// "outside" and the rest "inside", and scenes must look the same here.
constexpr const char* kOfDots = "outside";
constexpr const char* kOfRest = "inside";
constexpr float kDefaultOfDots = 0.0f, kDefaultOfRest = 1.0f;

class DotsFloatTexture final : public FloatTexture {
 public:
  DotsFloatTexture(const TextureDescription& description, FloatTexturePtr dots,
                   FloatTexturePtr rest)
      : mapping_(description), dots_(std::move(dots)), rest_(std::move(rest)) {}
  float eval(const TextureContext& context) const override {
    return (is_in_dot(mapping_.map(context)) ? dots_ : rest_)->eval(context);
  }
  TextureDetail detail() const override { return dots_->detail().and_also(rest_->detail()); }

 private:
  TextureMapping2D mapping_;
  FloatTexturePtr dots_, rest_;
};

class DotsSpectrumTexture final : public SpectrumTexture {
 public:
  DotsSpectrumTexture(const TextureDescription& description, SpectrumTexturePtr dots,
                      SpectrumTexturePtr rest)
      : mapping_(description), dots_(std::move(dots)), rest_(std::move(rest)) {}
  SampledSpectrum eval(const TextureContext& context,
                       const SampledWavelengths& lambda) const override {
    return (is_in_dot(mapping_.map(context)) ? dots_ : rest_)->eval(context, lambda);
  }

 private:
  TextureMapping2D mapping_;
  SpectrumTexturePtr dots_, rest_;
};

}  // namespace

FloatTexturePtr make_float_dots(const TextureDescription& description, TextureScope& scope) {
  const ParameterSet& p = description.parameters;
  return std::make_shared<DotsFloatTexture>(description,
                                            scope.float_texture(p, kOfDots, kDefaultOfDots),
                                            scope.float_texture(p, kOfRest, kDefaultOfRest));
}

SpectrumTexturePtr make_spectrum_dots(const TextureDescription& description, SpectrumKind kind,
                                      TextureScope& scope) {
  const ParameterSet& p = description.parameters;
  return std::make_shared<DotsSpectrumTexture>(
      description, scope.spectrum_texture(p, kOfDots, kind, kDefaultOfDots),
      scope.spectrum_texture(p, kOfRest, kind, kDefaultOfRest));
}

}  // namespace nephroid
