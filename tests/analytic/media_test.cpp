// Media with known results: slabs that absorb and emit, single scattering against quadrature, and
// two equilibria. These are a white furnace without absorption, and an enclosure whose medium emits
// as its walls do. All coefficients vary with wavelength, to reveal biased spectral weights.
#include <gtest/gtest.h>

#include <functional>

#include "rendering.h"

namespace nephroid {
namespace {

using namespace testing_support;

using SpectralRadiance = std::function<SampledSpectrum(const SampledWavelengths&)>;

/// Mean of the film's channels for a spectrum, by quadrature over `count` times 8 wavelengths. Many
/// are needed: the film's curves are steps of a nanometre.
double film_mean(const Scene& scene, const SpectralRadiance& radiance, int count = 4096) {
  double sum = 0;
  for (int i = 0; i < count; ++i) {
    const float u = (static_cast<float>(i) + 0.5f) / static_cast<float>(count);
    const auto lambda = SampledWavelengths::sample_visible(u);
    const Rgb v = sensor_weights(lambda, RgbColorSpace::srgb(), scene.film.imaging_ratio)
                      .apply(radiance(lambda));
    sum += (static_cast<double>(v.r) + v.g + v.b) / 3;
  }
  return sum / count;
}

/// Radiance of "rgb L" [1 1 1] and of "rgb Le" [1 1 1]: the sRGB white with luminance 1.
SampledSpectrum white(const SampledWavelengths& lambda) {
  const Spectrum& illuminant = RgbColorSpace::srgb().illuminant();
  return illuminant.sample(lambda) / spectrum_to_photometric(illuminant);
}

void expect_mean(const Scene& scene, const std::string& integrator, const std::string& name,
                 double expected, uint32_t passes, const IntegratorOptions& options = {}) {
  const Estimate e = mean_over_seeds(scene, integrator, options, 16, passes);
  std::printf("%s, %s: off by %+.3f %%, standard error %.3f %%\n", name.c_str(), integrator.c_str(),
              100 * (e.mean / expected - 1), 100 * e.error / expected);
  EXPECT_NEAR(e.mean, expected, kT15 * e.error + 1e-4 * expected) << name;
  EXPECT_LT(e.error, max_error(0.01 * expected)) << name << " is too noisy to tell";
}

struct MediumText {
  const char* name;
  std::string text;  ///< parameters of MakeNamedMedium "m", its type first
};

/// "[ ... ]": `count` values between `least` and `most` in a fixed scrambled order.
std::string disorder(int count, double least, double most) {
  std::string text = "[";
  for (int i = 0; i < count; ++i)
    text += " " + std::to_string(least + (most - least) * ((i * 37 + 11) % 64) / 63.0);
  return text + " ] ";
}
std::string constant(int count, double value) {
  return disorder(count, value, value);
}
std::string rgb(const std::string& name, double r, double g, double b) {
  return "\"rgb " + name + "\" [ " + std::to_string(r) + " " + std::to_string(g) + " " +
         std::to_string(b) + " ] ";
}

const std::string kGrid = R"("integer nx" 4 "integer ny" 4 "integer nz" 4
  "point3 p0" [ -2 -2 -2 ] "point3 p1" [ 2 2 2 ] )";

/// One medium of each kind that can emit: absorption about `a`, scattering about `s`, emission `le`
/// times the sRGB white. Grids extend beyond the unit ball, inside which emission is constant.
std::vector<MediumText> media(double a, double s, double le = 0) {
  const std::string both =
      rgb("sigma_a", 0.2 * a, 0.5 * a, a) + rgb("sigma_s", s, 0.6 * s, 0.3 * s);
  std::vector<MediumText> all;
  all.push_back({"homogeneous", "\"string type\" \"homogeneous\" \"float g\" 0.5 " + both});
  all.push_back({"uniformgrid", "\"string type\" \"uniformgrid\" \"float g\" -0.3 " + both + kGrid +
                                    "\"float density\" " + disorder(64, 0, 1)});
  all.push_back({"rgbgrid", "\"string type\" \"rgbgrid\" " + kGrid + "\"rgb sigma_a\" " +
                                disorder(3 * 64, 0, a) + "\"rgb sigma_s\" " +
                                disorder(3 * 64, 0, s)});
  if (le > 0) {
    all[0].text += rgb("Le", le, le, le);
    all[1].text += rgb("Le", le, le, le) + "\"float Lescale\" " + constant(64, 1);
    // As in pbrt-v4, only this kind does not divide by the luminance.
    const float luminance = spectrum_to_photometric(RgbColorSpace::srgb().illuminant());
    all[2].text +=
        "\"rgb Le\" " + constant(3 * 64, le) + "\"float Lescale\" " + std::to_string(1 / luminance);
  }
  return all;
}

std::string named(const MediumText& m) {
  return "MakeNamedMedium \"m\" " + m.text + "\n";
}

// A camera on the axis at `z` that looks along +z.
std::string camera(const std::string& before = "", double fov = 0.05, double z = -5) {
  return before + "LookAt 0 0 " + std::to_string(z) +
         "  0 0 0  0 1 0\nCamera \"perspective\" \"float fov\" " + std::to_string(fov) + R"(
    Film "rgb" "integer xresolution" 4 "integer yresolution" 4
    PixelFilter "box"
    WorldBegin
  )";
}

// The medium "m" from z = -1 to z = 0.5.
const std::string kSlab = R"(
  AttributeBegin
    Material "interface"
    MediumInterface "" "m" Translate 0 0 -1 Shape "disk" "float radius" 50
    MediumInterface "m" "" Translate 0 0 1.5 Shape "disk" "float radius" 50
  AttributeEnd
)";
const std::string kWhiteSky = "LightSource \"infinite\" \"rgb L\" [ 1 1 1 ]\n";

/// Midpoint rule along the axis through the slab: calls `at(properties, transmittance so far, dt)`.
template <class F>
SampledSpectrum along_axis(const Medium& medium, float z0, float z1,
                           const SampledWavelengths& lambda, F&& at) {
  constexpr int kSteps = 400;
  const float dt = (z1 - z0) / kSteps;
  SampledSpectrum depth;
  for (int i = 0; i < kSteps; ++i) {
    const float z = z0 + (static_cast<float>(i) + 0.5f) * dt;
    const MediumProperties m = medium.at({0, 0, z}, lambda);
    const SampledSpectrum step = (m.sigma_a + m.sigma_s) * dt;
    at(z, m, exp(-(depth + step * 0.5f)), dt);
    depth += step;
  }
  return exp(-depth);
}

TEST(Media, AbsorbingSlabDimsTheSky) {
  // The closed form, once.
  const auto grey = scene_from_text(
      camera() +
      "MakeNamedMedium \"m\" \"string type\" \"homogeneous\" "
      "\"spectrum sigma_a\" [ 300 0.8 900 0.8 ] \"spectrum sigma_s\" [ 300 0 900 0 ]" +
      kSlab + kWhiteSky);
  expect_mean(*grey, "path", "grey slab", std::exp(-0.8 * 1.5), 4);

  for (const MediumText& m : media(0.7, 0)) {
    const auto scene = scene_from_text(camera() + named(m) + kSlab + kWhiteSky);
    ASSERT_EQ(scene->media.size(), 1u);
    EXPECT_TRUE(scene->media[0]->is_purely_absorbing());
    const double expected = film_mean(*scene, [&](const SampledWavelengths& lambda) {
      return white(lambda) * along_axis(*scene->media[0], -1, 0.5f, lambda,
                                        [](float, const auto&, const auto&, float) {});
    });
    expect_mean(*scene, "path", m.name, expected, 32);
  }
}

TEST(Media, GlowingSlab) {
  const auto grey = scene_from_text(
      camera() +
      "MakeNamedMedium \"m\" \"string type\" \"homogeneous\" \"rgb Le\" [ 2 2 2 ] "
      "\"spectrum sigma_a\" [ 300 0.8 900 0.8 ] \"spectrum sigma_s\" [ 300 0 900 0 ]" +
      kSlab);
  expect_mean(*grey, "path", "grey slab", 2 * (1 - std::exp(-0.8 * 1.5)), 4);

  std::vector<MediumText> glowing = media(0.7, 0, 2);
  glowing.push_back({"temperatures", media(0.7, 0)[1].text + "\"float temperature\" " +
                                         disorder(64, 0.2, 1) +
                                         "\"float temperaturescale\" 6000 \"float Lescale\" " +
                                         disorder(64, 0.3, 1)});
  for (const MediumText& m : glowing) {
    const auto scene = scene_from_text(camera() + named(m) + kSlab);
    EXPECT_TRUE(scene->media[0]->is_emissive());
    const double expected = film_mean(*scene, [&](const SampledWavelengths& lambda) {
      SampledSpectrum sum;
      along_axis(*scene->media[0], -1, 0.5f, lambda,
                 [&](float, const MediumProperties& p, const SampledSpectrum& t, float dt) {
                   sum += t * p.sigma_a * p.le * dt;
                 });
      return sum;
    });
    expect_mean(*scene, "path", m.name, expected, 64);
  }
}

/// Single scattering: the integral along the axis of the light of a lamp at (0.8, 0.3, -0.4) that
/// the phase function sends to the camera. The medium fills everything; a black wall ends the view.
/// `shines`: share of the lamp's 5 units of intensity that goes to a point of the axis.
void expect_single_scattering(const MediumText& m, const std::string& integrator,
                              const std::string& lamp_text,
                              const std::function<float(const Vec3f&)>& shines) {
  const auto scene =
      scene_from_text(camera(named(m) + "MediumInterface \"m\" \"m\"\n", 0.05, -1.9) + lamp_text +
                      R"(
        Material "diffuse" "rgb reflectance" [ 0 0 0 ]
        Translate 0 0 1 Shape "disk" "float radius" 5)");
  IntegratorOptions options;
  options.max_depth = 1;
  const Vec3f lamp(0.8f, 0.3f, -0.4f);
  const double expected = film_mean(
      *scene,
      [&](const SampledWavelengths& lambda) {
        const Medium& medium = *scene->media[0];
        SampledSpectrum sum;
        along_axis(medium, -1.9f, 1, lambda,
                   [&](float z, const MediumProperties& p, const SampledSpectrum& t, float dt) {
                     const Vec3f to_lamp = lamp - Vec3f(0, 0, z);
                     const float distance = length(to_lamp);
                     // Optical depth to the lamp.
                     constexpr int kSteps = 40;
                     SampledSpectrum depth;
                     for (int i = 0; i < kSteps; ++i) {
                       const float f = (static_cast<float>(i) + 0.5f) / kSteps;
                       const auto q = medium.at(Vec3f(0, 0, z) + to_lamp * f, lambda);
                       depth += (q.sigma_a + q.sigma_s) * (distance / kSteps);
                     }
                     const float phase = p.phase.eval({0, 0, -1}, to_lamp * (1 / distance));
                     const float intensity = 5 * shines(to_lamp * (-1 / distance));
                     sum += t * p.sigma_s * exp(-depth) * (intensity * phase * dt / sqr(distance));
                   });
        return sum * white(lambda);
      },
      1024);
  expect_mean(*scene, integrator, m.name, expected, 512, options);
}

// Rounding does not lose the light of thin gas.
TEST(Media, GlowOfVeryThinGas) {
  for (const double depth : {1e-4, 1e-8}) {
    const std::string sigma = std::to_string(depth * 1e9 / 1.5) + "e-9";
    const auto scene = scene_from_text(
        camera() + "MakeNamedMedium \"m\" \"string type\" \"homogeneous\" \"rgb Le\" [ 2 2 2 ] " +
        "\"spectrum sigma_a\" [ 300 " + sigma + " 900 " + sigma +
        " ] \"spectrum sigma_s\" [ 300 0 900 0 ]" + "\"float Lescale\" " +
        std::to_string(1 / depth) + kSlab);
    expect_mean(*scene, "path", "thin gas", 2, 4);
  }
}

TEST(Media, SingleScatteringOfAPointLight) {
  for (const MediumText& m : media(0.3, 0.5))
    expect_single_scattering(
        m, "path", "LightSource \"point\" \"rgb I\" [ 5 5 5 ] \"point3 from\" [ 0.8 0.3 -0.4 ]",
        [](const Vec3f&) { return 1.0f; });
}

TEST(Media, SingleScatteringOfASpotLight) {
  // Only a piece of the axis is in the cone. The walks of `bdpt` keep all wavelengths apart.
  const std::string spot = R"(LightSource "spot" "rgb I" [ 5 5 5 ] "point3 from" [ 0.8 0.3 -0.4 ]
      "point3 to" [ 0 0 0.1 ] "float coneangle" 20 "float conedeltaangle" 5)";
  const Vec3f axis = normalize(Vec3f(-0.8f, -0.3f, 0.5f));
  const auto smooth = [&](const Vec3f& w) {
    const float begin = std::cos(20 * kPi / 180), end = std::cos(15 * kPi / 180);
    const float x = std::clamp((dot(w, axis) - begin) / (end - begin), 0.0f, 1.0f);
    return x * x * (3 - 2 * x);
  };
  for (const MediumText& m : media(0.3, 0.5))
    for (const char* integrator : {"path", "bdpt"})
      expect_single_scattering(m, integrator, spot, smooth);
}

TEST(Media, SingleScatteringOfManyLampsWithoutEnd) {
  // Lights in a tree, a flight that nothing ends, and wavelengths that are not scattered. Thin and
  // dense.
  const std::vector<Vec3f> lamps = {{0.8f, 0.3f, -0.4f}, {-0.5f, 0.1f, 1},  {0.2f, 0.1f, 3},
                                    {0, -2, 6},          {0.05f, 0, -1.5f}, {-4, 0, 0}};
  std::string lamp_text;
  for (const Vec3f& p : lamps)
    lamp_text += "LightSource \"point\" \"rgb I\" [ 5 5 5 ] \"point3 from\" [ " +
                 std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) +
                 " ]\n";
  for (const double density : {0.1, 3.0}) {
    const std::string a = std::to_string(0.2 * density), s = std::to_string(density);
    const auto scene = scene_from_text(
        camera("MakeNamedMedium \"m\" \"string type\" \"homogeneous\" \"spectrum sigma_a\" [ 300 " +
                   a + " 900 " + a + " ] \"spectrum sigma_s\" [ 300 0 520 0 600 " + s + " 900 " +
                   s + " ]\nMediumInterface \"m\" \"m\"\n",
               0.05, -1.9) +
        lamp_text);
    IntegratorOptions options;
    options.max_depth = 1;
    const double expected = film_mean(
        *scene,
        [&](const SampledWavelengths& lambda) {
          const MediumProperties m = scene->media[0]->at({0, 0, 0}, lambda);
          const SampledSpectrum sigma_t = m.sigma_a + m.sigma_s;
          SampledSpectrum sum;
          constexpr int kSteps = 4000;
          for (int i = 0; i < kSteps; ++i) {
            // Steps grow with the distance.
            const float u = (static_cast<float>(i) + 0.5f) / kSteps, t = 60 * sqr(u);
            const float dt = 120 * u / kSteps;
            for (const Vec3f& lamp : lamps) {
              const float d = length(lamp - Vec3f(0, 0, -1.9f + t));
              sum += exp(-(sigma_t * (t + d))) * m.sigma_s * (5 / (4 * kPi) * dt / sqr(d));
            }
          }
          return sum * white(lambda);
        },
        256);
    for (const char* integrator : {"path", "bdpt"})
      expect_mean(*scene, integrator, density < 1 ? "thin" : "dense", expected, 1024, options);
  }
}

// A ball of the medium, whose surface has `material`.
std::string ball_of(const std::string& material) {
  return "AttributeBegin MediumInterface \"m\" \"\" Material " + material +
         " Shape \"sphere\" \"float radius\" 1 AttributeEnd\n";
}

TEST(Media, WhiteFurnaceIsNotSeen) {
  std::vector<MediumText> white_media = media(0, 2);
  white_media.push_back({"cloud", "\"string type\" \"cloud\" \"float g\" 0.8 " +
                                      rgb("sigma_a", 0, 0, 0) + rgb("sigma_s", 5, 4, 2) +
                                      "\"point3 p0\" [ -2 -2 -2 ] \"point3 p1\" [ 2 2 2 ]"});
  IntegratorOptions options;
  options.max_depth = 1000;
  for (const MediumText& m : white_media) {
    const auto scene =
        scene_from_text(camera("", 18) + named(m) + ball_of("\"interface\"") + kWhiteSky);
    expect_mean(*scene, "path", m.name, 1, 64, options);
  }
  // Inside glass, where paths are long because light leaves rarely.
  const MediumText& milk = white_media[0];
  const auto glass = scene_from_text(camera("", 18) + named(milk) +
                                     ball_of("\"dielectric\" \"float eta\" 1.4") + kWhiteSky);
  expect_mean(*glass, "path", "homogeneous in glass", 1, 24, options);
}

TEST(Media, EquilibriumIsNotSeen) {
  // The medium emits as the sky does, so it emits as much as it absorbs. A ball of reflectance 1 is
  // inside.
  for (const MediumText& m : media(0.5, 1.5, 1)) {
    const auto scene =
        scene_from_text(camera("", 18) + named(m) + ball_of("\"interface\"") + kWhiteSky +
                        "MediumInterface \"m\" \"m\" Material \"diffuse\" \"spectrum reflectance\" "
                        "[ 300 1 900 1 ] Shape \"sphere\" \"float radius\" 0.4\n");
    IntegratorOptions options;
    options.max_depth = 1000;
    expect_mean(*scene, "path", m.name, 1, 128, options);
  }
}

TEST(Media, CausticThroughAbsorbingGlass) {
  // A beam falls straight through a plate of coloured glass onto a floor, which the camera sees
  // from below the plate. Photons carry the light; with three events only C D S S L is left.
  IntegratorOptions options;
  options.photons_per_pass = 1 << 12;
  options.radius = 300;  // footprints are tiny here, and the beam is uniform
  options.max_depth = 3;
  const double r = (0.5 / 2.5) * (0.5 / 2.5);
  // Layers: the same density everywhere in the plate's plane.
  std::string layers = "[";
  for (int z = 0; z < 4; ++z) layers += " 1 1 1 1  .9 .9 .9 .9  .2 .2 .2 .2  .6 .6 .6 .6";
  std::vector<MediumText> plates = {media(1.5, 0)[0]};
  plates.push_back({"layers", "\"string type\" \"uniformgrid\" " + rgb("sigma_a", 1, 3, 5) +
                                  rgb("sigma_s", 0, 0, 0) + kGrid + "\"float density\" " + layers +
                                  " ]"});
  for (const MediumText& m : plates) {
    const auto scene = scene_from_text(R"(
      LookAt 0 0.4 0.001  0 -0.6 0  0 0 1
      Camera "perspective" "float fov" 0.5
      Film "rgb" "integer xresolution" 4 "integer yresolution" 4
      PixelFilter "box"
      WorldBegin
      LightSource "distant" "rgb L" [3 3 3] "point3 from" [0 1 0] "point3 to" [0 0 0]
      Material "diffuse" "spectrum reflectance" [300 0.5 900 0.5]
      Shape "bilinearmesh" "point3 P" [-3 -0.6 -3  3 -0.6 -3  -3 -0.6 3  3 -0.6 3]
      )" + named(m) + R"(
      AttributeBegin
        MediumInterface "m" "" Material "dielectric" "float eta" 1.5
        Translate 0 0.9 0 Rotate -90 1 0 0
        Shape "disk" "float radius" 3
        Translate 0 0 -0.4 ReverseOrientation Shape "disk" "float radius" 3
      AttributeEnd)");
    const double expected = film_mean(*scene, [&](const SampledWavelengths& lambda) {
      SampledSpectrum depth;
      constexpr int kSteps = 100;
      for (int i = 0; i < kSteps; ++i) {
        const float y = 0.5f + 0.4f * (static_cast<float>(i) + 0.5f) / kSteps;
        depth += scene->media[0]->at({0, y, 0}, lambda).sigma_a * (0.4f / kSteps);
      }
      return white(lambda) * exp(-depth) * static_cast<float>(0.5 / kPi * 3 * (1 - r) * (1 - r));
    });
    expect_mean(*scene, "mixed", m.name, expected, 8, options);
  }
}

}  // namespace
}  // namespace nephroid
