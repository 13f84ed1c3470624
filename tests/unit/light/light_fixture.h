// Lights from scene text or on a shape, and estimates of emitted and received light.
#pragma once

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/warps.h"
#include "input/pbrt_parser.h"
#include "scene/light/light.h"
#include "unit/bsdf/statistics.h"
#include "unit/film/scratch_directory.h"

namespace nephroid::testing_light {

using testing_bsdf::chi_square_test;
using testing_bsdf::Mean;
using testing_bsdf::TestRandom;

/// A constant spectrum of value 1. The scene's lights scale it to luminance 1.
inline const std::string kWhite = "[ 200 1 900 1 ]";
inline constexpr float kUnit = 1.0f / kCieYIntegral;

inline SampledWavelengths test_wavelengths() {
  return SampledWavelengths::sample_visible(0.37f);
}

/// The lights of a scene, before the scene sphere is known.
inline std::vector<LightPtr> lights_of(const std::string& text, const std::string& directory = ".",
                                       Diagnostics* diagnostics = nullptr) {
  Diagnostics own;
  Diagnostics& d = diagnostics ? *diagnostics : own;
  return make_lights(parse_pbrt_string("WorldBegin\n" + text, "t.pbrt", directory, d), d);
}
inline LightPtr light_of(const std::string& text, const SceneSphere& sphere = {},
                         const std::string& directory = ".") {
  std::vector<LightPtr> lights = lights_of(text, directory);
  EXPECT_EQ(lights.size(), 1u);
  lights[0]->set_scene_sphere(sphere);
  return std::move(lights[0]);
}

/// Area lights on a shape; `parameters` as in a scene file.
inline std::vector<LightPtr> area_lights_of(const std::string& parameters, const ShapePtr& shape,
                                            FloatTexturePtr alpha = nullptr,
                                            const std::string& directory = ".",
                                            Diagnostics* diagnostics = nullptr) {
  Diagnostics own;
  Diagnostics& d = diagnostics ? *diagnostics : own;
  const SceneDescription scene = parse_pbrt_string(
      "WorldBegin\nAreaLightSource \"diffuse\" " + parameters + "\nShape \"sphere\"", "t.pbrt",
      directory, d);
  const TextureLibrary textures(scene, d);
  return make_area_lights(*scene.shapes.at(0).area_light, shape, *scene.files, textures,
                          std::move(alpha), false, d);
}
inline LightPtr area_light_of(const std::string& parameters, const ShapePtr& shape,
                              FloatTexturePtr alpha = nullptr) {
  std::vector<LightPtr> lights = area_lights_of(parameters, shape, std::move(alpha));
  EXPECT_EQ(lights.size(), 1u);
  return std::move(lights[0]);
}

/// A rectangle in the plane z = `z` around the axis, facing down (outside -z).
inline ShapePtr rectangle(float half_x, float half_y, float z) {
  MeshData m;
  // pbrt's order p00 p10 p01 p11; the outside is dpdu x dpdv.
  m.positions = {
      {half_x, -half_y, z}, {-half_x, -half_y, z}, {half_x, half_y, z}, {-half_x, half_y, z}};
  m.uvs = {{0, 0}, {1, 0}, {0, 1}, {1, 1}};
  m.quads = {0, 1, 2, 3};
  return make_bilinear_mesh(m, false);
}

/// One unbiased estimate of the irradiance at a point: the light's own sample, plus a uniform
/// direction for light that is left to escaping paths.
inline double irradiance_sample(const Light& light, const Vec3f& p, const Vec3f& n,
                                TestRandom& random) {
  const auto s = light.sample_towards(p, random.next2(), test_wavelengths());
  double e = s ? s->radiance[0] * std::max(0.0f, dot(n, s->wi)) / s->pdf_w : 0.0;
  if (light.is_infinite() && !light.is_delta()) {
    const Vec3f w = square_to_sphere(random.next2());
    if (light.pdf_towards(p, w, {}, {}) == 0.0f)
      e += light.radiance_at_infinity(p, w, test_wavelengths())[0] * std::max(0.0f, dot(n, w)) * 4 *
           kPi;
  }
  return e;
}

/// Irradiance at `p` with normal `n` at the first wavelength, by sample_towards.
inline Mean irradiance(const Light& light, const Vec3f& p, const Vec3f& n, int count,
                       uint64_t seed = 1) {
  TestRandom random(seed);
  Mean mean;
  for (int i = 0; i < count; ++i) mean.add(irradiance_sample(light, p, n, random));
  return mean;
}

/// Flux at the first wavelength by sample_emission, with rays weighted by `weight`.
inline Mean emitted_flux(const Light& light, int count,
                         const std::function<double(const Ray&)>& weight, uint64_t seed = 2) {
  TestRandom random(seed);
  Mean mean;
  for (int i = 0; i < count; ++i) {
    const Vec2f u = random.next2(), v = random.next2();
    const auto e = light.sample_emission(u, v, test_wavelengths());
    mean.add(e ? weight(e->ray) * e->radiance[0] * e->cos_theta / (e->pdf_a * e->pdf_w) : 0.0);
  }
  return mean;
}
inline Mean emitted_flux(const Light& light, int count, uint64_t seed = 2) {
  return emitted_flux(
      light, count, [](const Ray&) { return 1.0; }, seed);
}

/// Luminous flux by sample_emission, relative to a light of luminance 1 (a scene's lumens).
inline Mean luminous_flux(const Light& light, int count, uint64_t seed = 9) {
  TestRandom random(seed);
  Mean mean;
  for (int i = 0; i < count; ++i) {
    const Vec2f u = random.next2(), v = random.next2();
    const SampledWavelengths lambda = SampledWavelengths::sample_visible(random.next());
    const auto e = light.sample_emission(u, v, lambda);
    double sum = 0.0;
    for (int k = 0; e && k < kSpectrumSamples; ++k)
      sum += e->radiance[k] * cie_xyz(lambda.lambda(k)).y / lambda.pdf()[k] / kSpectrumSamples;
    mean.add(e ? sum * e->cos_theta / (e->pdf_a * e->pdf_w) : 0.0);
  }
  return mean;
}

/// True if the mean is `expected` within 4.5 standard errors (and float rounding). A false alarm
/// has a chance of one in 150 000, and the seeds are fixed.
inline ::testing::AssertionResult agrees(const Mean& m, double expected, double error = 0.0) {
  const double tolerance =
      4.5 * std::sqrt(m.error() * m.error() + error * error) + 2e-6 * std::abs(expected);
  if (std::abs(m.mean() - expected) <= tolerance) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure()
         << m.mean() << " +- " << m.error() << ", expected " << expected << " +- " << error;
}

/// Writes a square rgb image of floats, the top row first.
inline void write_square(const std::string& path, int size, const std::vector<float>& rgb) {
  const OIIO::ImageSpec spec(size, static_cast<int>(rgb.size()) / 3 / size, 3,
                             OIIO::TypeDesc::FLOAT);
  const auto out = OIIO::ImageOutput::create(path);
  ASSERT_TRUE(out && out->open(path, spec)) << OIIO::geterror();
  ASSERT_TRUE(out->write_image(OIIO::TypeDesc::FLOAT, rgb.data())) << out->geterror();
  out->close();
}

}  // namespace nephroid::testing_light
