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

/// The root of a number whose imaginary part is not negative: light fades below the film. Takes a
/// third of the time of std::sqrt, which looks after infinities.
inline std::complex<float> upper_root(std::complex<float> z) {
  const float larger = std::sqrt(0.5f * (std::sqrt(std::norm(z)) + std::abs(z.real())));
  const float smaller = larger > 0.0f ? 0.5f * z.imag() / larger : 0.0f;
  return z.real() < 0.0f ? std::complex<float>(smaller, larger)
                         : std::complex<float>(larger, smaller);
}

/// Share of one polarisation that a film reflects. `a`, `b` and `c` are the admittances above, in
/// and below it; `turn` is the phase of a way down and up. It is the Airy sum times the
/// denominators of Fresnel's amplitudes, since divisions of complex numbers are slow.
template <class Admittance>
float airy_reflectance(float a, Admittance b, std::complex<float> c, std::complex<float> turn) {
  const std::complex<float> above = b + c, below = (b - c) * turn;
  return std::norm((a - b) * above + (a + b) * below) /
         std::norm((a + b) * above + (a - b) * below);
}

/// Share of unpolarised flux that a film on a base of index `base` = eta + i k reflects at cosine
/// `c` above the film, at wavelength `lambda` in nm.
inline float thin_film_reflectance(float c, const ThinFilm& film, std::complex<float> base,
                                   float lambda) {
  using Complex = std::complex<float>;
  const float sin2 = std::max(0.0f, 1.0f - c * c);
  const float film_2 = film.index * film.index, normal_2 = film_2 - sin2;
  const Complex base_2 = base * base;
  // Components of the wave vectors along the normal, for light polarised across the plane.
  const Complex below = upper_root(base_2 - sin2);
  const Complex below_parallel = below * std::conj(base_2) * (film_2 / std::norm(base_2));
  const float k = 4.0f * kPi * film.thickness / lambda;
  const auto mean = [&](auto in_film, Complex turn) {
    return 0.5f * (airy_reflectance(c, in_film, below, turn) +
                   airy_reflectance(film_2 * c, in_film, below_parallel, turn));
  };
  const float normal = std::sqrt(std::abs(normal_2));
  // Light that the film's own surface turns back fades in it.
  const float r = normal_2 > 0.0f ? mean(normal, std::polar(1.0f, k * normal))
                                  : mean(Complex(0.0f, normal), Complex(std::exp(-k * normal)));
  return r < 1.0f ? std::max(r, 0.0f) : 1.0f;  // 1 where 0/0: grazing
}

}  // namespace nephroid
