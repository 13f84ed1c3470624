// The infinite light that is equal in all directions, and the choice between it, an image and a
// portal.
#include "scene/light/infinite_emission.h"
#include "scene/light/light_table.h"

namespace nephroid {

namespace {

class UniformInfiniteLight final : public Light {
 public:
  explicit UniformInfiniteLight(const EmissionSpectrum& radiance) : radiance_(radiance) {}

  bool is_infinite() const override { return true; }
  bool emits_through_disk() const override { return true; }

  std::optional<LightSample> sample_towards(const Vec3f& from, const Vec2f& u,
                                            const SampledWavelengths& lambda) const override {
    LightSample s;
    s.radiance = radiance_.sample(lambda);
    s.wi = square_to_sphere(u);
    s.pdf_w = kInv4Pi;
    s.p = point_outside(from, s.wi, sphere_);
    s.infinite = true;
    return s;
  }

  float pdf_towards(const Vec3f&, const Vec3f&, const Vec3f&, const Vec3f&) const override {
    return kInv4Pi;
  }

  SampledSpectrum radiance_at_infinity(const Vec3f&, const Vec3f&,
                                       const SampledWavelengths& lambda) const override {
    return radiance_.sample(lambda);
  }

  std::optional<EmissionSample> sample_emission(const Vec2f& u_position, const Vec2f& u_direction,
                                                const SampledWavelengths& lambda) const override {
    return emission_through_disk(square_to_sphere(u_direction), kInv4Pi, radiance_.sample(lambda),
                                 u_position, sphere_);
  }

  EmissionDensity emission_pdf(const Vec3f&, const Vec3f&) const override {
    return {disk_pdf_a(sphere_), kInv4Pi};
  }

  float power() const override { return 4.0f * kPi * kPi * sqr(sphere_.radius) * radiance_.mean(); }
  std::optional<LightBounds> bounds() const override { return std::nullopt; }
  void set_scene_sphere(const SceneSphere& sphere) override { sphere_ = sphere; }

 private:
  EmissionSpectrum radiance_;
  SceneSphere sphere_;
};

}  // namespace

LightPtr make_infinite_light(const LightDescription& description, const LightScope& scope) {
  const ParameterSet& p = description.parameters;
  const bool has_portal = !p.get_point3s("portal").empty();
  const bool has_file = !p.get_string("filename", "").empty();
  const Parameter* const faces = p.find("faces", {"string"});
  if (faces && (has_portal || has_file))
    throw SceneError(faces->where, std::string("an infinite light has both \"faces\" and \"") +
                                       (has_file ? "filename" : "portal") +
                                       "\", expected one of them");
  if (has_portal) return make_portal_infinite_light(description, scope);
  if (has_file || faces) return make_image_infinite_light(description, scope);

  const EmissionColor e = read_emission(p, "L", scope.files, scope.color_space);
  const float illuminance = p.get_float("illuminance", -1.0f);
  const float scale = illuminance > 0.0f ? e.scale * illuminance / kPi : e.scale;
  return std::make_unique<UniformInfiniteLight>(EmissionSpectrum(*e.spectrum, scale));
}

}  // namespace nephroid
