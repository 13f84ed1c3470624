// Flight whose choices do not depend on the hero: each wavelength is unbiased by itself. Compared
// with closed forms, quadrature, and the flight that needs the mean over heroes.
#include "transport/medium_flight.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "unit/bsdf/statistics.h"

namespace nephroid {
namespace {

using testing_bsdf::Mean;

/// A medium along x with coefficients per wavelength. Its density is 1 or, if uneven, varies
/// between 0 and 1 under a stepped majorant. `turn` rotates the wavelengths by as many places.
class TestMedium final : public Medium {
 public:
  TestMedium(const SampledSpectrum& sigma_a, const SampledSpectrum& sigma_s, bool uneven,
             int turn = 0)
      : uneven_(uneven) {
    for (int i = 0; i < kSpectrumSamples; ++i) {
      sigma_a_.set(i, sigma_a[(i + turn) % kSpectrumSamples]);
      sigma_s_.set(i, sigma_s[(i + turn) % kSpectrumSamples]);
    }
  }
  bool is_emissive() const override { return false; }
  bool is_purely_absorbing() const override { return sigma_s_.is_black(); }
  std::optional<SampledSpectrum> uniform_extinction(const SampledWavelengths&) const override {
    if (uneven_) return std::nullopt;
    return sigma_a_ + sigma_s_;
  }
  float density(float x) const { return uneven_ ? 0.5f + 0.5f * std::sin(3 * x) : 1.0f; }
  MediumProperties at(const Vec3f& p, const SampledWavelengths&) const override {
    return {sigma_a_ * density(p.x), sigma_s_ * density(p.x), SampledSpectrum(), {}};
  }
  MajorantIterator majorants(const Ray& ray, float t_max,
                             const SampledWavelengths&) const override {
    if (!uneven_) return MajorantIterator(MajorantSegment{0, t_max, sigma_a_ + sigma_s_});
    // Four cells over [0, 4). The second one's bound is loose.
    static constexpr float kScales[4] = {1.0f, 1.6f, 1.0f, 1.0f};
    static constexpr int kResolution[3] = {4, 1, 1};
    return MajorantIterator(Vec3d(ray.o.x / 4, 0.5, 0.5), Vec3d(ray.d.x / 4, 0, 0), 0,
                            std::min(t_max, 4.0f), sigma_a_ + sigma_s_, kScales, kResolution);
  }
  SampledSpectrum sigma_t() const { return sigma_a_ + sigma_s_; }
  SampledSpectrum sigma_s() const { return sigma_s_; }

 private:
  SampledSpectrum sigma_a_, sigma_s_;
  bool uneven_;
};

SampledSpectrum spectrum(const float (&values)[kSpectrumSamples]) {
  SampledSpectrum s;
  for (int i = 0; i < kSpectrumSamples; ++i) s.set(i, values[i]);
  return s;
}

// The third wavelength has no collisions, the fourth is only absorbed, the fifth only scattered.
const SampledSpectrum kAbsorbed = spectrum({0.3f, 0.0f, 0.0f, 1.2f, 0.0f, 0.2f, 0.1f, 0.6f});
const SampledSpectrum kScattered = spectrum({1.0f, 2.0f, 0.0f, 0.0f, 0.4f, 0.7f, 1.5f, 0.1f});
const SampledWavelengths kLambda = SampledWavelengths::sample_visible(0.3f);
constexpr float kEnd = 1.7f, kHalf = 0.8f;
const Ray kRay{Vec3f(0, 0, 0), Vec3f(1, 0, 0), kInfinity, 0};

/// Throughput of one wavelength at the end, and at collisions in the first part and in the rest.
struct Expected {
  double through = 1, near = 0, far = 0;
};
Expected quadrature(const TestMedium& medium, int k) {
  constexpr int kSteps = 17000;
  Expected e;
  double depth = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double step = double(kEnd) / kSteps, x = (i + 0.5) * step;
    const double density = double(medium.density(static_cast<float>(x)));
    const double here = density * double(medium.sigma_t()[k]) * step;
    const double scattered =
        density * double(medium.sigma_s()[k]) * step * std::exp(-depth - here / 2);
    (x < double(kHalf) ? e.near : e.far) += scattered;
    depth += here;
  }
  e.through = std::exp(-depth);
  return e;
}

/// Means of the values of Expected over flights.
struct Measured {
  Mean through, near, far;
  void add(const std::optional<Collision>& c, double value) {
    through.add(c ? 0 : value);
    near.add(c && c->t < kHalf ? value : 0);
    far.add(c && c->t >= kHalf ? value : 0);
  }
};
void expect_agree(const Measured& m, const Expected& e, int k) {
  EXPECT_NEAR(m.through.mean(), e.through, 4.5 * m.through.error() + 1e-6) << k;
  EXPECT_NEAR(m.near.mean(), e.near, 4.5 * m.near.error() + 1e-6) << k;
  EXPECT_NEAR(m.far.mean(), e.far, 4.5 * m.far.error() + 1e-6) << k;
}

TEST(FlightPerWavelength, EachWavelengthIsRightByItself) {
  for (const bool uneven : {false, true}) {
    const TestMedium medium(kAbsorbed, kScattered, uneven);
    // A coloured start: the earlier throughput weights the choices and must not matter otherwise.
    const SampledSpectrum start = spectrum({1.0f, 0.2f, 3.0f, 0.5f, 1.0f, 0.0f, 0.01f, 2.0f});
    Measured measured[kSpectrumSamples];
    FlightRandom random(-1.0f, 11);
    for (int n = 0; n < 100000; ++n) {
      SampledSpectrum throughput = start;
      const auto c = fly_per_wavelength(medium, kRay, kEnd, kLambda, random, throughput);
      for (int k = 0; k < kSpectrumSamples; ++k)
        if (start[k] > 0)
          measured[k].add(c, double(throughput[k]) / double(start[k]));
        else
          ASSERT_EQ(throughput[k], 0.0f);
    }
    for (int k = 0; k < kSpectrumSamples; ++k)
      if (start[k] > 0) expect_agree(measured[k], quadrature(medium, k), k);
  }
}

TEST(FlightPerWavelength, ClosedFormOfAUniformMedium) {
  const TestMedium medium(kAbsorbed, kScattered, false);
  for (int k = 0; k < kSpectrumSamples; ++k) {
    const double s = double(medium.sigma_t()[k]), end = double(kEnd);
    const Expected e = quadrature(medium, k);
    EXPECT_NEAR(e.through, std::exp(-s * end), 1e-6);
    if (!(s > 0)) continue;
    EXPECT_NEAR(e.near + e.far, double(kScattered[k]) / s * (1 - std::exp(-s * end)), 1e-4);
  }
}

// fly() is unbiased in the mean over heroes.
TEST(FlightPerWavelength, AgreesWithTheFlightOfTheHero) {
  for (const bool uneven : {false, true}) {
    Measured heroes[kSpectrumSamples], each[kSpectrumSamples];
    FlightRandom random(-1.0f, 5);
    for (int turn = 0; turn < kSpectrumSamples; ++turn) {
      // The hero needs possible collisions.
      const TestMedium medium(kAbsorbed + SampledSpectrum(0.2f), kScattered + SampledSpectrum(0.1f),
                              uneven, turn);
      for (int n = 0; n < 10000; ++n) {
        SampledSpectrum throughput(1.0f), other(1.0f), emitted;
        SpectralDensity density;
        const auto c = fly(medium, kRay, kEnd, kLambda, random, throughput, density, emitted);
        density.take_means(kLambda);
        const auto d = fly_per_wavelength(medium, kRay, kEnd, kLambda, random, other);
        for (int i = 0; i < kSpectrumSamples; ++i) {
          const int k = (i + turn) % kSpectrumSamples;
          heroes[k].add(c, double(throughput[i]) / double(density.u_mean));
          each[k].add(d, double(other[i]));
        }
      }
    }
    for (int k = 0; k < kSpectrumSamples; ++k) {
      const auto agree = [&](const Mean& a, const Mean& b) {
        EXPECT_NEAR(a.mean(), b.mean(), 4.5 * std::hypot(a.error(), b.error()) + 1e-6) << k;
      };
      agree(heroes[k].through, each[k].through);
      agree(heroes[k].near, each[k].near);
      agree(heroes[k].far, each[k].far);
    }
  }
}

// Choices follow the throughput of wavelengths, so that its mean never grows: no fireflies.
TEST(FlightPerWavelength, TheMeanNeverGrows) {
  const TestMedium medium(kAbsorbed, kScattered, true);
  FlightRandom random(-1.0f, 3);
  for (int n = 0; n < 20000; ++n) {
    SampledSpectrum throughput(1.0f);
    for (int flight = 0; flight < 5; ++flight) {
      const float before = throughput.average();
      fly_per_wavelength(medium, kRay, 4.0f, kLambda, random, throughput);
      ASSERT_LE(throughput.average(), before * 1.0001f);
      if (throughput.is_black()) break;
    }
  }
}

TEST(FlightPerWavelength, TheHeroAloneIsDeltaTracked) {
  for (const int hero : {0, 5}) {
    SampledWavelengths lambda = kLambda.with_hero(hero);
    lambda.terminate_secondary();
    // Without absorption nothing is lost, whatever other wavelengths do.
    const TestMedium medium(SampledSpectrum(), kScattered, true);
    Measured measured;
    FlightRandom random(-1.0f, 17);
    for (int n = 0; n < 50000; ++n) {
      SampledSpectrum throughput(1.0f);
      const auto c = fly_per_wavelength(medium, kRay, kEnd, lambda, random, throughput);
      ASSERT_NEAR(throughput[hero], 1.0f, 1e-4f);
      measured.add(c, double(throughput[hero]));
    }
    expect_agree(measured, quadrature(medium, hero), hero);
  }
}

// A medium that only absorbs, and needs more collisions than are allowed.
TEST(FlightPerWavelength, AnOpaqueMediumEndsTheWalk) {
  const TestMedium medium(SampledSpectrum(1e12f), SampledSpectrum(), true);
  FlightRandom random(-1.0f, 1);
  for (int n = 0; n < 100; ++n) {
    SampledSpectrum throughput(1.0f);
    EXPECT_FALSE(fly_per_wavelength(medium, kRay, kEnd, kLambda, random, throughput));
    EXPECT_TRUE(throughput.is_black());
  }
}

}  // namespace
}  // namespace nephroid
