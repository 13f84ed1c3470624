// The isotropic point light.
#include "core/warps.h"
#include "scene/light/light_table.h"

namespace nephroid {

namespace {

class PointLight final : public Light {
 public:
  PointLight(const Vec3f& p, const EmissionSpectrum& intensity) : p_(p), intensity_(intensity) {}

  bool is_delta() const override { return true; }

  std::optional<LightSample> sample_towards(const Vec3f& from, const Vec2f&,
                                            const SampledWavelengths& lambda) const override {
    const Vec3f d = p_ - from;
    const float d2 = length_squared(d);
    if (!(d2 > 0.0f)) return std::nullopt;
    LightSample s;
    s.radiance = intensity_.sample(lambda) / d2;
    s.wi = normalize(d);
    s.pdf_w = 1.0f;
    s.p = p_;
    s.delta = true;
    return s;
  }

  float pdf_towards(const Vec3f&, const Vec3f&, const Vec3f&, const Vec3f&) const override {
    return 0.0f;
  }

  std::optional<EmissionSample> sample_emission(const Vec2f&, const Vec2f& u_direction,
                                                const SampledWavelengths& lambda) const override {
    EmissionSample e;
    e.ray.o = p_;
    e.ray.d = square_to_sphere(u_direction);
    e.radiance = intensity_.sample(lambda);
    e.pdf_a = 1.0f;
    e.pdf_w = kInv4Pi;
    return e;
  }

  EmissionDensity emission_pdf(const Vec3f&, const Vec3f&) const override {
    return {1.0f, kInv4Pi};
  }

  float power() const override { return 4.0f * kPi * intensity_.mean(); }

  std::optional<LightBounds> bounds() const override {
    LightBounds b;
    b.bounds = Bounds3f(p_);
    b.power = kPi * intensity_.mean();
    b.cos_theta_o = -1.0f;
    b.cos_theta_e = 0.0f;
    return b;
  }

 private:
  Vec3f p_;
  EmissionSpectrum intensity_;
};

}  // namespace

LightPtr make_point_light(const LightDescription& description, const LightScope& scope) {
  const ParameterSet& p = description.parameters;
  const EmissionColor e = read_emission(p, "I", scope.files, scope.color_space);
  const float power = p.get_float("power", -1.0f);
  const float scale = power > 0.0f ? e.scale * power / (4.0f * kPi) : e.scale;
  const Transform to_world(description.transform.start);
  const Vec3f from = p.get_point3("from").value_or(Vec3f(0.0f));
  return std::make_unique<PointLight>(to_world.point(from), EmissionSpectrum(*e.spectrum, scale));
}

}  // namespace nephroid
