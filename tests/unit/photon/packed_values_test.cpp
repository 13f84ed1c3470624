// Errors of packed values.
#include "photon/packed_values.h"

#include <gtest/gtest.h>

namespace nephroid {
namespace {

uint32_t next(uint32_t& x) {
  return x = x * 1664525u + 1013904223u;
}
float number(uint32_t& x) {
  return static_cast<float>(next(x) >> 8) * 0x1p-24f;
}

TEST(PackedSpectrum, KeepsTheMeanAndEachValueToItsSteps) {
  uint32_t x = 1;
  double packed = 0, exact = 0;
  for (int k = 0; k < 10000; ++k) {
    SampledSpectrum s;
    const float scale = std::exp2(std::floor(number(x) * 100 - 50));
    for (int i = 0; i < kSpectrumSamples; ++i) s.set(i, number(x) * scale);
    const SampledSpectrum found = PackedSpectrum(s).unpacked();
    for (int i = 0; i < kSpectrumSamples; ++i) {
      ASSERT_NEAR(found[i], s[i], s.max_component() * (0.51f / 65535));
      packed += static_cast<double>(found[i] / scale);
      exact += static_cast<double>(s[i] / scale);
    }
  }
  EXPECT_NEAR(packed / exact, 1, 1e-6);
}

TEST(PackedSpectrum, WhatIsNoLightAndWhatIsNotFinite) {
  EXPECT_TRUE(PackedSpectrum(SampledSpectrum()).unpacked().is_black());
  EXPECT_EQ(PackedSpectrum(SampledSpectrum(0.3f)).unpacked(), SampledSpectrum(0.3f));
  SampledSpectrum s(1.0f);
  s.set(3, kInfinity);
  EXPECT_FALSE(PackedSpectrum(s).unpacked().is_finite());
  s.set(3, std::nanf(""));
  EXPECT_FALSE(PackedSpectrum(s).unpacked().is_finite());
}

TEST(PackedDirection, IsWithinItsSteps) {
  uint32_t x = 2;
  for (int k = 0; k < 100000; ++k) {
    const float z = 2 * number(x) - 1, phi = 2 * kPi * number(x);
    const float r = std::sqrt(std::max(0.0f, 1 - z * z));
    const Vec3f v = normalize(Vec3f(r * std::cos(phi), r * std::sin(phi), z));
    const Vec3f found = PackedDirection(v).unpacked();
    ASSERT_LT(cross(found, v).length(), 7e-5f) << v.x << ' ' << v.y << ' ' << v.z;
    ASSERT_GT(dot(found, v), 0.0f);
  }
  for (const Vec3f& axis : {Vec3f(1, 0, 0), Vec3f(0, 1, 0), Vec3f(0, 0, 1), Vec3f(-1, 0, 0),
                            Vec3f(0, -1, 0), Vec3f(0, 0, -1)})
    EXPECT_EQ(PackedDirection(axis).unpacked(), axis);
}

}  // namespace
}  // namespace nephroid
