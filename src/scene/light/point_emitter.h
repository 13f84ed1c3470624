// Base class of lights that emit from one point with an intensity that depends on direction.
// Derived classes provide that intensity and its sampling. It must not know images.
#pragma once

#include "scene/light/direction_map.h"
#include "scene/light/light.h"

namespace nephroid {

class PointEmitter : public Light {
 public:
  bool is_delta() const final { return true; }

  std::optional<LightSample> sample_towards(const Vec3f& from, const Vec2f&,
                                            const SampledWavelengths& lambda) const final {
    const Vec3f d = p_ - from;
    const float d2 = length_squared(d);
    if (!(d2 > 0.0f)) return std::nullopt;
    LightSample s;
    s.wi = normalize(d);
    s.radiance = intensity(map_.to_local(-s.wi), lambda) / d2;
    if (s.radiance.is_black()) return std::nullopt;
    s.pdf_w = 1.0f;
    s.p = p_;
    s.delta = true;
    return s;
  }

  float pdf_towards(const Vec3f&, const Vec3f&, const Vec3f&, const Vec3f&) const final {
    return 0.0f;
  }

  EmissionDensity emission_pdf(const Vec3f&, const Vec3f& w) const final {
    const Vec3f local = map_.to_local(w);
    return {1.0f, direction_pdf(local) / map_.jacobian(local)};
  }

  std::optional<LightBounds> bounds() const final { return bounds_; }

 protected:
  /// Sets the point of `bounds_.bounds`. The rest of `bounds_` says that light goes everywhere.
  explicit PointEmitter(const Transform& local_to_world)
      : p_(local_to_world.point(Vec3f(0.0f))), map_(local_to_world) {
    bounds_.bounds = Bounds3f(p_);
  }

  /// Power per solid angle in the unit direction `local`.
  virtual SampledSpectrum intensity(const Vec3f& local, const SampledWavelengths&) const = 0;

  /// Density of the directions of sample_emission in the local frame, 1/sr.
  virtual float direction_pdf(const Vec3f& local) const = 0;

  /// A ray in unit direction `local`, which was sampled with density `pdf_w` in the local frame.
  /// Empty if the density underflows, where other directions are brighter by 30 orders of
  /// magnitude.
  std::optional<EmissionSample> emission(const Vec3f& local, float pdf_w,
                                         const SampledSpectrum& radiance) const {
    EmissionSample e;
    e.ray.o = p_;
    e.ray.d = map_.to_world(local);
    e.radiance = radiance;
    e.pdf_a = 1.0f;
    e.pdf_w = pdf_w / map_.jacobian(local);
    if (!(e.pdf_w > 0.0f)) return std::nullopt;
    return e;
  }

  Vec3f p_;
  DirectionMap map_;
  LightBounds bounds_;
};

}  // namespace nephroid
