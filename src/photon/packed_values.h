// Packed spectra and directions: half of the memory or less, so that more photons fit and merging
// moves fewer bytes. It must not know photons.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/spectrum.h"

namespace nephroid {

/// A spectrum as one scale and 16 bits per wavelength. The error is unbiased and at most 1/131070
/// of the largest value. Values must not be negative; a spectrum that is not finite stays so.
class PackedSpectrum {
 public:
  PackedSpectrum() = default;
  explicit PackedSpectrum(const SampledSpectrum& s) {
    const float largest = s.max_component();
    if (!s.is_finite()) {
      scale_ = std::numeric_limits<float>::quiet_NaN();
      return;
    }
    if (!(largest > 0.0f)) return;
    scale_ = largest * (1.0f / kMaxCode);
    const float inverse = kMaxCode / largest;
    for (int i = 0; i < kSpectrumSamples; ++i)
      values_[static_cast<size_t>(i)] =
          static_cast<uint16_t>(std::max(0.0f, s[i]) * inverse + 0.5f);
  }
  SampledSpectrum unpacked() const {
    SampledSpectrum s;
    for (int i = 0; i < kSpectrumSamples; ++i)
      s.set(i, static_cast<float>(values_[static_cast<size_t>(i)]));
    return s * scale_;
  }
  bool operator==(const PackedSpectrum&) const = default;
  static void members(auto& self, auto& archive) {
    for (auto& value : self.values_) archive(value);
    archive(self.scale_);
  }

 private:
  static constexpr float kMaxCode = 65535.0f;
  std::array<uint16_t, kSpectrumSamples> values_{};
  float scale_ = 0;
};

/// A unit vector in two 16-bit numbers, the octahedral map of Meyer et al. 2010 (oct32 of Cigolle
/// et al. 2014). The error is less than 7e-5 radians.
class PackedDirection {
 public:
  PackedDirection() = default;
  explicit PackedDirection(const Vec3f& v) {
    const float sum = std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
    float x = v.x / sum, y = v.y / sum;
    if (v.z < 0.0f) {
      const float folded = (1.0f - std::abs(y)) * sign(x);
      y = (1.0f - std::abs(x)) * sign(y);
      x = folded;
    }
    x_ = static_cast<int16_t>(std::lrint(x * kMaxCode));
    y_ = static_cast<int16_t>(std::lrint(y * kMaxCode));
  }
  Vec3f unpacked() const {
    float x = static_cast<float>(x_) * (1.0f / kMaxCode),
          y = static_cast<float>(y_) * (1.0f / kMaxCode);
    const float z = 1.0f - std::abs(x) - std::abs(y);
    if (z < 0.0f) {
      const float unfolded = (1.0f - std::abs(y)) * sign(x);
      y = (1.0f - std::abs(x)) * sign(y);
      x = unfolded;
    }
    return normalize(Vec3f(x, y, z));
  }
  bool operator==(const PackedDirection&) const = default;
  static void members(auto& self, auto& archive) { archive(self.x_, self.y_); }

 private:
  static constexpr float kMaxCode = 32767.0f;
  static float sign(float x) { return x < 0.0f ? -1.0f : 1.0f; }
  int16_t x_ = 0, y_ = 0;
};

}  // namespace nephroid
