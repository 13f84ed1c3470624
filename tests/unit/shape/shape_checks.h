// Checks for every shape: sampling densities, derivatives and error bounds. It sees a shape through
// its interface only.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <vector>

#include "scene/shape/shape.h"

namespace nephroid::testing {

/// A small generator for tests (SplitMix64).
class Random {
 public:
  explicit Random(uint64_t seed) : state_(seed) {}
  float unit() { return static_cast<float>(next() >> 40) * 0x1p-24f; }
  float in(float a, float b) { return a + (b - a) * unit(); }
  Vec2f square() {
    const float x = unit();
    return {x, unit()};
  }
  Vec3f direction();
  Vec3f in_box(float half);
  /// A rotation by random Euler angles.
  Mat44d rotation();

 private:
  uint64_t next();
  uint64_t state_;
};

/// The shape's surface at a parameter: fill() without a ray.
SurfaceInteraction surface_at(const Shape& shape, uint32_t primitive, const Vec2f& hit_uv);

/// The part of the unit square that parametrizes the primitive (the covered share of the grid cell
/// around a point), and the hit_uv of a parameter.
struct Parameters {
  std::function<double(const Vec2f&)> share = [](const Vec2f&) { return 1.0; };
  std::function<Vec2f(const Vec2f&)> hit_uv = [](const Vec2f& uv) { return uv; };
};
/// Parameters of a triangle without texture coordinates: corners (0,0), (1,0), (1,1).
Parameters triangle_parameters();

/// Samples by area. Compares the histogram over the parameters with 1/pdf_a and the area element.
void check_area_sampling(const Shape& shape, uint32_t primitive, const Parameters& parameters = {});
/// The same for sample_towards. The expected histogram follows from pdf_towards.
void check_direction_sampling(const Shape& shape, uint32_t primitive, const Vec3f& from,
                              const Parameters& parameters = {});
/// Mean of 1/pdf_w over n^2 stratified samples of sample_towards: the covered solid angle, if every
/// point of the primitive is visible from `from`.
double mean_solid_angle(const Shape& shape, uint32_t primitive, const Vec3f& from, int n);
/// Monte Carlo estimate of the area: mean of 1/pdf_a.
double mean_area(const Shape& shape, uint32_t primitive, int n);
/// Compares dpdu, dpdv, dndu, dndv with central differences. `scale` is a typical length.
void check_derivatives(const Shape& shape, uint32_t primitive, const Vec2f& uv, float scale);
/// Rays that leave a hit never hit a flat shape again, on either side, nor a `convex` one on its
/// outside. `around` is a point near the shape, `size` its typical size. Returns the number of hits
/// tested.
int check_no_self_hits(const Shape& shape, const Vec3f& around, float size, bool convex,
                       Random& random);

}  // namespace nephroid::testing
