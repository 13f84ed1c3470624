// Texture class "vertexcolor": the colours that a mesh has at its vertices, times a factor; not in
// pbrt-v4. White on surfaces without such colours.
#include "scene/texture/rgb_spectrum.h"
#include "scene/texture/texture_table.h"

namespace nephroid {
namespace {

class VertexColorTexture final : public SpectrumTexture {
 public:
  VertexColorTexture(const Rgb& factor, SpectrumKind kind) : factor_(factor), kind_(kind) {}
  SampledSpectrum eval(const TextureContext& context,
                       const SampledWavelengths& lambda) const override {
    return spectrum_of(product(context.vertex_rgb(), factor_), RgbColorSpace::srgb(), kind_,
                       lambda);
  }

 private:
  Rgb factor_;
  SpectrumKind kind_;
};

class VertexChannelTexture final : public FloatTexture {
 public:
  VertexChannelTexture(int channel, float scale, std::optional<float> cutoff)
      : channel_(channel), scale_(scale), cutoff_(cutoff) {}
  float eval(const TextureContext& context) const override {
    return after_cutoff(scale_ * context.vertex_channel(channel_), cutoff_);
  }

 private:
  int channel_;
  float scale_;
  std::optional<float> cutoff_;
};

}  // namespace

FloatTexturePtr make_float_vertexcolor(const TextureDescription& description, TextureScope&) {
  const ParameterSet& p = description.parameters;
  return std::make_shared<VertexChannelTexture>(read_channel(p).value_or(0),
                                                p.get_float("scale", 1.0f), read_cutoff(p));
}

SpectrumTexturePtr make_spectrum_vertexcolor(const TextureDescription& description,
                                             SpectrumKind kind, TextureScope&) {
  return std::make_shared<VertexColorTexture>(read_factor(description.parameters), kind);
}

}  // namespace nephroid
