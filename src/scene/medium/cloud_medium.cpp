// A procedural cloud of noise octaves, dense below and wispy above ("cloud"), as defined by
// pbrt-v4's CloudMedium. It must not know rays outside its box.
#include "scene/medium/medium_space.h"
#include "scene/medium/medium_table.h"
#include "scene/texture/noise.h"

namespace nephroid {

namespace {

/// Forward differences of the noise along the axes. The step is part of pbrt-v4's definition of the
/// cloud.
Vec3f noise_slope(const Vec3f& p) {
  constexpr float kStep = 0.01f;
  const float here = noise(p);
  return Vec3f(noise(p + Vec3f(kStep, 0, 0)) - here, noise(p + Vec3f(0, kStep, 0)) - here,
               noise(p + Vec3f(0, 0, kStep)) - here) *
         (1.0f / kStep);
}

struct CloudShape {
  float density = 1, wispiness = 1, frequency = 5;

  /// Density in [0,1] at a point of medium space.
  float at(const Vec3f& p) const;
};

float CloudShape::at(const Vec3f& p) const {
  // The ratio of octaves is slightly off 2, so that their lattices do not coincide.
  constexpr float kFiner = 1.99f;
  Vec3f q = p * frequency;
  if (wispiness > 0.0f) {
    float strength = 0.05f * wispiness, scale = 10.0f;
    for (int octave = 0; octave < 2; ++octave) {
      q += noise_slope(q * scale) * strength;
      strength *= 0.5f;
      scale *= kFiner;
    }
  }
  float sum = 0.0f, weight = 0.5f, scale = 1.0f;
  for (int octave = 0; octave < 5; ++octave) {
    sum += weight * noise(q * scale);
    weight *= 0.5f;
    scale *= kFiner;
  }
  // Thinner with height, filled below.
  const float body = std::clamp((1.0f - p.y) * 4.5f * density * sum, 0.0f, 1.0f);
  return std::clamp(body + 2.0f * std::max(0.0f, 0.5f - p.y), 0.0f, 1.0f);
}

class CloudMedium final : public Medium {
 public:
  CloudMedium(const MediumSpace& space, const Extinction& extinction, HenyeyGreenstein phase,
              const CloudShape& shape)
      : space_(space), extinction_(extinction), phase_(phase), shape_(shape) {
    absorbing_ = !(extinction.sigma_s.max_value() > 0.0f);
  }

  bool is_emissive() const override { return false; }
  bool is_purely_absorbing() const override { return absorbing_; }

  MediumProperties at(const Vec3f& p, const SampledWavelengths& lambda) const override {
    const Vec3d m = space_.to_medium(p);
    // Overflowed coordinates lie outside of the cloud.
    const Vec3f q(static_cast<float>(m.x), static_cast<float>(m.y), static_cast<float>(m.z));
    const float density = is_finite(q * shape_.frequency * 20.0f) ? shape_.at(q) : 0.0f;
    return {extinction_.sigma_a.sample(lambda) * density,
            extinction_.sigma_s.sample(lambda) * density, SampledSpectrum(), phase_};
  }
  MajorantIterator majorants(const Ray& ray, float t_max,
                             const SampledWavelengths& lambda) const override {
    const auto r = space_.overlap(ray, t_max);
    if (!r) return {};
    return MajorantIterator(
        {r->t_min, r->t_max,
         extinction_.sigma_a.sample(lambda) + extinction_.sigma_s.sample(lambda)});
  }

 private:
  MediumSpace space_;
  Extinction extinction_;  ///< extinction at density 1, the maximum
  HenyeyGreenstein phase_;
  CloudShape shape_;
  bool absorbing_;
};

}  // namespace

NewMedium make_cloud_medium(const MediumDescription& description, const MediumScope& scope) {
  const ParameterSet& p = description.parameters;
  const CloudShape shape{p.get_float("density", 1.0f), p.get_float("wispiness", 1.0f),
                         p.get_float("frequency", 5.0f)};
  // Without "scale", which this medium does not have in pbrt-v4.
  return std::make_shared<CloudMedium>(read_medium_box(description),
                                       read_extinction(p, 1.0f, scope.files), read_phase(p), shape);
}

}  // namespace nephroid
