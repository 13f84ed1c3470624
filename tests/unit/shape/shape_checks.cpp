// Implementation of the checks for every shape.
#include "shape_checks.h"

namespace nephroid::testing {
namespace {

constexpr int kBins = 8, kCells = 48, kSamples = 40000;

/// Upper quantile of the chi-square distribution for a tail of 1e-5 (Wilson & Hilferty).
double chi_square_limit(int degrees) {
  const double n = degrees, z = 4.265;
  const double c = 1.0 - 2.0 / (9.0 * n) + z * std::sqrt(2.0 / (9.0 * n));
  return n * c * c * c;
}

size_t bin_of(const Vec2f& uv) {
  const int x = std::min(kBins - 1, static_cast<int>(uv.x * kBins));
  const int y = std::min(kBins - 1, static_cast<int>(uv.y * kBins));
  return static_cast<size_t>(y * kBins + x);
}

using Density = std::function<double(const SurfaceInteraction&)>;

std::vector<double> expected_histogram(const Shape& shape, uint32_t primitive,
                                       const Parameters& parameters, const Density& pdf_a) {
  constexpr int kGrid = kBins * kCells;
  std::vector<double> expected(kBins * kBins, 0.0);
  for (int y = 0; y < kGrid; ++y)
    for (int x = 0; x < kGrid; ++x) {
      const Vec2f uv((static_cast<float>(x) + 0.5f) / kGrid,
                     (static_cast<float>(y) + 0.5f) / kGrid);
      const double share = parameters.share(uv);
      if (share == 0.0) continue;
      const SurfaceInteraction s = surface_at(shape, primitive, parameters.hit_uv(uv));
      const double element = length(cross(s.dpdu, s.dpdv));
      expected[bin_of(uv)] += share * pdf_a(s) * element / (kGrid * kGrid);
    }
  return expected;
}

void compare(const std::vector<double>& expected, const std::vector<int>& found, int samples) {
  double total = 0.0, chi2 = 0.0, rare_expected = 0.0, rare_found = 0.0;
  int degrees = -1;
  const auto add = [&](double e, double f) {
    chi2 += (f - e) * (f - e) / e;
    ++degrees;
  };
  for (size_t i = 0; i < expected.size(); ++i) {
    total += expected[i];
    const double e = expected[i] * samples;
    if (e >= 10.0) {
      add(e, found[i]);
    } else {
      rare_expected += e;
      rare_found += found[i];
    }
  }
  if (rare_expected >= 10.0)
    add(rare_expected, rare_found);
  else
    EXPECT_LE(rare_found, rare_expected + 8.0 * std::sqrt(rare_expected + 1.0));
  // The integrated density jumps at the rim of the visible part: the error is about 1/grid.
  EXPECT_NEAR(total, 1.0, 4e-3);
  EXPECT_LT(chi2, chi_square_limit(degrees)) << degrees << " degrees of freedom";
}

}  // namespace

uint64_t Random::next() {
  state_ += 0x9e3779b97f4a7c15ull;
  uint64_t z = state_;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
  return z ^ (z >> 31);
}

Vec3f Random::direction() {
  const float z = in(-1.0f, 1.0f), phi = in(0.0f, 2.0f * kPi), r = safe_sqrt(1.0f - z * z);
  return {r * std::cos(phi), r * std::sin(phi), z};
}

Vec3f Random::in_box(float half) {
  const float x = in(-half, half), y = in(-half, half);
  return {x, y, in(-half, half)};
}

Mat44d Random::rotation() {
  Mat44d m;
  m.rotate(Vec3d(in(0.0f, 2.0f * kPi), in(0.0f, 2.0f * kPi), in(0.0f, 2.0f * kPi)));
  return m;
}

SurfaceInteraction surface_at(const Shape& shape, uint32_t primitive, const Vec2f& hit_uv) {
  Ray none;
  none.o = Vec3f(0, 0, 0);
  none.d = Vec3f(0, 0, 0);
  SurfaceInteraction s;
  shape.fill(primitive, hit_uv, none, 0.0f, s);
  return s;
}

Parameters triangle_parameters() {
  return {[](const Vec2f& uv) { return uv.y < uv.x    ? 1.0
                                       : uv.y == uv.x ? 0.5
                                                      : 0.0; },
          [](const Vec2f& uv) { return Vec2f(uv.x - uv.y, uv.y); }};
}

void check_area_sampling(const Shape& shape, uint32_t primitive, const Parameters& parameters) {
  Random random(11);
  std::vector<int> found(kBins * kBins, 0);
  // Non-uniform densities are estimated from the samples: the mean of 1/pdf is the area of a bin.
  std::vector<double> inverse_pdf(kBins * kBins, 0.0);
  for (int i = 0; i < kSamples; ++i) {
    const auto s = shape.sample_area(primitive, random.square());
    ASSERT_TRUE(s);
    ASSERT_GT(s->pdf, 0.0f);
    ++found[bin_of(s->uv)];
    inverse_pdf[bin_of(s->uv)] += 1.0 / s->pdf / kSamples;
  }
  const std::vector<double> areas = expected_histogram(
      shape, primitive, parameters, [](const SurfaceInteraction&) { return 1.0; });
  double total = 0.0;
  for (const double a : areas) total += a;
  for (size_t i = 0; i < areas.size(); ++i) {
    if (found[i] < 50) continue;
    // Binomial noise of the count. 1/pdf varies little within a bin.
    EXPECT_NEAR(inverse_pdf[i] / areas[i], 1.0, 5.0 / std::sqrt(found[i]) + 0.02) << "bin " << i;
  }
  EXPECT_NEAR(shape.area(primitive) / total, 1.0, 2e-3);
}

void check_direction_sampling(const Shape& shape, uint32_t primitive, const Vec3f& from,
                              const Parameters& parameters) {
  Random random(12);
  std::vector<int> found(kBins * kBins, 0);
  for (int i = 0; i < kSamples; ++i) {
    const auto s = shape.sample_towards(primitive, from, random.square());
    if (!s) continue;
    ASSERT_TRUE(std::isfinite(s->pdf) && is_finite(s->p));
    ++found[bin_of(s->uv)];
    const float again = shape.pdf_towards(primitive, from, s->p, s->ng);
    ASSERT_NEAR(again / s->pdf, 1.0f, 1e-4f) << "sample " << i;
  }
  const auto expected =
      expected_histogram(shape, primitive, parameters, [&](const SurfaceInteraction& s) {
        const Vec3f d = s.p - from;
        const double l2 = dot(d, d);
        return shape.pdf_towards(primitive, from, s.p, s.ng) * abs_dot(d, s.ng) /
               (l2 * std::sqrt(l2));
      });
  compare(expected, found, kSamples);
}

namespace {

template <class Sample>
double mean_inverse_pdf(int n, const Sample& sample) {
  double sum = 0.0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const float inverse = 1.0f / static_cast<float>(n);
      const auto s = sample(Vec2f((static_cast<float>(i) + 0.5f) * inverse,
                                  (static_cast<float>(j) + 0.5f) * inverse));
      if (s) sum += 1.0 / s->pdf;
    }
  return sum / (double(n) * n);
}

}  // namespace

double mean_solid_angle(const Shape& shape, uint32_t primitive, const Vec3f& from, int n) {
  return mean_inverse_pdf(n,
                          [&](const Vec2f& u) { return shape.sample_towards(primitive, from, u); });
}

double mean_area(const Shape& shape, uint32_t primitive, int n) {
  return mean_inverse_pdf(n, [&](const Vec2f& u) { return shape.sample_area(primitive, u); });
}

void check_derivatives(const Shape& shape, uint32_t primitive, const Vec2f& uv, float scale) {
  constexpr float kStep = 1.0f / 512.0f;
  const SurfaceInteraction s = surface_at(shape, primitive, uv);
  const auto check = [&](const Vec2f& step, const Vec3f& dp, const Vec3f& dn) {
    const SurfaceInteraction a = surface_at(shape, primitive, uv - step);
    const SurfaceInteraction b = surface_at(shape, primitive, uv + step);
    const Vec3f by_p = (b.p - a.p) * (0.5f / kStep) - dp;
    const Vec3f by_n = (b.shading.z - a.shading.z) * (0.5f / kStep) - dn;
    // Third derivatives of a full turn are (2 pi)^3. Times step^2 / 6 this is 2e-4 of the size.
    EXPECT_LT(length(by_p), 1e-3f * scale);
    EXPECT_LT(length(by_n), 2e-3f * (1.0f + length(dn)));
  };
  check(Vec2f(kStep, 0), s.dpdu, s.dndu);
  check(Vec2f(0, kStep), s.dpdv, s.dndv);
  EXPECT_NEAR(length(s.ng), 1.0f, 1e-6f);
  EXPECT_NEAR(dot(s.shading.x, s.shading.z), 0.0f, 1e-6f);
}

int check_no_self_hits(const Shape& shape, const Vec3f& around, float size, bool convex,
                       Random& random) {
  int hits = 0;
  Ray ray;
  ray.o = around + random.direction() * (size * random.in(1.5f, 20.0f));
  ray.d = (around + random.in_box(0.5f * size) - ray.o) * random.in(0.1f, 10.0f);
  for (uint32_t primitive = 0; primitive < shape.primitive_count(); ++primitive) {
    const auto hit = shape.intersect(primitive, ray, 0.0f);
    if (!hit) continue;
    SurfaceInteraction s;
    shape.fill(primitive, hit->uv, ray, hit->t, s);
    EXPECT_TRUE(is_finite(s.p) && is_finite(s.p_error) && is_finite(s.ng));
    ++hits;
    for (int i = 0; i < 8; ++i) {
      Ray leaving;
      leaving.d = random.direction();
      if (i % 2 == 1) {
        // Almost grazing.
        const Vec3f along = cross(s.ng, leaving.d);
        leaving.d = along + s.ng * random.in(-1e-5f, 1e-5f);
      }
      const bool outwards = dot(leaving.d, s.ng) >= 0.0f;
      if (convex && !outwards) leaving.d = -leaving.d;
      leaving.o = s.spawn_origin(leaving.d);
      const auto again = shape.intersect(primitive, leaving, 0.0f);
      EXPECT_FALSE(again) << "t = " << again->t << " size " << size << " at " << around;
    }
  }
  return hits;
}

}  // namespace nephroid::testing
