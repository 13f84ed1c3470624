// Reflectance of a thin film between a medium of index 1 and a base, at single wavelengths: the
// Airy sum of all reflections in the film. It must not know roughness. Sources: Born & Wolf,
// Principles of Optics, section 7.6; Belcour & Barla 2017 (films on microfacets).
#pragma once

#include <complex>

#include "core/math.h"

namespace nephroid {

/// Indices are relative to the medium above.
struct ThinFilm {
  float index = 1.4f;
  float thickness = 500.0f;  ///< nm
};

/// Share of unpolarised flux that a film on a base of index `base` = eta + i k reflects at cosine
/// `c` above the film, at wavelength `lambda` in nm.
inline float thin_film_reflectance(float c, const ThinFilm& film, std::complex<float> base,
                                   float lambda) {
  using Complex = std::complex<float>;
  const float sin2 = std::max(0.0f, 1.0f - c * c);
  const auto cosine_in = [sin2](Complex n) { return std::sqrt(1.0f - sin2 / (n * n)); };
  const Complex n1(film.index), c0(c), c1 = cosine_in(n1), c2 = cosine_in(base);
  const Complex phase =
      std::exp(Complex(0.0f, 4.0f * kPi * film.thickness / lambda) * film.index * c1);
  const auto airy = [&](Complex r01, Complex r12) {
    return std::norm((r01 + r12 * phase) / (1.0f + r01 * r12 * phase));
  };
  const auto amplitude = [](Complex a, Complex b) { return (a - b) / (a + b); };
  const float perpendicular = airy(amplitude(c0, n1 * c1), amplitude(n1 * c1, base * c2));
  const float parallel = airy(amplitude(n1 * c0, c1), amplitude(base * c1, n1 * c2));
  const float r = 0.5f * (perpendicular + parallel);
  return r < 1.0f ? std::max(r, 0.0f) : 1.0f;  // 1 where 0/0: grazing
}

}  // namespace nephroid
