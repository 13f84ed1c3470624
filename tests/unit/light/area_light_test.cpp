// Area lights against closed forms: irradiance, power, sides, images, alpha.
#include "unit/light/light_fixture.h"

namespace nephroid::testing_light {
namespace {

const std::string kWhiteL = "\"spectrum L\" " + kWhite + " ";
const Vec3f kUp(0, 0, 1);

ShapePtr disk_above(float height, float radius) {
  // Faces down; without reversed orientation its outside would be +z.
  return make_disk(Transform(), true, height, radius, 0, 360);
}
ShapePtr sphere_at(const Vec3f& center, float radius) {
  return make_sphere(Transform(Mat44d().setTranslation(Vec3d(center.x, center.y, center.z))), false,
                     radius, -radius, radius, 360);
}

/// Mean of the standard white over the wavelengths of paths, at luminance 1.
double white_mean() {
  const Spectrum& white = RgbColorSpace::srgb().illuminant();
  double sum = 0;
  for (int i = 0; i < 64; ++i)
    sum += white.sample(SampledWavelengths::sample_visible((static_cast<float>(i) + 0.5f) / 64))
               .average() /
           64;
  return sum / spectrum_to_photometric(white);
}

TEST(AreaLight, DiskLightsThePointBelow) {
  const LightPtr light = area_light_of(kWhiteL, disk_above(2, 1.5f));
  const double expected = kPi * kUnit * 1.5 * 1.5 / (1.5 * 1.5 + 4);
  EXPECT_TRUE(agrees(irradiance(*light, {0, 0, 0}, kUp, 40000), expected));
  // No light on the back.
  EXPECT_EQ(irradiance(*light, {0, 0, 4}, -kUp, 100).mean(), 0.0);
}

TEST(AreaLight, SphereLightsAsItsDistanceSays) {
  for (const float distance : {1.05f, 3.0f, 100.0f}) {
    const LightPtr light = area_light_of(kWhiteL, sphere_at({0, 0, distance}, 1));
    const double expected = kPi * kUnit / (distance * distance);
    EXPECT_TRUE(agrees(irradiance(*light, {0, 0, 0}, kUp, 20000), expected)) << distance;
  }
}

TEST(AreaLight, RectangleLightsThePointBelowItsCentre) {
  const LightPtr light = area_light_of(kWhiteL, rectangle(1, 2, 1.5f));
  // Four corners of a x b at height h, each with the configuration factor of a corner point.
  const double a = 1 / 1.5, b = 2 / 1.5;
  const double corner = (a / std::sqrt(1 + a * a) * std::atan(b / std::sqrt(1 + a * a)) +
                         b / std::sqrt(1 + b * b) * std::atan(a / std::sqrt(1 + b * b))) /
                        (2 * kPi);
  EXPECT_TRUE(agrees(irradiance(*light, {0, 0, 0}, kUp, 40000), 4 * corner * kPi * kUnit));
}

TEST(AreaLight, SampledDensityIsTheDensityAsked) {
  const std::vector<ShapePtr> shapes = {disk_above(2, 1), sphere_at({0, 0, 3}, 1),
                                        rectangle(1, 2, 1)};
  for (const ShapePtr& shape : shapes) {
    const LightPtr light = area_light_of(kWhiteL, shape);
    TestRandom random(3);
    for (int i = 0; i < 200; ++i) {
      const Vec3f from(random.next() - 0.5f, random.next() - 0.5f, 0);
      const auto s = light->sample_towards(from, random.next2(), test_wavelengths());
      if (!s) continue;
      const float pdf = light->pdf_towards(from, s->wi, s->p, s->ng);
      EXPECT_NEAR(pdf, s->pdf_w, 2e-3f * s->pdf_w);
      EXPECT_FALSE(s->delta || s->infinite);
      EXPECT_EQ(light->radiance(s->p, s->ng, {0, 0}, -s->wi, test_wavelengths())[0],
                s->radiance[0]);
    }
  }
}

TEST(AreaLight, EmitsItsPowerOnOneSideOrOnBoth) {
  for (const bool both : {false, true}) {
    const std::string sides = both ? "\"bool twosided\" true " : "";
    const double expected = kPi * kUnit * kPi * 1.5 * 1.5 * (both ? 2 : 1);
    const LightPtr light = area_light_of(kWhiteL + sides, disk_above(2, 1.5f));
    EXPECT_TRUE(agrees(emitted_flux(*light, 2000), expected));
    EXPECT_NEAR(light->power(), expected, 1e-4 * expected);
    EXPECT_TRUE(agrees(
        emitted_flux(*area_light_of(kWhiteL + sides + "\"float scale\" 4", disk_above(2, 1.5f)),
                     2000),
        4 * expected));
    // "power" overrides the radiance.
    const LightPtr lamp =
        area_light_of(kWhiteL + sides + "\"float power\" 60", disk_above(2, 1.5f));
    EXPECT_TRUE(agrees(emitted_flux(*lamp, 2000), 60 * kUnit));
  }
}

TEST(AreaLight, RaysLeaveOnTheOutsideOnly) {
  const LightPtr one = area_light_of(kWhiteL, disk_above(2, 1));
  EXPECT_EQ(emitted_flux(*one, 1000, [](const Ray& r) { return r.d.z > 0 ? 1.0 : 0.0; }).mean(),
            0.0);
  const LightPtr two = area_light_of(kWhiteL + "\"bool twosided\" true", disk_above(2, 1));
  const auto up = [](const Ray& r) { return r.d.z > 0 && r.o.z > 2 ? 1.0 : 0.0; };
  const auto down = [](const Ray& r) { return r.d.z < 0 && r.o.z < 2 ? 1.0 : 0.0; };
  EXPECT_TRUE(agrees(emitted_flux(*two, 20000, up), kPi * kPi * kUnit));
  EXPECT_TRUE(agrees(emitted_flux(*two, 20000, down), kPi * kPi * kUnit));
}

TEST(AreaLight, RaysOfASphereStartOutsideOfIt) {
  // Far from the origin, where a poor offset would leave them inside.
  const Vec3f center(1000, 0, 0);
  const LightPtr light = area_light_of(kWhiteL, sphere_at(center, 0.25f));
  const auto enters = [&](const Ray& r) {
    const Vec3d o(double(r.o.x) - center.x, r.o.y, r.o.z), d(r.d.x, r.d.y, r.d.z);
    const double b = o.dot(d), c = o.dot(o) - 0.0625;
    return b < 0 && b * b - c * d.dot(d) > 0 ? 1.0 : 0.0;
  };
  EXPECT_EQ(emitted_flux(*light, 20000, enters).mean(), 0.0);
}

TEST(AreaLight, AlphaThinsWhatIsSampledAndLeavesWhatIsHit) {
  const ShapePtr shape = disk_above(2, 1.5f);
  const LightPtr light = area_light_of(kWhiteL, shape, constant_float_texture(0.25f));
  const double expected = 0.25 * kPi * kUnit * 1.5 * 1.5 / (1.5 * 1.5 + 4);
  EXPECT_TRUE(agrees(irradiance(*light, {0, 0, 0}, kUp, 40000), expected));
  EXPECT_TRUE(agrees(emitted_flux(*light, 2000), 0.25 * kPi * kUnit * kPi * 1.5 * 1.5));
  // A walk that hits the lamp has already passed its alpha.
  EXPECT_NEAR(light->radiance({0, 0, 2}, -kUp, {0, 0}, -kUp, test_wavelengths())[0], kUnit,
              1e-6f * kUnit);
}

TEST(AreaLight, AlphaOfZeroMakesALampThatNobodySees) {
  const LightPtr light = area_light_of(kWhiteL, disk_above(2, 1.5f), constant_float_texture(0.0f));
  EXPECT_TRUE(light->is_delta());
  EXPECT_EQ(light->pdf_towards({0, 0, 0}, kUp, {0, 0, 2}, -kUp), 0.0f);
  const auto s = light->sample_towards({0, 0, 0}, {0.5f, 0.5f}, test_wavelengths());
  ASSERT_TRUE(s);
  EXPECT_TRUE(s->delta);
  EXPECT_TRUE(
      agrees(irradiance(*light, {0, 0, 0}, kUp, 40000), kPi * kUnit * 1.5 * 1.5 / (1.5 * 1.5 + 4)));
}

TEST(AreaLight, AlphaTexturesCutTheLampOut) {
  /// 1 where u > 1/2, 0.5 elsewhere.
  class Step final : public FloatTexture {
   public:
    float eval(const TextureContext& c) const override { return c.uv.x > 0.5f ? 1.0f : 0.5f; }
  };
  // In the rectangle's u, the right half is that of negative x.
  const auto alpha = std::make_shared<Step>();
  const LightPtr light = area_light_of(kWhiteL, rectangle(1, 1, 2), alpha);
  const LightPtr right = area_light_of(kWhiteL, rectangle(1, 1, 2));
  EXPECT_TRUE(agrees(emitted_flux(*light, 20000), 0.75 * kPi * 4 * kUnit));
  EXPECT_TRUE(
      agrees(emitted_flux(*light, 20000, [](const Ray& r) { return r.o.x < 0 ? 1.0 : 0.0; }),
             kPi * 2 * kUnit));
  // Seen from below the centre, where both halves contribute equally.
  const Mean whole = irradiance(*right, {0, 0, 0}, kUp, 20000);
  EXPECT_TRUE(agrees(irradiance(*light, {0, 0, 0}, kUp, 20000, 5), 0.75 * whole.mean(),
                     0.75 * whole.error()));
  EXPECT_FALSE(light->is_delta());
}

TEST(AreaLight, ImagesShineOnBothSidesIfAsked) {
  const ScratchDirectory scratch;
  write_square(scratch.file("a.exr"), 2, {1, 1, 1, 2, 2, 2, 3, 3, 3, 6, 6, 6});
  for (const bool both : {false, true}) {
    const auto lights = area_lights_of(
        std::string("\"string filename\" \"a.exr\" ") + (both ? "\"bool twosided\" true" : ""),
        rectangle(1, 1, 2), nullptr, scratch.path().string());
    const Light& light = *lights.at(0);
    EXPECT_EQ(light.radiance({0, 0, 2}, -kUp, {0.5f, 0.5f}, kUp, test_wavelengths()).is_black(),
              !both);
    // The mean of the pixels is 3, and by symmetry so is that of the interpolated image.
    const SpectrumPtr white = rgb_illuminant_spectrum(RgbColorSpace::srgb(), {1, 1, 1});
    const double unit = white->sample(test_wavelengths())[0] / spectrum_to_photometric(*white);
    const double flux = 3 * unit * kPi * 4 * (both ? 2 : 1);
    EXPECT_TRUE(agrees(emitted_flux(light, 40000), flux, 1e-3 * flux)) << both;
    EXPECT_NEAR(light.power(), 3 * white_mean() * kPi * 4 * (both ? 2 : 1), 4e-3 * light.power());
  }
}

TEST(AreaLight, ImagesRunUpwardsInV) {
  const ScratchDirectory scratch;
  // Two rows: 1 on top, 3 below.
  write_square(scratch.file("a.exr"), 1, {1, 1, 1, 3, 3, 3});
  const auto lights = area_lights_of("\"string filename\" \"a.exr\"", rectangle(1, 1, 1), nullptr,
                                     scratch.path().string());
  const auto at = [&](float v) {
    return lights[0]->radiance({0, 0, 1}, -kUp, {0.5f, v}, -kUp, test_wavelengths())[0];
  };
  EXPECT_NEAR(at(0.0f) / at(1.0f), 3.0f, 1e-2f);
  EXPECT_NEAR(at(0.5f) / at(1.0f), 2.0f, 1e-2f);
  const SpectrumPtr white = rgb_illuminant_spectrum(RgbColorSpace::srgb(), {1, 1, 1});
  const float expected = white->sample(test_wavelengths())[0] / spectrum_to_photometric(*white);
  EXPECT_NEAR(at(1.0f), expected, 2e-3f * expected);
  // Its mean is 2.
  const double flux = 2.0 * expected * kPi * 4;
  EXPECT_NEAR(emitted_flux(*lights[0], 20000).mean(), flux, 5e-3 * flux);
}

TEST(AreaLight, TheImageHasItsPlacement) {
  const ScratchDirectory directory;
  write_square(directory.file("a.exr"), 1, {1, 1, 1});
  Diagnostics d;
  area_lights_of(
      "\"string filename\" \"a.exr\" \"string uwrap\" \"repeat\" "
      "\"float uvtransform\" [1 0 0 0 1 0]",
      disk_above(2, 1), nullptr, directory.path().string(), &d);
  EXPECT_TRUE(d.warnings().empty());
  area_lights_of("\"rgb L\" [1 1 1] \"string uwrap\" \"repeat\"", disk_above(2, 1), nullptr, ".",
                 &d);
  EXPECT_EQ(d.warnings().size(), 1u);
}

TEST(AreaLight, OneLightAPrimitive) {
  MeshData m;
  m.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  m.triangles = {0, 1, 2, 1, 3, 2};
  const auto mesh = std::make_shared<TriangleMesh>(m, false);
  Diagnostics d;
  const auto lights = area_lights_of(kWhiteL + "\"float power\" 3", mesh, nullptr, ".", &d);
  ASSERT_EQ(lights.size(), 2u);
  EXPECT_EQ(d.warnings().size(), 1u);
  for (const LightPtr& light : lights) EXPECT_TRUE(agrees(emitted_flux(*light, 1000), 3 * kUnit));
}

TEST(AreaLight, ErrorsNameThePlace) {
  const ShapePtr shape = disk_above(2, 1);
  EXPECT_THROW(area_lights_of("\"rgb L\" [1 1 1] \"string filename\" \"x.exr\"", shape),
               SceneError);
  EXPECT_THROW(area_lights_of("\"string filename\" \"missing.exr\"", shape), SceneError);
  EXPECT_THROW(area_lights_of("\"float L\" 1", shape), SceneError);
}

}  // namespace
}  // namespace nephroid::testing_light
