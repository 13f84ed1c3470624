// The parts of the principled surface against closed forms and integrals: Fresnel terms, thin
// films, rough diffuse surfaces, and the tables of facets and fuzz.
#include <gtest/gtest.h>

#include <complex>

#include "scene/bsdf/oren_nayar.h"
#include "unit/bsdf/cases.h"
#include "unit/bsdf/statistics.h"

namespace nephroid::testing_bsdf {
namespace {

using S = PrincipledSurface;

TEST(PrincipledFresnel, MetalHasItsColoursAlongTheNormalAndAt82Degrees) {
  const S surface = principled(0.0f, [](S& s) {
    s.metalness = 1.0f;
    s.specular_color = ramp(0.5f, 0.9f);
  });
  const PrincipledFresnel fresnel(surface);
  constexpr float kCosine = 1.0f / 7.0f;
  const float schlick = std::pow(1.0f - kCosine, 5.0f);
  for (int i = 0; i < kSpectrumSamples; ++i) {
    const float r0 = surface.metal_color[i];
    EXPECT_NEAR(fresnel.metal(1.0f)[i], r0, 1e-6f);
    EXPECT_NEAR(fresnel.metal(kCosine)[i], surface.specular_color[i] * (r0 + (1.0f - r0) * schlick),
                1e-5f);
    EXPECT_NEAR(fresnel.metal(0.0f)[i], 1.0f, 1e-6f);
  }
}

TEST(PrincipledFresnel, WeightScalesTheReflectanceAlongTheNormal) {
  const auto along_normal = [](float weight, float ior) {
    return PrincipledFresnel(principled(0.0f,
                                        [&](S& s) {
                                          s.specular_weight = weight;
                                          s.ior = ior;
                                        }))
        .dielectric(1.0f)[0];
  };
  for (const float ior : {0.8f, 1.5f, 2.0f})
    for (const float weight : {0.0f, 0.3f, 2.0f})
      EXPECT_NEAR(along_normal(weight, ior), weight * along_normal(1.0f, ior), 1e-6f);
}

TEST(ThinFilmReflectance, AddsUpTheReflectionsInTheFilm) {
  // The series of amplitudes, for real indices.
  const float n1 = 1.3f, n2 = 1.7f, thickness = 420.0f;
  for (const float c0 : {0.2f, 0.7f, 1.0f}) {
    for (const float lambda : {420.0f, 640.0f}) {
      const double s2 = 1.0 - c0 * c0;
      const double c1 = std::sqrt(1 - s2 / (n1 * n1)), c2 = std::sqrt(1 - s2 / (n2 * n2));
      const double delta = 4 * M_PI * n1 * thickness * c1 / lambda;
      double mean = 0;
      for (const bool parallel : {false, true}) {
        const double a0 = parallel ? n1 * c0 : c0, a1 = parallel ? c1 : n1 * c1;
        const double b1 = parallel ? n2 * c1 : n1 * c1, b2 = parallel ? n1 * c2 : n2 * c2;
        const double r01 = (a0 - a1) / (a0 + a1), r12 = (b1 - b2) / (b1 + b2);
        std::complex<double> sum = r01, term = (1 - r01 * r01) * r12;
        for (int i = 1; i < 60; ++i, term *= -r01 * r12) sum += term * std::polar(1.0, i * delta);
        mean += 0.5 * std::norm(sum);
      }
      EXPECT_NEAR(thin_film_reflectance(c0, {n1, thickness}, n2, lambda), mean, 1e-4);
    }
  }
}

/// Airy's formula as Born and Wolf have it.
float reflectance_by_the_book(float c, const ThinFilm& film, std::complex<double> base,
                              float lambda) {
  using Complex = std::complex<double>;
  const double sin2 = 1.0 - static_cast<double>(c) * c;
  const auto cosine_in = [sin2](Complex n) { return std::sqrt(1.0 - sin2 / (n * n)); };
  const Complex n1(film.index), c1 = cosine_in(n1), c2 = cosine_in(base);
  const Complex phase = std::exp(Complex(0, 4 * M_PI * film.thickness / lambda) * n1 * c1);
  const auto amplitude = [](Complex a, Complex b) { return (a - b) / (a + b); };
  const auto airy = [&](Complex r01, Complex r12) {
    return std::norm((r01 + r12 * phase) / (1.0 + r01 * r12 * phase));
  };
  const double c0 = c;
  return static_cast<float>(0.5 * (airy(amplitude(c0, n1 * c1), amplitude(n1 * c1, base * c2)) +
                                   airy(amplitude(n1 * c0, c1), amplitude(base * c1, n1 * c2))));
}

TEST(ThinFilmReflectance, IsThatOfTheBook) {
  // Films over glass, denser and thinner glass, and metals; with light that the film itself or its
  // base turns back.
  const std::complex<double> bases[] = {{1.5, 0}, {1.1, 0}, {0.7, 0}, {0.2, 3.4}, {1, 0.02}};
  for (const float index : {0.8f, 1.0f, 1.33f, 2.2f})
    for (const float thickness : {30.0f, 420.0f, 1500.0f})
      for (const std::complex<double>& base : bases)
        for (const float c : {0.03f, 0.3f, 0.5f, 0.8f, 1.0f}) {
          const ThinFilm film{index, thickness};
          EXPECT_NEAR(thin_film_reflectance(c, film, std::complex<float>(base), 550.0f),
                      reflectance_by_the_book(c, film, base, 550.0f), 2e-4f)
              << index << ' ' << thickness << ' ' << base << ' ' << c;
        }
}

TEST(ThinFilmReflectance, HasItsKnownLimits) {
  const std::complex<float> metal(0.4f, 3.0f);
  for (const float c : {0.1f, 0.6f, 1.0f}) {
    EXPECT_NEAR(thin_film_reflectance(c, {1.4f, 0.0f}, 1.5f, 500.0f), fresnel_dielectric(c, 1.5f),
                1e-4f);
    EXPECT_NEAR(thin_film_reflectance(c, {1.4f, 0.0f}, metal, 500.0f),
                fresnel_conductor(c, SampledSpectrum(0.4f), SampledSpectrum(3.0f))[0], 1e-4f);
  }
  // A quarter-wave layer of the geometric mean reflects nothing.
  EXPECT_NEAR(thin_film_reflectance(1.0f, {1.5f, 600.0f / 6.0f}, 2.25f, 600.0f), 0.0f, 1e-6f);
}

TEST(OrenNayar, AWhiteSurfaceReflectsAllAndARoughOneBackToTheLight) {
  const OrenNayar rough(SampledSpectrum(1.0f), 1.0f), lambert(ramp(0.8f, 0.2f), 0.0f);
  for (const float angle : {0.0f, 50.0f, 85.0f}) {
    const Vec3f wo = direction_at(angle);
    const double energy = integrate_range(
        [&](const Vec3f& w) { return rough.pi_f(wo, w)[0] * w.z / M_PI; }, 0, 1, 1e-4);
    EXPECT_NEAR(energy, 1.0, 2e-3) << angle;
    EXPECT_EQ(lambert.pi_f(wo, direction_at(20.0f)), ramp(0.8f, 0.2f));
  }
  const Vec3f wo = direction_at(60.0f, 0.0f);
  EXPECT_GT(rough.pi_f(wo, wo)[0], 1.5f * rough.pi_f(wo, direction_at(60.0f, 3.1416f))[0]);
}

TEST(FacetAlbedo, IsTheIntegralOfTheFacets) {
  const FacetAlbedoTable& table = principled_tables().facets;
  const auto nodes =
      FacetAlbedoTable::nodes_of([](float c) { return fresnel_dielectric(c, 1.5f); });
  for (const float alpha : {0.1f, 0.37f, 0.9f}) {
    const TrowbridgeReitz facets(alpha, alpha);
    for (const float angle : {5.0f, 60.0f, 84.0f}) {
      const Vec3f wo = direction_at(angle);
      const auto reflected = [&](bool white) {
        return integrate_range(
            [&](const Vec3f& w) {
              const Vec3f m = normalize(w + wo);
              const float f = white ? 1.0f : fresnel_dielectric(dot(w, m), 1.5f);
              return static_cast<double>(
                  f * facets.d(m) * w.z *
                  TrowbridgeReitz::g2_over_4zz(facets.s(wo), wo.z, facets.s(w), w.z));
            },
            0, 1, 1e-5);
      };
      EXPECT_NEAR(table.albedo(wo.z, alpha, nodes), reflected(false), 4e-3) << alpha << angle;
      EXPECT_NEAR(table.white_albedo(wo.z, alpha), reflected(true), 4e-3) << alpha << angle;
    }
  }
}

TEST(Fuzz, ItsTableIsItsIntegral) {
  const FuzzTable& fuzz = principled_tables().fuzz;
  for (const float roughness : {0.2f, 0.5f, 1.0f}) {
    for (const float angle : {10.0f, 70.0f, 86.0f}) {
      const Vec3f wo = direction_at(angle);
      const double energy = integrate_range(
          [&](const Vec3f& w) { return static_cast<double>(fuzz.f(wo, w, roughness) * w.z); }, 0, 1,
          1e-4);
      EXPECT_NEAR(fuzz.albedo(wo.z, roughness), energy, 0.01 * energy + 1e-3);
      EXPECT_LE(energy, 1.0);
    }
  }
}

}  // namespace
}  // namespace nephroid::testing_bsdf
