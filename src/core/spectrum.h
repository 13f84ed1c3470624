// Radiometric values at a few wavelengths, carried along a path together with the wavelengths (hero
// wavelength sampling, Wilkie et al. 2014; pbrt-v4 chapter 4). It must not know where spectra come
// from.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/math.h"

namespace nephroid {

/// Wavelengths per path. Eight fill one AVX register; docs/measurements/wavelengths.md has the
/// comparison with 4.
inline constexpr int kSpectrumSamples = 8;

inline constexpr float kLambdaMin = 360.0f;  ///< nm
inline constexpr float kLambdaMax = 830.0f;  ///< nm

/// One value per wavelength of a path. Plain value type; arithmetic is per wavelength.
class SampledSpectrum {
 public:
  using Lanes = float __attribute__((vector_size(kSpectrumSamples * sizeof(float))));

  SampledSpectrum() : v_{} {}
  explicit SampledSpectrum(float c) : v_(Lanes{} + c) {}
  explicit SampledSpectrum(Lanes v) : v_(v) {}

  float operator[](int i) const { return v_[i]; }
  void set(int i, float x) { v_[i] = x; }
  Lanes lanes() const { return v_; }

  SampledSpectrum operator+(const SampledSpectrum& o) const { return SampledSpectrum(v_ + o.v_); }
  SampledSpectrum operator-(const SampledSpectrum& o) const { return SampledSpectrum(v_ - o.v_); }
  SampledSpectrum operator*(const SampledSpectrum& o) const { return SampledSpectrum(v_ * o.v_); }
  SampledSpectrum operator/(const SampledSpectrum& o) const { return SampledSpectrum(v_ / o.v_); }
  SampledSpectrum operator*(float c) const { return SampledSpectrum(v_ * c); }
  SampledSpectrum operator/(float c) const { return SampledSpectrum(v_ * (1.0f / c)); }
  SampledSpectrum operator-() const { return SampledSpectrum(-v_); }
  friend SampledSpectrum operator*(float c, const SampledSpectrum& s) { return s * c; }
  SampledSpectrum& operator+=(const SampledSpectrum& o) { return v_ += o.v_, *this; }
  SampledSpectrum& operator-=(const SampledSpectrum& o) { return v_ -= o.v_, *this; }
  SampledSpectrum& operator*=(const SampledSpectrum& o) { return v_ *= o.v_, *this; }
  SampledSpectrum& operator*=(float c) { return v_ *= c, *this; }
  SampledSpectrum& operator/=(float c) { return v_ *= 1.0f / c, *this; }
  bool operator==(const SampledSpectrum& o) const {
    for (int i = 0; i < kSpectrumSamples; ++i)
      if (v_[i] != o.v_[i]) return false;
    return true;
  }

  /// True if every value is exactly zero.
  bool is_black() const {
    bool any = false;
    for (int i = 0; i < kSpectrumSamples; ++i) any |= v_[i] != 0.0f;
    return !any;
  }
  bool is_finite() const {
    bool all = true;
    for (int i = 0; i < kSpectrumSamples; ++i) all &= std::isfinite(v_[i]);
    return all;
  }
  float max_component() const {
    float m = v_[0];
    for (int i = 1; i < kSpectrumSamples; ++i) m = std::max(m, v_[i]);
    return m;
  }
  float sum() const {
    float s = 0.0f;
    for (int i = 0; i < kSpectrumSamples; ++i) s += v_[i];
    return s;
  }
  float average() const { return sum() * (1.0f / kSpectrumSamples); }

  static void members(auto& self, auto& archive) {
    for (int i = 0; i < kSpectrumSamples; ++i) {
      float value = self.v_[i];
      archive(value);
      if constexpr (!std::is_const_v<std::remove_reference_t<decltype(self)>>) self.v_[i] = value;
    }
  }

  /// Applies fn to each value.
  template <class F>
  SampledSpectrum map(F&& fn) const {
    SampledSpectrum r;
    for (int i = 0; i < kSpectrumSamples; ++i) r.v_[i] = fn(v_[i]);
    return r;
  }

 private:
  Lanes v_;
};

inline SampledSpectrum sqrt(const SampledSpectrum& s) {
  return s.map([](float x) { return std::sqrt(std::max(0.0f, x)); });
}
inline SampledSpectrum exp(const SampledSpectrum& s) {
  return s.map([](float x) { return std::exp(x); });
}
inline SampledSpectrum clamp(const SampledSpectrum& s, float lo, float hi) {
  return s.map([lo, hi](float x) { return std::min(std::max(x, lo), hi); });
}
inline SampledSpectrum lerp(float t, const SampledSpectrum& a, const SampledSpectrum& b) {
  return a * (1.0f - t) + b * t;
}
/// a / b, and 0 where b is 0.
inline SampledSpectrum safe_div(const SampledSpectrum& a, const SampledSpectrum& b) {
  SampledSpectrum r;
  for (int i = 0; i < kSpectrumSamples; ++i) r.set(i, b[i] != 0.0f ? a[i] / b[i] : 0.0f);
  return r;
}

/// Means all wavelengths of a path, where else the index of one is given.
inline constexpr int kAllWavelengths = -1;

/// The wavelengths of one path (nm) and the density of each (1/nm). One of them is the hero, by
/// default the first: it survives where wavelengths separate, as in a prism.
class SampledWavelengths {
 public:
  /// kSpectrumSamples wavelengths at equal steps of a cumulative distribution, rotated by u in
  /// [0,1). Its density is such that white light has nearly the same colour for every u
  /// (docs/adr/0046-wavelengths-are-a-quadrature.md).
  static SampledWavelengths sample_visible(float u);
  /// Density of sample_visible at `lambda`, in 1/nm; zero outside [360, 830] nm.
  static float visible_pdf(float lambda);

  float lambda(int i) const { return lambda_[i]; }
  const SampledSpectrum& lambdas() const { return lambda_; }
  /// Zero for wavelengths that were dropped.
  const SampledSpectrum& pdf() const { return pdf_; }

  /// The same wavelengths with another hero, of index `hero`; none may have been dropped yet. Paths
  /// that share their wavelengths have different heroes, so that one pass shows all colours of a
  /// prism.
  SampledWavelengths with_hero(int hero) const {
    SampledWavelengths s = *this;
    s.hero_ = hero;
    return s;
  }
  float hero() const { return lambda_[hero_]; }

  /// Keeps the hero only. Its density is divided by kSpectrumSamples, so the mean over all
  /// wavelengths (sum / kSpectrumSamples) stays unbiased. A second call has no effect.
  void terminate_secondary();
  bool secondary_terminated() const { return left_ != kAllWavelengths; }
  /// Index of the hero if it is the only wavelength left, else kAllWavelengths.
  int left() const { return left_; }
  /// The value with zeros at dropped wavelengths.
  SampledSpectrum of_left(const SampledSpectrum& s) const {
    if (left_ == kAllWavelengths) return s;
    SampledSpectrum hero;
    hero.set(left_, s[left_]);
    return hero;
  }

 private:
  SampledSpectrum lambda_;
  SampledSpectrum pdf_;
  int hero_ = 0;
  int left_ = kAllWavelengths;
};

}  // namespace nephroid
