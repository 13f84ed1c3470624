// Texture class "marble": layers across the texture's y axis, perturbed by noise and coloured by a
// spline. Always a reflectance; spectrum values only.
#include <algorithm>
#include <array>

#include "scene/texture/noise.h"
#include "scene/texture/texture_mapping.h"
#include "scene/texture/texture_table.h"

namespace nephroid {

namespace {

/// Control points of pbrt-v4's marble colours; each four successive points form a Bezier segment.
constexpr std::array<Rgb, 9> kColours = {{{.58f, .58f, .6f},
                                          {.58f, .58f, .6f},
                                          {.58f, .58f, .6f},
                                          {.5f, .5f, .5f},
                                          {.6f, .59f, .58f},
                                          {.58f, .58f, .6f},
                                          {.58f, .58f, .6f},
                                          {.2f, .2f, .33f},
                                          {.58f, .58f, .6f}}};
constexpr float kBrightness = 1.5f;

/// The colour at t in [0,1]. Segments start one control point apart, not three, so the curve has
/// steps, as in pbrt-v4.
Rgb marble_colour(float t) {
  constexpr int kSegments = static_cast<int>(kColours.size()) - 3;
  const float position = t * static_cast<float>(kSegments);
  const int first = std::clamp(static_cast<int>(position), 0, kSegments - 1);
  const float u = position - static_cast<float>(first), v = 1.0f - u;
  const Rgb* c = &kColours[first];
  const Rgb sum =
      c[0] * (v * v * v) + c[1] * (3 * v * v * u) + c[2] * (3 * v * u * u) + c[3] * (u * u * u);
  return sum * kBrightness;
}

class MarbleTexture final : public SpectrumTexture {
 public:
  explicit MarbleTexture(const TextureDescription& description)
      : mapping_(description),
        parameters_(read_noise_parameters(description.parameters)),
        scale_(description.parameters.get_float("scale", 1.0f)),
        variation_(description.parameters.get_float("variation", 0.2f)) {}

  SampledSpectrum eval(const TextureContext& context,
                       const SampledWavelengths& lambda) const override {
    const Vec3f p = mapping_.map(context) * scale_;
    const float layer =
        p.y + variation_ * fractal_noise(p, mapping_.footprint(context).scaled(scale_),
                                         parameters_.roughness, parameters_.octaves);
    const Rgb colour = marble_colour(0.5f + 0.5f * std::sin(layer));
    return RgbColorSpace::srgb().polynomial(colour).sample(lambda);
  }

 private:
  TextureMapping3D mapping_;
  NoiseParameters parameters_;
  float scale_, variation_;
};

}  // namespace

SpectrumTexturePtr make_spectrum_marble(const TextureDescription& description, SpectrumKind,
                                        TextureScope&) {
  return std::make_shared<MarbleTexture>(description);
}

}  // namespace nephroid
