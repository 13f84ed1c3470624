// Light whose amount is known in closed form: a disk above a floor, a beam through a plate of glass, a
// point light and its mirror image; and scenes that must not care in which unit they are written.
#include <gtest/gtest.h>

#include "rendering.h"

namespace nephroid {
namespace {

using namespace testing_support;

// A camera just above the floor that sees only its centre.
const std::string kLookDown = R"(
  LookAt 0 1 0.001  0 0 0  0 0 1
  Camera "perspective" "float fov" 0.5
  Film "rgb" "integer xresolution" 4 "integer yresolution" 4
  PixelFilter "box"
  WorldBegin
)";

// The radiance of an rgb illuminant of 1 is 1 in every channel of the film, and a spectrally flat
// reflectance keeps it so.
const std::string kFloor = R"(
  Material "diffuse" "spectrum reflectance" [300 0.5 900 0.5]
  Shape "bilinearmesh" "point3 P" [-3 0 -3  3 0 -3  -3 0 3  3 0 3]
)";

void expect_radiance(const std::string& text, const std::string& integrator, double expected,
                     uint32_t passes, IntegratorOptions options = {}) {
  const auto scene = scene_from_text(text);
  const Estimate e = mean_over_seeds(*scene, integrator, options, 16, passes);
  EXPECT_NEAR(e.mean, expected, kT15 * e.error + 2e-5 * expected) << integrator;
  EXPECT_LT(e.error, 0.01 * expected) << "the estimate is too noisy to tell";
}

IntegratorOptions many_photons() {
  IntegratorOptions options;
  options.photons_per_pass = 1 << 16;
  return options;
}

TEST(ClosedForm, DiskAboveAFloor) {
  // E = pi L R^2 / (R^2 + h^2); the floor reflects rho E / pi. The floor sees no light but the disk's, and the disk
  // reflects none.
  const std::string text = kLookDown + R"(
    AttributeBegin
      AreaLightSource "diffuse" "rgb L" [2 2 2]
      Material "diffuse" "rgb reflectance" [0 0 0]
      Translate 0 3 0 Rotate 90 1 0 0
      Shape "disk" "float radius" 1.5
    AttributeEnd
  )" + kFloor;
  const double expected = 0.5 * 2 * 1.5 * 1.5 / (1.5 * 1.5 + 9);
  expect_radiance(text, "path", expected, 64);
  expect_radiance(text, "mixed", expected, 64, many_photons());
}

// Fresnel reflectance at normal incidence.
double fresnel0(double eta) { return (eta - 1) * (eta - 1) / ((eta + 1) * (eta + 1)); }

TEST(ClosedForm, BeamThroughAPlate) {
  // Light falls straight down through two parallel interfaces; between them it bounces for ever, so the
  // plate passes (1-R)/(1+R). What the floor sends back through the plate is reflected there too, away
  // from the camera's spot except for D S D words, which maxdepth 3 leaves out: C D S S L alone is left.
  const std::string text = R"(Integrator "path" "integer maxdepth" 3 )" + kLookDown + R"(
    LightSource "distant" "rgb L" [3 3 3] "point3 from" [0 1 0] "point3 to" [0 0 0]
    AttributeBegin
      Material "dielectric" "float eta" 1.5
      Translate 0 2 0 Rotate -90 1 0 0
      Shape "disk" "float radius" 3
      Material "dielectric" "float eta" 1.5
      Translate 0 0 -0.1 ReverseOrientation Shape "disk" "float radius" 3
    AttributeEnd
  )" + kFloor;
  IntegratorOptions options = many_photons();
  options.photons_per_pass = 1 << 16;
  options.radius = 150;  // footprints are tiny here, and the beam is uniform
  options.max_depth = 3;
  const double r = fresnel0(1.5);
  expect_radiance(text, "mixed", 0.5 / kPi * 3 * (1 - r) * (1 - r), 8, options);
}

TEST(ClosedForm, PointLightAndItsMirrorImage) {
  // A mirror of silver-like constant reflectance stands behind the light; its image lights the floor as a
  // caustic, the light itself directly.
  const double h = 2, x_mirror = 1;
  const double r_mirror = 0.9;  // "reflectance" is the normal incidence value; see below
  const std::string text = kLookDown + R"(
    LightSource "point" "rgb I" [5 5 5] "point3 from" [0 2 0]
    Material "conductor" "spectrum reflectance" [300 0.9 900 0.9] "float roughness" 0
    Shape "bilinearmesh" "point3 P" [1 0.001 -3  1 6 -3  1 0.001 3  1 6 3]
  )" + kFloor;
  IntegratorOptions options = many_photons();
  options.photons_per_pass = 1 << 16;
  options.radius = 20;
  options.max_depth = 2;
  // pbrt's conductor of reflectance r: eta = 1, k = 2 sqrt(r)/sqrt(1-r); Fresnel at the angle of the ray
  // that reaches the origin by way of the mirror.
  const double k2 = 4 * r_mirror / (1 - r_mirror);
  const double cos_i = 2 * x_mirror / std::hypot(2 * x_mirror, h), cos2 = cos_i * cos_i,
               sin2 = 1 - cos2;
  const double t0 = 1 - k2 - sin2, a2b2 = std::sqrt(t0 * t0 + 4 * k2);
  const double a = std::sqrt(0.5 * (a2b2 + t0));
  const double rs = (a2b2 + cos2 - 2 * a * cos_i) / (a2b2 + cos2 + 2 * a * cos_i);
  const double rp = rs * (cos2 * a2b2 + sin2 * sin2 - 2 * a * cos_i * sin2) /
                    (cos2 * a2b2 + sin2 * sin2 + 2 * a * cos_i * sin2);
  const double fresnel = 0.5 * (rs + rp);
  const double d2 = 4 * x_mirror * x_mirror + h * h;
  const double direct = 5 / (h * h), mirrored = fresnel * 5 * (h / std::sqrt(d2)) / d2;
  expect_radiance(text, "mixed", 0.5 / kPi * (direct + mirrored), 8, options);
}

class Scale : public ::testing::TestWithParam<std::string> {};

TEST_P(Scale, TheUnitOfLengthDoesNotMatter) {
  const auto text = [](double s) {
    const auto f = [s](double v) {
      char buffer[40];
      std::snprintf(buffer, sizeof buffer, "%.10g ", v * s);
      return std::string(buffer);
    };
    return "LookAt " + f(0) + f(1.5) + f(-5) + f(0) + f(0.4) + f(0) + " 0 1 0 " + R"(
      Camera "perspective" "float fov" 32
      Film "rgb" "integer xresolution" 12 "integer yresolution" 12
      PixelFilter "box"
      WorldBegin
      AttributeBegin
        AreaLightSource "diffuse" "rgb L" [10 9 8]
        Material "diffuse" "rgb reflectance" [0 0 0]
        Translate 0 )" + f(3) + R"( 0 Rotate 90 1 0 0
        Shape "disk" "float radius" )" + f(0.7) + R"(
      AttributeEnd
      Material "diffuse" "rgb reflectance" [0.6 0.5 0.4]
      Shape "bilinearmesh" "point3 P" [)" + f(-6) + "0 " + f(-6) + f(6) + "0 " + f(-6) + f(-6) +
           "0 " + f(6) + f(6) + "0 " + f(6) + R"(]
      Material "dielectric" "float eta" 1.5
      Translate )" + f(-0.7) + f(0.7) + f(0) + R"( Shape "sphere" "float radius" )" + f(0.6) + R"(
      Material "coateddiffuse" "float roughness" 0
      Translate )" + f(1.4) + f(0) + f(0) + R"( Shape "sphere" "float radius" )" + f(0.6);
  };
  IntegratorOptions options;
  options.photons_per_pass = 1 << 12;
  std::vector<Estimate> means;
  for (const double s : {1.0, 1e-4, 1e4})
    means.push_back(mean_over_seeds(*scene_from_text(text(s)), GetParam(), options, 16, 8));
  for (const Estimate& e : means) {
    EXPECT_NEAR(e.mean, means[0].mean, kT15 * std::hypot(e.error, means[0].error) + 1e-6);
    EXPECT_LT(e.error, 0.03 * e.mean);
  }
}

INSTANTIATE_TEST_SUITE_P(AllIntegrators, Scale, ::testing::ValuesIn(integrator_names()),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace nephroid
