// The spot light: a point that emits into a cone with a smooth edge, a smoothstep in the cosine.
// Directions are sampled in proportion to the intensity.
#include "scene/light/direction_map.h"
#include "scene/light/light_table.h"

namespace nephroid {

namespace {

double radians(float degrees) {
  return degrees * kDegree;
}

/// Solves 2 x^3 - x^4 = u for x in [0,1]: the inverse cumulative distribution of smoothstep.
/// Newton's method inside a shrinking bracket.
double invert_smoothstep_cdf(double u) {
  double low = 0.0, high = 1.0, x = std::cbrt(0.5 * u);
  for (int i = 0; i < 20; ++i) {
    const double f = x * x * x * (2.0 - x) - u;
    (f < 0.0 ? low : high) = x;
    const double slope = x * x * (6.0 - 4.0 * x);
    const double next = slope > 0.0 ? x - f / slope : low;
    x = next > low && next < high ? next : 0.5 * (low + high);
  }
  return x;
}

class SpotLight final : public Light {
 public:
  /// Angles in degrees from the axis, which is z of the local frame.
  SpotLight(const Transform& local_to_world, const EmissionSpectrum& intensity, float end_angle,
            float start_angle)
      : p_(local_to_world.point(Vec3f(0.0f))), map_(local_to_world), intensity_(intensity) {
    // 1 - cos as 2 sin^2 of the half angle, which keeps precision for narrow cones.
    const double start = 2.0 * sqr(std::sin(0.5 * radians(start_angle)));
    const double end = 2.0 * sqr(std::sin(0.5 * radians(end_angle)));
    inner_ = start;
    edge_ = end - start;
    bounds_.bounds = Bounds3f(p_);
    bounds_.axis = map_.to_world(Vec3f(0, 0, 1));
    bounds_.power = kPi * intensity_.mean();
    bounds_.cos_theta_o = static_cast<float>(1.0 - start);
    // Slightly wider than the edge, for the rounding of angles near 0.
    bounds_.cos_theta_e = std::min(
        static_cast<float>(std::cos(radians(end_angle) - radians(std::abs(start_angle)))), 0.9999f);
    if (!map_.keeps_angles()) {
      // Under a transform that changes angles the cone has no simple bound.
      bounds_.cos_theta_o = -1.0f;
      bounds_.cos_theta_e = 0.0f;
    }
  }

  bool is_delta() const override { return true; }

  std::optional<LightSample> sample_towards(const Vec3f& from, const Vec2f&,
                                            const SampledWavelengths& lambda) const override {
    const Vec3f d = p_ - from;
    const float d2 = length_squared(d);
    if (!(d2 > 0.0f)) return std::nullopt;
    LightSample s;
    s.wi = normalize(d);
    const float f = falloff(map_.to_local(-s.wi));
    if (!(f > 0.0f)) return std::nullopt;
    s.radiance = intensity_.sample(lambda) * (f / d2);
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
    const double total = inner_ + 0.5 * edge_;
    if (!(total > 0.0)) return std::nullopt;
    // 1 - cos: first the uniform cone, then the edge from its inner side outwards.
    const double u = u_direction.x * total;
    double below = u, f = 1.0;
    if (u >= inner_) {
      const double x = invert_smoothstep_cdf(std::max(0.0, 1.0 - (u - inner_) / (0.5 * edge_)));
      f = x * x * (3.0 - 2.0 * x);
      below = inner_ + edge_ * (1.0 - x);
    }
    if (!(f > 0.0)) return std::nullopt;
    const double sine = std::sqrt(std::max(0.0, below * (2.0 - below)));
    const float phi = 2.0f * kPi * u_direction.y;
    const Vec3f local(static_cast<float>(sine) * std::cos(phi),
                      static_cast<float>(sine) * std::sin(phi), static_cast<float>(1.0 - below));
    EmissionSample e;
    e.ray.o = p_;
    e.ray.d = map_.to_world(local);
    e.radiance = intensity_.sample(lambda) * static_cast<float>(f);
    e.pdf_a = 1.0f;
    e.pdf_w = static_cast<float>(f / (total * 2.0 * kPi)) / map_.jacobian(local);
    return e;
  }

  EmissionDensity emission_pdf(const Vec3f&, const Vec3f& w) const override {
    const double total = inner_ + 0.5 * edge_;
    if (!(total > 0.0)) return {};
    const Vec3f local = map_.to_local(w);
    return {1.0f, falloff(local) / static_cast<float>(total * 2.0 * kPi) / map_.jacobian(local)};
  }

  float power() const override {
    return intensity_.mean() * 2.0f * kPi * static_cast<float>(inner_ + 0.5 * edge_);
  }

  std::optional<LightBounds> bounds() const override { return bounds_; }

 private:
  /// Share of the full intensity in unit local direction `local`.
  float falloff(const Vec3f& local) const {
    const double below = 1.0 - local.z - inner_;
    if (below <= 0.0) return 1.0f;
    if (below >= edge_) return 0.0f;
    const double x = 1.0 - below / edge_;
    return static_cast<float>(x * x * (3.0 - 2.0 * x));
  }

  Vec3f p_;
  DirectionMap map_;
  EmissionSpectrum intensity_;
  LightBounds bounds_;
  double inner_ = 0.0;  ///< 1 - cos of the angle where the edge begins
  double edge_ = 0.0;   ///< width of the edge in the cosine
};

/// The frame at `from` that looks towards `to`, row vectors.
Transform look_frame(const Vec3f& from, const Vec3f& to) {
  const Frame f = Frame::from_z(normalize(to - from));
  return Transform(Mat44d(f.x.x, f.x.y, f.x.z, 0, f.y.x, f.y.y, f.y.z, 0, f.z.x, f.z.y, f.z.z, 0,
                          from.x, from.y, from.z, 1));
}

}  // namespace

LightPtr make_spot_light(const LightDescription& description, const LightScope& scope) {
  const ParameterSet& p = description.parameters;
  const EmissionColor e = read_emission(p, "I", scope.files, scope.color_space);
  const float cone = p.get_float("coneangle", 30.0f);
  const float delta = p.get_float("conedeltaangle", 5.0f);
  if (!(cone >= 0.0f && cone <= 180.0f))
    throw SceneError(p.find("coneangle")->where,
                     "the \"coneangle\" of a spot light must lie between 0 and 180 degrees");
  if (!(delta >= 0.0f && delta <= 2.0f * cone))
    throw SceneError(description.where,
                     "the \"conedeltaangle\" of a spot light must lie between 0 and its "
                     "\"coneangle\"");
  const Vec3f from = p.get_point3("from").value_or(Vec3f(0.0f));
  const Vec3f to = p.get_point3("to").value_or(Vec3f(0, 0, 1));
  if (from == to)
    throw SceneError(
        description.where,
        "\"from\" and \"to\" of a spot light are the same point, expected two different points");

  float scale = e.scale;
  const float power = p.get_float("power", -1.0f);
  if (power > 0.0f) {
    const double start = std::cos(radians(cone - delta)), end = std::cos(radians(cone));
    const double per_intensity = 2.0 * kPi * ((1.0 - start) + (start - end) / 2.0);
    scale = scale_to(*p.find("power"), power, per_intensity, scale);
  }
  const Transform to_world = look_frame(from, to) * Transform(description.transform.start);
  return std::make_unique<SpotLight>(to_world, EmissionSpectrum(*e.spectrum, scale), cone,
                                     cone - delta);
}

}  // namespace nephroid
