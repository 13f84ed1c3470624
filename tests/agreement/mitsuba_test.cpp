// Pictures of Mitsuba scenes: light with a closed form, and the conventions in which Mitsuba and
// pbrt-v4 differ. Each scene is rendered by path tracing, a few pixels at a time.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "core/spectra.h"
#include "input/mitsuba/mitsuba_reader.h"
#include "rendering.h"
#include "unit/input/temporary_directory.h"

namespace nephroid {
namespace {

using namespace testing_support;
using testing::TemporaryDirectory;

std::string value(const std::string& tag, const std::string& name, const std::string& text) {
  return "<" + tag + " name=\"" + name + "\" value=\"" + text + "\"/>";
}

/// A camera at `origin` with a narrow square picture of `size` pixels.
std::string camera(const std::string& origin, const std::string& target, int size = 2,
                   double fov = 0.5, const std::string& up = "0,1,0.001") {
  const std::string pixels = std::to_string(size);
  return "<sensor type=\"perspective\"><transform name=\"toWorld\"><lookat origin=\"" + origin +
         "\" target=\"" + target + "\" up=\"" + up + "\"/></transform>" +
         value("float", "fov", std::to_string(fov)) + "<film type=\"hdrfilm\">" +
         value("integer", "width", pixels) + value("integer", "height", pixels) +
         "<rfilter type=\"box\"/></film></sensor>\n";
}

/// Renders scenes of a folder.
class Pictures {
 public:
  const TemporaryDirectory& folder() const { return folder_; }

  std::unique_ptr<Scene> scene(const std::string& body, const std::string& version = "0.6.0") {
    Diagnostics diagnostics;
    const std::string path =
        folder_.write("scene.xml", "<scene version=\"" + version + "\">\n" + body + "</scene>\n");
    return build_scene(read_mitsuba(path, {}, diagnostics), {}, diagnostics);
  }
  Film film(const std::string& body, uint32_t passes, const std::string& version = "0.6.0") {
    return render(*scene(body, version), "path", {}, 1, passes);
  }
  Estimate mean(const std::string& body, uint32_t passes = 16,
                const std::string& version = "0.6.0") {
    return mean_over_seeds(*scene(body, version), "path", {}, 16, passes);
  }

 private:
  TemporaryDirectory folder_;
};

void expect_estimate(const Estimate& e, double expected) {
  std::printf("off by %+.3f %%, standard error %.3f %%\n", 100 * (e.mean / expected - 1),
              100 * e.error / expected);
  EXPECT_NEAR(e.mean, expected, kT15 * e.error + 1e-4 * expected);
  EXPECT_LT(e.error, max_error(0.01 * expected)) << "too noisy to tell";
}

/// Red, green and blue of colours that are told apart.
bool is_color(const Rgb& found, const Rgb& expected) {
  const auto near = [](float a, float b) { return std::abs(a - b) < 0.05f; };
  return near(found.r, expected.r) && near(found.g, expected.g) && near(found.b, expected.b);
}

const std::string kAhead = camera("0,0,0", "0,0,-1");

TEST(MitsubaClosedForm, ConstantLightHasItsColour) {
  Pictures pictures;
  const std::string rgb =
      "<emitter type=\"constant\">" + value("rgb", "radiance", "1 2 4") + "</emitter>\n";
  const Rgb found = pictures.film(kAhead + rgb, 64).value(0, 0);
  EXPECT_NEAR(found.r, 1, 0.05);
  EXPECT_NEAR(found.g, 2, 0.05);
  EXPECT_NEAR(found.b, 4, 0.1);
}

/// Luminance of a picture with one colour, by many wavelengths.
double luminance(const Film& film) {
  const Rgb c = film.value(0, 0);
  return RgbColorSpace::srgb().to_xyz(c).y;
}

TEST(MitsubaClosedForm, SpectraAndBlackBodiesHaveAbsoluteLuminance) {
  Pictures pictures;
  const auto constant = [](const std::string& radiance) {
    return kAhead + "<emitter type=\"constant\">" + radiance + "</emitter>\n";
  };
  const SpectrumPtr peak = piecewise_linear_spectrum({500, 550, 600}, {0, 3, 0});
  EXPECT_NEAR(luminance(pictures.film(
                  constant(value("spectrum", "radiance", "500:0, 550:3, 600:0")), 1024)),
              spectrum_to_xyz(*peak).y, 0.02 * spectrum_to_xyz(*peak).y);
  // Equal energy of value 2 has luminance 2.
  EXPECT_NEAR(luminance(pictures.film(constant(value("spectrum", "radiance", "2")), 1024, "3.0.0")),
              2, 0.04);
  // 1.26e4 W / (m^2 sr nm), see the unit test.
  EXPECT_NEAR(luminance(pictures.film(
                  constant("<blackbody name=\"radiance\" temperature=\"5000\"/>"), 1024)),
              1.26e4, 0.03e4);
}

const std::string kFloor =
    "<shape type=\"rectangle\"><transform name=\"toWorld\"><scale "
    "value=\"5\"/></transform><bsdf type=\"twosided\"><bsdf "
    "type=\"diffuse\">" +
    value("spectrum", "reflectance", "0.6") + "</bsdf></bsdf></shape>\n";
const std::string kFromAbove = camera("0,0,3", "0,0,0");

TEST(MitsubaClosedForm, PointDirectionalAndSpotLightsOnAFloor) {
  Pictures pictures;
  const double reflected = 0.6 / kPi;
  expect_estimate(pictures.mean(kFromAbove + kFloor + "<emitter type=\"point\">" +
                                value("point", "position", "0 0 2") +
                                value("rgb", "intensity", "8 8 8") + "</emitter>\n"),
                  reflected * 8 / 4);
  expect_estimate(pictures.mean(kFromAbove + kFloor + "<emitter type=\"directional\">" +
                                value("vector", "direction", "0 3 -4") +
                                value("rgb", "irradiance", "5 5 5") + "</emitter>\n"),
                  reflected * 5 * 0.8);
  const std::string spot =
      "<emitter type=\"spot\"><transform name=\"toWorld\"><lookat origin=\"0,0,2\" "
      "target=\"0,0,0\" up=\"0,1,0\"/></transform>" +
      value("rgb", "intensity", "8 8 8") + "</emitter>\n";
  expect_estimate(pictures.mean(kFromAbove + kFloor + spot), reflected * 8 / 4);
}

TEST(MitsubaClosedForm, ADiskOverAFloor) {
  // Irradiance pi L R^2 / (R^2 + h^2); the disk faces down.
  Pictures pictures;
  const std::string lamp =
      "<shape type=\"disk\"><transform name=\"toWorld\"><rotate x=\"1\" angle=\"180\"/><scale "
      "value=\"1.5\"/><translate z=\"3.5\"/></transform><emitter type=\"area\">" +
      value("rgb", "radiance", "2 2 2") + "</emitter></shape>\n";
  expect_estimate(pictures.mean(kFromAbove + kFloor + lamp, 64),
                  0.6 * 2 * 1.5 * 1.5 / (1.5 * 1.5 + 3.5 * 3.5));
}

TEST(MitsubaClosedForm, AbsorptionInAMedium) {
  Pictures pictures;
  const std::string ball =
      "<shape type=\"sphere\"><medium name=\"interior\" "
      "type=\"homogeneous\">" +
      value("rgb", "sigmaA", "0.5 0.5 0.5") + value("rgb", "sigmaS", "0 0 0") +
      "</medium></shape>\n";
  expect_estimate(pictures.mean(kFromAbove + ball + "<emitter type=\"constant\"/>\n"),
                  std::exp(-1.0));
}

/// Radiance of a surface under a white sky, looked at from above.
std::string under_sky(const std::string& bsdf) {
  return kFromAbove + "<emitter type=\"constant\"/>\n<shape type=\"rectangle\">" + bsdf +
         "</shape>\n";
}

TEST(MitsubaClosedForm, LinearPlasticReflectsFresnelAndTheRestByItsColour) {
  // The sky reflects F, and by the reciprocal diffuse lobe of Mitsuba (1 - F) rho.
  Pictures pictures;
  pictures.folder().write(
      "grey.pfm", "PF\n1 1\n-1.0\n" + [] {
        const float grey[3] = {0.5f, 0.5f, 0.5f};
        return std::string(reinterpret_cast<const char*>(grey), sizeof(grey));
      }());
  const std::string indices = value("float", "intIOR", "1.5") + value("float", "extIOR", "1");
  const double expected = 0.04 + 0.96 * 0.5;
  expect_estimate(
      pictures.mean(under_sky("<bsdf type=\"plastic\">" + indices +
                              value("spectrum", "diffuseReflectance", "0.5") + "</bsdf>"),
                    64),
      expected);
  expect_estimate(
      pictures.mean(under_sky("<bsdf type=\"plastic\">" + indices +
                              "<texture name=\"diffuseReflectance\" type=\"bitmap\">" +
                              value("string", "filename", "grey.pfm") + "</texture></bsdf>"),
                    64),
      expected);
}

TEST(MitsubaClosedForm, BlendsMasksAndMirrorsUnderASky) {
  Pictures pictures;
  const std::string half =
      "<bsdf type=\"diffuse\">" + value("spectrum", "reflectance", "0.5") + "</bsdf>";
  const std::string mirror =
      "<bsdf type=\"conductor\">" + value("string", "material", "none") + "</bsdf>";
  expect_estimate(
      pictures.mean(under_sky("<bsdf type=\"blendbsdf\">" + value("float", "weight", "0.25") +
                              half + mirror + "</bsdf>"),
                    256),
      0.75 * 0.5 + 0.25);
  // Through the mask the sky below is seen.
  expect_estimate(pictures.mean(under_sky("<bsdf type=\"mask\">" +
                                          value("float", "opacity", "0.25") + half + "</bsdf>"),
                                256),
                  0.25 * 0.5 + 0.75);
  expect_estimate(
      pictures.mean(under_sky("<bsdf type=\"mixturebsdf\">" +
                              value("string", "weights", "0.5, 0.25") + half + mirror + "</bsdf>"),
                    256),
      0.25 + 0.25);
}

TEST(MitsubaConvention, APictureIsNotMirrored) {
  // Who looks along -z with +y up has +x at the right.
  Pictures pictures;
  const auto lamp = [](const std::string& at, const std::string& color) {
    return "<shape type=\"sphere\">" + value("point", "center", at) +
           value("float", "radius", "0.5") + "<emitter type=\"area\">" +
           value("rgb", "radiance", color) + "</emitter></shape>\n";
  };
  const Film film = pictures.film(
      camera("0,0,5", "0,0,0", 3, 60) + lamp("1.9, 0, 0", "1 0 0") + lamp("0, 1.9, 0", "0 1 0"),
      64);
  EXPECT_GT(film.value(2, 1).r, 0.1f);
  EXPECT_GT(film.value(1, 0).g, 0.1f);
  EXPECT_EQ(film.value(0, 1).r, 0.0f);
  EXPECT_EQ(film.value(1, 2).g, 0.0f);
}

/// A PFM file; `pixels` in rows from the top.
std::string pfm(int width, int height, const std::vector<Rgb>& pixels) {
  std::string bytes = "PF\n" + std::to_string(width) + " " + std::to_string(height) + "\n-1.0\n";
  for (int y = height - 1; y >= 0; --y)
    bytes.append(reinterpret_cast<const char*>(&pixels[static_cast<size_t>(y) * width]),
                 static_cast<size_t>(width) * sizeof(Rgb));
  return bytes;
}

TEST(MitsubaConvention, EnvironmentMapsStandAsInMitsuba) {
  // Mitsuba's place in the image of a direction v: u = atan2(v.x, -v.z) / (2 pi), v = acos(v.y) /
  // pi.
  constexpr int kWidth = 8, kHeight = 4;
  std::vector<Rgb> pixels;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      pixels.push_back({0.1f * static_cast<float>(x), 0.2f * static_cast<float>(y), 0.5f});
  Pictures pictures;
  pictures.folder().write("sky.pfm", pfm(kWidth, kHeight, pixels));
  for (const Vec3d& v : {Vec3d(1, 0.3, 0.4), Vec3d(-1, 0.5, 0.2), Vec3d(0.2, -0.8, 1),
                         Vec3d(0.3, 0.1, -1), Vec3d(-0.5, 2, -0.3), Vec3d(-0.4, -0.2, 1)}) {
    const Vec3d d = v.normalized();
    double u = std::atan2(d.x, -d.z) / (2 * 3.14159265358979);
    if (u < 0) u += 1;
    const int x = static_cast<int>(u * kWidth);
    const int y = static_cast<int>(std::acos(d.y) / 3.14159265358979 * kHeight);
    const std::string target =
        std::to_string(v.x) + "," + std::to_string(v.y) + "," + std::to_string(v.z);
    const Rgb found = pictures
                          .film(camera("0,0,0", target) + "<emitter type=\"envmap\">" +
                                    value("string", "filename", "sky.pfm") + "</emitter>\n",
                                64)
                          .value(0, 0);
    const Rgb expected = pixels[static_cast<size_t>(y * kWidth + x)];
    EXPECT_TRUE(is_color(found, expected))
        << target << ": " << found.r << " " << found.g << " " << found.b << ", expected "
        << expected.r << " " << expected.g;
  }
}

/// A shape under a white sky with an image of red, green, blue and grey: first row, then second.
std::string textured(const std::string& shape, const std::string& transform,
                     const std::string& texture = "") {
  return "<emitter type=\"constant\"/>\n<shape type=\"" + shape +
         "\"><transform name=\"toWorld\">" + transform +
         "</transform><bsdf type=\"twosided\"><bsdf type=\"diffuse\"><texture "
         "name=\"reflectance\" type=\"bitmap\">" +
         value("string", "filename", "four.pfm") + value("string", "filterType", "nearest") +
         texture + "</texture></bsdf></bsdf></shape>\n";
}
const std::vector<Rgb> kFour = {{0.8f, 0, 0}, {0, 0.8f, 0}, {0, 0, 0.8f}, {0.8f, 0.8f, 0.8f}};

TEST(MitsubaConvention, TheFirstRowOfAnImageIsAtVZero) {
  Pictures pictures;
  pictures.folder().write("four.pfm", pfm(2, 2, kFour));
  // A rectangle has uv = (0, 0) at its lower left corner (-1, -1).
  const Film film = pictures.film(camera("0,0,5", "0,0,0", 2, 2 * std::atan(0.2) * 57.29578) +
                                      textured("rectangle", "<scale value=\"1\"/>"),
                                  64);
  EXPECT_TRUE(is_color(film.value(0, 1), kFour[0]));
  EXPECT_TRUE(is_color(film.value(1, 1), kFour[1]));
  EXPECT_TRUE(is_color(film.value(0, 0), kFour[2]));
  EXPECT_TRUE(is_color(film.value(1, 0), kFour[3]));
  // Half a unit further, by offset and by transform.
  for (const std::string& moved :
       {value("float", "voffset", "0.5"),
        std::string("<transform name=\"to_uv\"><translate y=\"0.5\"/></transform>")}) {
    const Film shifted = pictures.film(camera("0,0,5", "0,0,0", 2, 2 * std::atan(0.2) * 57.29578) +
                                           textured("rectangle", "<scale value=\"1\"/>", moved),
                                       64);
    EXPECT_TRUE(is_color(shifted.value(0, 1), kFour[2]));
    EXPECT_TRUE(is_color(shifted.value(0, 0), kFour[0]));
  }
}

TEST(MitsubaConvention, SpheresHaveTheFirstRowAtPlusZ) {
  Pictures pictures;
  pictures.folder().write("four.pfm", pfm(2, 2, kFour));
  // The upper half of a sphere, seen from +x and +y: u is 1/8, in the first column.
  const auto seen = [&](const std::string& from, const std::string& at) {
    return pictures
        .film(camera(from, at, 1, 0.5, "0,0,1") + textured("sphere", "<scale value=\"1\"/>"), 64)
        .value(0, 0);
  };
  EXPECT_TRUE(is_color(seen("3,3,0.5", "0,0,0.5"), kFour[0]));
  EXPECT_TRUE(is_color(seen("3,3,-0.5", "0,0,-0.5"), kFour[2]));
  EXPECT_TRUE(is_color(seen("3,-3,0.5", "0,0,0.5"), kFour[1]));
}

TEST(MitsubaConvention, ChecksBeginWithTheFirstColour) {
  Pictures pictures;
  const std::string checks =
      "<emitter type=\"constant\"/>\n<shape type=\"rectangle\"><bsdf type=\"diffuse\"><texture "
      "name=\"reflectance\" type=\"checkerboard\">" +
      value("rgb", "color0", "0.8 0 0") + value("rgb", "color1", "0 0 0.8") +
      "</texture></bsdf></shape>\n";
  const Film film =
      pictures.film(camera("0,0,5", "0,0,0", 2, 2 * std::atan(0.2) * 57.29578) + checks, 64);
  EXPECT_TRUE(is_color(film.value(0, 1), {0.8f, 0, 0}));
  EXPECT_TRUE(is_color(film.value(1, 1), {0, 0, 0.8f}));
  EXPECT_TRUE(is_color(film.value(0, 0), {0, 0, 0.8f}));
}

TEST(MitsubaConvention, FlippedAndMirroredLampsShineAsInMitsuba) {
  // A lamp shines along its normal: +z, -z when it is flipped or mirrored at the plane of x and y.
  Pictures pictures;
  const auto seen = [&](const std::string& from, const std::string& body) {
    return pictures
        .film(camera(from, "0,0,0") + "<shape type=\"rectangle\">" + body +
                  "<emitter type=\"area\"/></shape>\n",
              4)
        .value(0, 0)
        .g;
  };
  const std::string flip = value("boolean", "flipNormals", "true");
  const std::string mirror = "<transform name=\"toWorld\"><scale z=\"-1\"/></transform>";
  const std::string mirror_x = "<transform name=\"toWorld\"><scale x=\"-1\"/></transform>";
  EXPECT_NEAR(seen("0,0,3", ""), 1, 0.1);
  EXPECT_EQ(seen("0,0,-3", ""), 0);
  EXPECT_NEAR(seen("0,0,-3", flip), 1, 0.1);
  EXPECT_EQ(seen("0,0,3", flip), 0);
  EXPECT_NEAR(seen("0,0,-3", mirror), 1, 0.1);
  EXPECT_NEAR(seen("0,0,3", mirror_x), 1, 0.1);
}

TEST(MitsubaConvention, OrthographicFilmScalesWithItsTransform) {
  Pictures pictures;
  // The film is 2 x 3 = 6 units wide: a rectangle of 2 units covers the middle of three pixels.
  const std::string sensor =
      "<sensor type=\"orthographic\"><transform name=\"toWorld\"><scale x=\"3\" y=\"3\"/><lookat "
      "origin=\"0,0,5\" target=\"0,0,0\" up=\"0,1,0\"/></transform><film type=\"hdrfilm\">" +
      value("integer", "width", "3") + value("integer", "height", "3") +
      "<rfilter type=\"box\"/></film></sensor>\n";
  const Film film =
      pictures.film(sensor + "<shape type=\"rectangle\"><emitter type=\"area\"/></shape>\n", 16);
  EXPECT_NEAR(film.value(1, 1).g, 1, 0.1);
  EXPECT_EQ(film.value(0, 1).g, 0);
  EXPECT_EQ(film.value(1, 2).g, 0);
}

/// The same picture from both formats, by a t-test.
void expect_equal_pictures(const Scene& a, const std::string& pbrt, uint32_t passes) {
  const auto b = scene_from_text(pbrt);
  const Estimate x = mean_over_seeds(a, "path", {}, 16, passes, 1);
  const Estimate y = mean_over_seeds(*b, "path", {}, 16, passes, 1000);
  EXPECT_NEAR(x.mean, y.mean, kT31 * std::hypot(x.error, y.error)) << pbrt;
  EXPECT_LT(std::hypot(x.error, y.error), max_error(0.02 * y.mean)) << "too noisy to tell";
  EXPECT_GT(y.mean, 0.01);
}

TEST(MitsubaConvention, RoughGlassAgreesWithPbrt) {
  Pictures pictures;
  const auto mine =
      pictures.scene(camera("0,0,5", "0,0,0", 8, 40) + "<emitter type=\"directional\">" +
                     value("vector", "direction", "1 -1 -1") + value("rgb", "irradiance", "3 3 3") +
                     "</emitter><shape type=\"sphere\"><bsdf "
                     "type=\"roughdielectric\">" +
                     value("float", "alpha", "0.3") + value("string", "distribution", "ggx") +
                     value("float", "intIOR", "1.5") + value("float", "extIOR", "1") +
                     "</bsdf></shape>\n" + kFloor);
  expect_equal_pictures(*mine, R"(
    Scale -1 1 1 LookAt 0 0 5  0 0 0  0 1 0
    Camera "perspective" "float fov" 40
    Film "rgb" "integer xresolution" 8 "integer yresolution" 8
    PixelFilter "box"
    WorldBegin
    LightSource "distant" "point3 from" [-1 1 1] "point3 to" [0 0 0] "rgb L" [3 3 3]
    AttributeBegin
      Material "dielectric" "float eta" 1.5 "float roughness" 0.3 "bool remaproughness" false
      Shape "sphere"
    AttributeEnd
    Material "diffuse" "rgb reflectance" [0.6 0.6 0.6]
    Scale 5 5 1
    Shape "bilinearmesh" "point3 P" [-1 -1 0  1 -1 0  -1 1 0  1 1 0]
  )",
                        32);
}

}  // namespace
}  // namespace nephroid
