// Point, spot and distant lights against closed forms, and the errors of light directives.
#include "unit/light/light_fixture.h"

namespace nephroid::testing_light {
namespace {

float radiance_towards(const Light& light, const Vec3f& from) {
  const auto s = light.sample_towards(from, {0.5f, 0.5f}, test_wavelengths());
  return s ? s->radiance[0] : 0.0f;
}

TEST(PointLight, FallsOffWithTheSquareOfTheDistance) {
  const LightPtr light = light_of(
      "Translate 1 0 0\nLightSource \"point\" \"point3 from\" [0 0 2] "
      "\"float scale\" 3 \"spectrum I\" " +
      kWhite);
  const auto s = light->sample_towards({1, 0, 0}, {0, 0}, test_wavelengths());
  ASSERT_TRUE(s);
  EXPECT_NEAR(s->radiance[0], 3 * kUnit / 4, 1e-6f * kUnit);
  EXPECT_EQ(s->wi, Vec3f(0, 0, 1));
  EXPECT_EQ(s->p, Vec3f(1, 0, 2));
  EXPECT_TRUE(s->delta && !s->infinite);
  EXPECT_EQ(s->pdf_w, 1.0f);
  EXPECT_TRUE(light->is_delta());
  EXPECT_EQ(light->pdf_towards({1, 0, 0}, {0, 0, 1}, {1, 0, 2}, {0, 0, 0}), 0.0f);
  EXPECT_FALSE(light->sample_towards({1, 0, 2}, {0, 0}, test_wavelengths()));
}

TEST(PointLight, EmitsItsPower) {
  const LightPtr light = light_of("LightSource \"point\" \"spectrum I\" " + kWhite);
  EXPECT_TRUE(agrees(emitted_flux(*light, 1000), 4 * kPi * kUnit));
  EXPECT_NEAR(light->power(), 4 * kPi * kUnit, 1e-5f * light->power());
  const LightPtr lamp =
      light_of("LightSource \"point\" \"float power\" 100 \"spectrum I\" " + kWhite);
  EXPECT_TRUE(agrees(emitted_flux(*lamp, 1000), 100 * kUnit));
}

TEST(PointLight, RgbIsMeasuredByItsIlluminant) {
  // As in pbrt-v4, "rgb I [2 2 2]" is twice the colour space's white, scaled to luminance 1.
  const LightPtr one = light_of("LightSource \"point\"");
  const LightPtr two = light_of("LightSource \"point\" \"rgb I\" [2 2 2]");
  EXPECT_NEAR(radiance_towards(*two, {0, 0, 1}) / radiance_towards(*one, {0, 0, 1}), 2.0f, 2e-3f);
  const float white = RgbColorSpace::srgb().illuminant()(550);
  EXPECT_GT(white, 0.0f);
  double luminance = 0;
  for (int i = 0; i < 64; ++i) {
    const auto lambda = SampledWavelengths::sample_visible((static_cast<float>(i) + 0.5f) / 64);
    const auto s = one->sample_towards({0, 0, 1}, {0, 0}, lambda);
    for (int k = 0; k < kSpectrumSamples; ++k)
      luminance +=
          s->radiance[k] * cie_xyz(lambda.lambda(k)).y / lambda.pdf()[k] / 64 / kSpectrumSamples;
  }
  EXPECT_NEAR(luminance, 1.0, 2e-3);
}

TEST(SpotLight, HasASmoothEdgeInTheCosine) {
  const LightPtr light = light_of(
      "LightSource \"spot\" \"point3 from\" [0 0 5] \"point3 to\" [0 0 0] \"float coneangle\" 40 "
      "\"float conedeltaangle\" 20 \"spectrum I\" " +
      kWhite);
  const auto at = [&](double degrees) {
    const double a = degrees * kPi / 180;
    // A point on the unit sphere around the light.
    return radiance_towards(
               *light, {static_cast<float>(std::sin(a)), 0, static_cast<float>(5 - std::cos(a))}) /
           kUnit;
  };
  EXPECT_NEAR(at(0), 1.0f, 1e-5f);
  EXPECT_NEAR(at(19.9), 1.0f, 1e-5f);
  EXPECT_EQ(at(40.1), 0.0f);
  EXPECT_EQ(at(180), 0.0f);
  const double inner = std::cos(20 * kPi / 180), outer = std::cos(40 * kPi / 180);
  for (const double degrees : {22.0, 30.0, 38.0}) {
    const double x = (std::cos(degrees * kPi / 180) - outer) / (inner - outer);
    EXPECT_NEAR(at(degrees), x * x * (3 - 2 * x), 1e-4) << degrees;
  }
}

TEST(SpotLight, EmitsItsPower) {
  for (const float delta : {0.0f, 1.0f, 10.0f, 30.0f}) {
    const double inner = std::cos((30 - delta) * kPi / 180), outer = std::cos(30 * kPi / 180);
    const double expected = kUnit * 2 * kPi * ((1 - inner) + (inner - outer) / 2);
    const LightPtr light = light_of("LightSource \"spot\" \"float conedeltaangle\" " +
                                    std::to_string(delta) + " \"spectrum I\" " + kWhite);
    EXPECT_TRUE(agrees(emitted_flux(*light, 5000), expected)) << delta;
    EXPECT_NEAR(light->power(), expected, 1e-5 * expected);
    const LightPtr lamp =
        light_of("LightSource \"spot\" \"float power\" 7 \"float conedeltaangle\" " +
                 std::to_string(delta) + " \"spectrum I\" " + kWhite);
    EXPECT_TRUE(agrees(emitted_flux(*lamp, 5000), 7 * kUnit)) << delta;
  }
}

TEST(SpotLight, NarrowConesKeepTheirPower) {
  const LightPtr light = light_of(
      "LightSource \"spot\" \"float power\" 7 \"float coneangle\" 0.05 \"float conedeltaangle\" "
      "0.01 "
      "\"spectrum I\" " +
      kWhite);
  EXPECT_TRUE(agrees(emitted_flux(*light, 1000), 7 * kUnit));
}

TEST(SpotLight, EmissionFollowsItsDensity) {
  const LightPtr light = light_of(
      "LightSource \"spot\" \"float coneangle\" 60 "
      "\"float conedeltaangle\" 40 \"spectrum I\" " +
      kWhite);
  // Counts in rings of equal width in the cosine, against the integral of the intensity.
  constexpr int kRings = 40;
  const double inner = std::cos(20 * kPi / 180), outer = 0.5;
  const double total = (1 - inner) + (inner - outer) / 2;
  std::vector<double> observed(kRings), expected(kRings);
  constexpr int kCount = 100000;
  const auto below = [&](double c) {  // share of the flux at cosines below c
    const double x = std::clamp((c - outer) / (inner - outer), 0.0, 1.0);
    return ((inner - outer) * (x * x * x - x * x * x * x / 2) + std::max(0.0, c - inner)) / total;
  };
  TestRandom random(5);
  for (int i = 0; i < kCount; ++i) {
    const auto e = light->sample_emission({0, 0}, random.next2(), test_wavelengths());
    ASSERT_TRUE(e);
    const int ring = static_cast<int>((e->ray.d.z - outer) / (1 - outer) * kRings);
    ++observed[std::clamp(ring, 0, kRings - 1)];
    // The density is intensity divided by flux.
    const auto back = light->sample_towards(e->ray.d, {0, 0}, test_wavelengths());
    EXPECT_NEAR(e->pdf_w, (back ? back->radiance[0] : 0) / kUnit / (2 * kPi * total), 2e-5);
  }
  for (int r = 0; r < kRings; ++r)
    expected[r] = kCount * (below(outer + (1 - outer) * (r + 1) / kRings) -
                            below(outer + (1 - outer) * r / kRings));
  EXPECT_GT(chi_square_test(observed, expected), 1e-4);
}

TEST(DistantLight, ShinesAlongOneDirection) {
  const SceneSphere sphere{{1, 2, 3}, 10};
  const LightPtr light = light_of(
      "LightSource \"distant\" \"point3 from\" [0 0 4] \"point3 to\" [0 0 1] \"spectrum L\" " +
          kWhite + " \"float illuminance\" 5",
      sphere);
  const auto s = light->sample_towards({0, 0, 0}, {0, 0}, test_wavelengths());
  ASSERT_TRUE(s);
  EXPECT_NEAR(s->radiance[0], 5 * kUnit, 1e-6f * kUnit);
  EXPECT_EQ(s->wi, Vec3f(0, 0, 1));
  EXPECT_GE(length(s->p), 19.9f);
  EXPECT_TRUE(s->delta && s->infinite);
  EXPECT_FALSE(light->bounds());
  EXPECT_TRUE(agrees(emitted_flux(*light, 100), 5 * kUnit * kPi * 100));
  EXPECT_NEAR(light->power(), 5 * kUnit * kPi * 100, 1e-3f * light->power());
  const auto e = light->sample_emission({0.3f, 0.6f}, {0.5f, 0.5f}, test_wavelengths());
  ASSERT_TRUE(e);
  EXPECT_FLOAT_EQ(light->emission_pdf(e->ng, e->ray.d).pdf_a, e->pdf_a);
  EXPECT_EQ(light->emission_pdf(e->ng, e->ray.d).pdf_w, e->pdf_w);
}

TEST(DistantLight, WithAnAngleIsACapOfTheSameIrradiance) {
  const SceneSphere sphere{{1, 2, 3}, 10};
  const Vec3f kOrigin(0, 0, 0);
  for (const float degrees : {0.53f, 20.0f, 180.0f}) {
    SCOPED_TRACE(degrees);
    const LightPtr light = light_of(
        "LightSource \"distant\" \"point3 from\" [0 0 4] \"point3 to\" [0 0 1] \"spectrum L\" " +
            kWhite + " \"float illuminance\" 5 \"float angle\" " + std::to_string(degrees),
        sphere);
    EXPECT_FALSE(light->is_delta());
    EXPECT_TRUE(agrees(irradiance(*light, {0, 0, 0}, {0, 0, 1}, 20000), 5 * kUnit));
    // Flux through the disk of the scene, which is perpendicular to each ray.
    const double half = degrees * kPi / 360;
    const double solid_angle = 2 * kPi * (1 - std::cos(half));
    const double radiance = 5 * kUnit / (kPi * std::sin(half) * std::sin(half));
    const double flux = radiance * solid_angle * kPi * 100;
    EXPECT_TRUE(agrees(emitted_flux(*light, 1000), flux, 1e-4 * flux));
    EXPECT_NEAR(light->power(), flux, 1e-3 * flux);
    const auto seen = [&](double angle) {
      const Vec3f w(static_cast<float>(std::sin(angle)), 0, static_cast<float>(std::cos(angle)));
      EXPECT_EQ(light->pdf_towards(kOrigin, w, kOrigin, kOrigin) > 0,
                light->emission_pdf(kOrigin, -w).pdf_w > 0);
      return light->radiance_at_infinity(kOrigin, w, test_wavelengths())[0];
    };
    EXPECT_NEAR(seen(0.99 * half), radiance, 1e-3 * radiance);
    EXPECT_EQ(seen(1.01 * half), 0);
    EXPECT_NEAR(light->pdf_towards(kOrigin, {0, 0, 1}, kOrigin, kOrigin) * solid_angle, 1, 1e-3);
  }
}

TEST(DistantLight, IgnoresScalesOfItsTransform) {
  const LightPtr light = light_of(
      "Scale 7 7 7\nLightSource \"distant\" \"point3 from\" [0 1 0] "
      "\"point3 to\" [0 0 0] \"spectrum L\" " +
      kWhite);
  EXPECT_NEAR(radiance_towards(*light, {0, 0, 0}), kUnit, 1e-6f * kUnit);
}

TEST(DistantLight, SamplesItsCapUniformly) {
  const LightPtr light = light_of("LightSource \"distant\" \"float angle\" 120");
  constexpr int kCount = 100000, kRings = 10, kSectors = 8;
  std::vector<double> observed(kRings * kSectors),
      expected(kRings * kSectors, static_cast<double>(kCount) / (kRings * kSectors));
  TestRandom random(5);
  for (int i = 0; i < kCount; ++i) {
    const auto s = light->sample_towards({0, 0, 0}, random.next2(), test_wavelengths());
    ASSERT_TRUE(s);
    EXPECT_NEAR(length(s->wi), 1, 1e-6f);
    // The cap reaches 60 degrees from the axis, where 1 - cos is 1/2.
    const int ring = static_cast<int>((1 + s->wi.z) * 2 * kRings);
    const int sector =
        static_cast<int>((std::atan2(s->wi.y, s->wi.x) / (2 * kPi) + 0.5) * kSectors);
    ++observed[std::clamp(ring, 0, kRings - 1) * kSectors + std::clamp(sector, 0, kSectors - 1)];
  }
  EXPECT_GT(chi_square_test(observed, expected), 1e-4);
}

TEST(LightDirectives, ErrorsNameThePlace) {
  const auto error = [](const std::string& text) -> std::string {
    try {
      lights_of(text);
    } catch (const Error& e) {
      return e.what();
    }
    return "no error";
  };
  const auto expect = [&](const std::string& text, const std::string& part) {
    const std::string e = error(text);
    EXPECT_EQ(e.find("t.pbrt:2:"), 0u) << e;
    EXPECT_NE(e.find(part), std::string::npos) << e;
  };
  expect("LightSource \"laser\"", "unknown light");
  expect("LightSource \"infinite\" \"point3 portal\" [0 0 0 1 0 0 1 1 0]", "3 corners");
  expect("LightSource \"infinite\" \"point3 portal\" [0 0 0 1 0 0 2 1 0 1 1 0]", "not a rectangle");
  expect("LightSource \"infinite\" \"point3 portal\" [0 0 0 1 1 0 1 0 0 0 1 0]", "not a rectangle");
  expect("LightSource \"projection\"", "filename");
  expect("LightSource \"projection\" \"string filename\" \"x.exr\" \"float fov\" 180", "fov");
  expect("LightSource \"goniometric\" \"string filename\" \"missing.exr\"", "missing.exr");
  expect("LightSource \"infinite\" \"rgb L\" [1 1 1] \"string filename\" \"x.exr\"", "both");
  expect("LightSource \"spot\" \"point3 to\" [0 0 0]", "same point");
  expect("LightSource \"spot\" \"float coneangle\" 200", "coneangle");
  expect("LightSource \"point\" \"float scale\" -1", "scale");
  expect("LightSource \"point\" \"rgb I\" [1 -1 1]", "negative");
  expect("LightSource \"infinite\" \"string filename\" \"missing.exr\"", "missing.exr");
}

TEST(LightDirectives, BlackLightsAreLightsWithoutPower) {
  const LightPtr light = light_of("LightSource \"point\" \"spectrum I\" [200 0 900 0]");
  EXPECT_EQ(light->power(), 0.0f);
  EXPECT_EQ(radiance_towards(*light, {0, 0, 1}), 0.0f);
}

TEST(LightDirectives, AGoniometricLightWithoutADiagramIsAPoint) {
  Diagnostics d;
  const auto lights = lights_of("LightSource \"goniometric\" \"spectrum I\" " + kWhite, ".", &d);
  EXPECT_EQ(d.warnings().size(), 1u);
  for (const Vec3f& from : {Vec3f(0, 0, 1), Vec3f(0, -1, 0), Vec3f(1, 0, 0)})
    EXPECT_NEAR(radiance_towards(*lights.at(0), from), kUnit, 1e-6f * kUnit);
}

TEST(LightDirectives, UnknownParametersAreReported) {
  Diagnostics d;
  lights_of("LightSource \"point\" \"float intensity\" 3", ".", &d);
  ASSERT_EQ(d.warnings().size(), 1u);
  EXPECT_NE(d.warnings()[0].message.find("intensity"), std::string::npos);
}

}  // namespace
}  // namespace nephroid::testing_light
