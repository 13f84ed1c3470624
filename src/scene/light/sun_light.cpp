// The distant light with an angle: equal radiance from a small cap of directions, like the disk of
// the sun. It must not know the atmosphere.
#include "core/warps.h"
#include "scene/light/infinite_emission.h"
#include "scene/light/light_table.h"

namespace nephroid {

namespace {

/// A cap of directions around an axis.
class DirectionCap {
 public:
  DirectionCap(const Vec3f& axis, float half_angle)
      : frame_(Frame::from_z(axis)), height_(2 * sqr(std::sin(half_angle / 2))) {}

  /// 1/sr of uniform directions.
  float pdf_w() const { return kInv2Pi / height_; }
  /// |w - axis|^2 = 2 (1 - cos), without the rounding of the cosine.
  bool contains(const Vec3f& w) const { return length_squared(w - frame_.z) <= 2 * height_; }
  Vec3f sample(const Vec2f& u) const {
    const Vec2f disk = square_to_disk(u);
    const float r2 = disk.x * disk.x + disk.y * disk.y;
    // Lambert's equal-area map: 1 - cos is proportional to r^2.
    const float below = height_ * r2, stretch = safe_sqrt(height_ * (2 - below));
    return normalize(frame_.x * (disk.x * stretch) + frame_.y * (disk.y * stretch) +
                     frame_.z * (1 - below));
  }
  /// Integral of the cosine with the axis over the cap.
  float projected_solid_angle() const { return kPi * height_ * (2 - height_); }
  const Vec3f& axis() const { return frame_.z; }

 private:
  Frame frame_;
  float height_;  ///< 1 - cos of the half angle
};

class SunLight final : public Light {
 public:
  SunLight(const DirectionCap& cap, const EmissionSpectrum& radiance)
      : cap_(cap), radiance_(radiance) {}

  bool is_infinite() const override { return true; }
  bool emits_through_disk() const override { return true; }

  std::optional<LightSample> sample_towards(const Vec3f& from, const Vec2f& u,
                                            const SampledWavelengths& lambda) const override {
    LightSample s;
    s.radiance = radiance_.sample(lambda);
    s.wi = cap_.sample(u);
    s.pdf_w = cap_.pdf_w();
    s.p = point_outside(from, s.wi, sphere_);
    s.infinite = true;
    return s;
  }

  float pdf_towards(const Vec3f&, const Vec3f& wi, const Vec3f&, const Vec3f&) const override {
    return cap_.contains(wi) ? cap_.pdf_w() : 0.0f;
  }

  SampledSpectrum radiance_at_infinity(const Vec3f&, const Vec3f& w,
                                       const SampledWavelengths& lambda) const override {
    return cap_.contains(w) ? radiance_.sample(lambda) : SampledSpectrum();
  }

  std::optional<EmissionSample> sample_emission(const Vec2f& u_position, const Vec2f& u_direction,
                                                const SampledWavelengths& lambda) const override {
    return emission_through_disk(-cap_.sample(u_direction), cap_.pdf_w(), radiance_.sample(lambda),
                                 u_position, sphere_);
  }

  EmissionDensity emission_pdf(const Vec3f&, const Vec3f& w) const override {
    return {disk_pdf_a(sphere_), cap_.contains(-w) ? cap_.pdf_w() : 0.0f};
  }

  float power() const override {
    return radiance_.mean() / cap_.pdf_w() * kPi * sqr(sphere_.radius);
  }
  std::optional<LightBounds> bounds() const override { return std::nullopt; }
  void set_scene_sphere(const SceneSphere& sphere) override { sphere_ = sphere; }

 private:
  DirectionCap cap_;
  EmissionSpectrum radiance_;
  SceneSphere sphere_;
};

}  // namespace

LightPtr make_sun_light(const Vec3f& to_light, float angle, const Spectrum& spectrum,
                        float irradiance) {
  const DirectionCap cap(to_light, angle / 2);
  return std::make_unique<SunLight>(
      cap, EmissionSpectrum(spectrum, irradiance / cap.projected_solid_angle()));
}

}  // namespace nephroid
