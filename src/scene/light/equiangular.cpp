#include "scene/light/equiangular.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nephroid {

namespace {

struct Interval {
  double begin = 0, end = 0;
};

/// The part of an interval in which a line is in a cone: t with w + t d at most the half angle of
/// cosine `k` > 0 away from the axis. w_a, d_a: along the axis; w_d, w2: w d and w².
Interval inside_cone(Interval t, double k, double w_a, double d_a, double w_d, double w2) {
  // The double cone is a t² + 2 b t + c >= 0.
  const double a = d_a * d_a - k * k, b = w_a * d_a - k * k * w_d, c = w_a * w_a - k * k * w2;
  const double discriminant = b * b - a * c;
  if (a == 0.0 || discriminant <= 0.0) return a < 0.0 ? Interval{0, 0} : t;
  const double root = std::sqrt(discriminant);
  const double q = b >= 0.0 ? -(b + root) : root - b;
  double low = q / a, high = q != 0.0 ? c / q : 0.0;
  if (low > high) std::swap(low, high);
  if (a < 0.0) {  // Crosses one half of the double cone, the one in front or the one behind.
    if (w_a + 0.5 * (low + high) * d_a < 0.0) return {0, 0};
    return {std::max(t.begin, low), std::min(t.end, high)};
  }
  // Comes from the half behind and goes on in the half in front, or the other way around.
  if (d_a > 0.0) return {std::max(t.begin, high), t.end};
  return {t.begin, std::min(t.end, low)};
}

}  // namespace

Equiangular::Equiangular(const Ray& ray, float t_max, const LightPlace& light) {
  const Vec3d w(ray.o.x - light.center.x, ray.o.y - light.center.y, ray.o.z - light.center.z);
  const Vec3d d(ray.d.x, ray.d.y, ray.d.z);
  const double w_d = w.dot(d), w2 = w.dot(w);
  Interval t{0, static_cast<double>(t_max)};
  if (light.cos_cone > 0.0f && light.radius2 == 0.0f) {
    const Vec3d axis(light.axis.x, light.axis.y, light.axis.z);
    t = inside_cone(t, light.cos_cone, w.dot(axis), d.dot(axis), w_d, w2);
  }
  if (!(t.begin < t.end)) return;
  const double off = std::max(w2 - w_d * w_d, 0.0) + light.radius2;
  // Where the ray hits the light, a small part of the way stands for the distance.
  const double least = 1e-4 * std::sqrt(w2) + 1e-18;
  nearest_ = -w_d;
  distance_ = std::max(std::sqrt(off), least);
  begin_ = t.begin;
  end_ = t.end;
  // The difference of both angles, without the cancellation of a short piece far from the light.
  const double a = begin_ - nearest_;
  angle_ = end_ < kInfinity
               ? std::atan2(distance_ * (end_ - begin_), sqr(distance_) + a * (end_ - nearest_))
               : std::atan2(distance_, a);
}

float Equiangular::sample(float u) const {
  const double a = begin_ - nearest_, sine = std::sin(u * angle_), cosine = std::cos(u * angle_);
  // tan(x + y) - tan(x), times the distance.
  const double way = distance_ * cosine - a * sine;
  const double t = begin_ + (sqr(distance_) + sqr(a)) * sine / way;
  const double last = std::min(end_, double{std::numeric_limits<float>::max()});
  return static_cast<float>(way > 0 ? std::clamp(t, begin_, last) : last);
}

float Equiangular::pdf(float t) const {
  if (!(t >= static_cast<float>(begin_) && t <= static_cast<float>(end_)) || !(angle_ > 0))
    return 0.0f;
  const double off = (t - nearest_) / distance_;
  return static_cast<float>(1 / (angle_ * distance_ * (1 + sqr(off))));
}

}  // namespace nephroid
