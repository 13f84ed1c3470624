// The distant light: parallel light from one direction, like a sun without extent; with an angle it
// is the light of sun_light.cpp.
#include "core/warps.h"
#include "scene/light/infinite_emission.h"
#include "scene/light/light_table.h"

namespace nephroid {

namespace {

class DistantLight final : public Light {
 public:
  /// `to_light` is the unit direction towards the light.
  DistantLight(const Vec3f& to_light, const EmissionSpectrum& irradiance)
      : to_light_(to_light), irradiance_(irradiance) {}

  bool is_delta() const override { return true; }
  bool is_infinite() const override { return true; }
  bool emits_through_disk() const override { return true; }

  std::optional<LightSample> sample_towards(const Vec3f& from, const Vec2f&,
                                            const SampledWavelengths& lambda) const override {
    LightSample s;
    s.radiance = irradiance_.sample(lambda);
    s.wi = to_light_;
    s.pdf_w = 1.0f;
    s.p = point_outside(from, to_light_, sphere_);
    s.delta = true;
    s.infinite = true;
    return s;
  }

  float pdf_towards(const Vec3f&, const Vec3f&, const Vec3f&, const Vec3f&) const override {
    return 0.0f;
  }

  std::optional<EmissionSample> sample_emission(const Vec2f& u_position, const Vec2f&,
                                                const SampledWavelengths& lambda) const override {
    return emission_through_disk(-to_light_, 1.0f, irradiance_.sample(lambda), u_position, sphere_);
  }

  EmissionDensity emission_pdf(const Vec3f&, const Vec3f&) const override {
    return {disk_pdf_a(sphere_), 1.0f};
  }

  float power() const override { return irradiance_.mean() * kPi * sqr(sphere_.radius); }
  std::optional<LightBounds> bounds() const override { return std::nullopt; }
  void set_scene_sphere(const SceneSphere& sphere) override { sphere_ = sphere; }

 private:
  Vec3f to_light_;
  EmissionSpectrum irradiance_;  ///< irradiance on a surface that faces the light
  SceneSphere sphere_;
};

}  // namespace

LightPtr make_distant_light(const LightDescription& description, const LightScope& scope) {
  const ParameterSet& p = description.parameters;
  const EmissionColor e = read_emission(p, "L", scope.files, scope.color_space);
  const Vec3f from = p.get_point3("from").value_or(Vec3f(0.0f));
  const Vec3f to = p.get_point3("to").value_or(Vec3f(0, 0, 1));
  if (from == to)
    throw SceneError(
        description.where,
        "\"from\" and \"to\" of a distant light are the same point, expected two different points");
  const float illuminance = p.get_float("illuminance", -1.0f);
  const float scale = illuminance > 0.0f ? e.scale * illuminance : e.scale;
  const Transform to_world(description.transform.start);
  const Vec3f to_light = normalize(to_world.vector(normalize(from - to)));
  const float angle = p.get_float("angle", 0.0f);
  if (!(angle >= 0 && angle <= 180))
    throw SceneError(p.find("angle")->where,
                     "\"angle\" of a distant light must be a number from 0 to 180 degrees");
  if (angle > 0) return make_sun_light(to_light, angle * kPi / 180, *e.spectrum, scale);
  return std::make_unique<DistantLight>(to_light, EmissionSpectrum(*e.spectrum, scale));
}

}  // namespace nephroid
