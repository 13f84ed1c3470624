// The conventions in which Mitsuba and pbrt-v4 differ, seen in pictures. docs/mitsuba-support.md
// has a line for each.
#include <gtest/gtest.h>

#include <cmath>

#include "agreement/mitsuba_pictures.h"

namespace nephroid {
namespace {

using namespace testing_support;

TEST(MitsubaConvention, APictureIsNotMirrored) {
  // Who looks along -z with +y up has +x at the right.
  Pictures pictures;
  const auto lamp = [](const std::string& at, const std::string& color) {
    return plugin("shape", "sphere",
                  value("point", "center", at) + value("float", "radius", "0.5") +
                      plugin("emitter", "area", value("rgb", "radiance", color)));
  };
  const Film film = pictures.film(
      camera("0,0,5", "0,0,0", 3, 60) + lamp("1.9, 0, 0", "1 0 0") + lamp("0, 1.9, 0", "0 1 0"),
      64);
  EXPECT_GT(film.value(2, 1).r, 0.1f);
  EXPECT_GT(film.value(1, 0).g, 0.1f);
  EXPECT_EQ(film.value(0, 1).r, 0.0f);
  EXPECT_EQ(film.value(1, 2).g, 0.0f);
}

/// The share of a wide film, 4 x 2 pixels, in which a lamp of half width 1 at distance 1 is seen.
double lit_share(Pictures& pictures, const std::string& axis) {
  const std::string sensor =
      plugin("sensor", "perspective",
             to_world("<lookat origin=\"0,0,1\" target=\"0,0,0\" up=\"0,1,0\"/>") +
                 value("float", "fov", "126.8699") + value("string", "fovAxis", axis) +
                 plugin("film", "hdrfilm",
                        value("integer", "width", "4") + value("integer", "height", "2") +
                            plugin("rfilter", "box")));
  const Film film =
      pictures.film(sensor + plugin("shape", "rectangle", plugin("emitter", "area")), 256);
  double sum = 0;
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 4; ++x) sum += film.value(x, y).g / 8;
  return sum;
}

TEST(MitsubaConvention, TheAngleOfViewIsAlongXUnlessSaidOtherwise) {
  // Half of the angle has tangent 2: along x the film shows 4 x 2 units, along y 8 x 4.
  Pictures pictures;
  EXPECT_NEAR(lit_share(pictures, "x"), 4.0 / 8, 0.03);
  EXPECT_NEAR(lit_share(pictures, "larger"), 4.0 / 8, 0.03);
  EXPECT_NEAR(lit_share(pictures, "y"), 4.0 / 32, 0.03);
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
  const std::string sky = plugin("emitter", "envmap", value("string", "filename", "sky.pfm"));
  for (const Vec3d& v : {Vec3d(1, 0.3, 0.4), Vec3d(-1, 0.5, 0.2), Vec3d(0.2, -0.8, 1),
                         Vec3d(0.3, 0.1, -1), Vec3d(-0.5, 2, -0.3), Vec3d(-0.4, -0.2, 1)}) {
    const Vec3d d = v.normalized();
    double u = std::atan2(d.x, -d.z) / (2 * 3.14159265358979);
    if (u < 0) u += 1;
    const int x = static_cast<int>(u * kWidth);
    const int y = static_cast<int>(std::acos(d.y) / 3.14159265358979 * kHeight);
    const std::string target =
        std::to_string(v.x) + "," + std::to_string(v.y) + "," + std::to_string(v.z);
    const Rgb found = pictures.color(camera("0,0,0", target) + sky);
    const Rgb expected = pixels[static_cast<size_t>(y * kWidth + x)];
    EXPECT_TRUE(is_color(found, expected))
        << target << ": " << found.r << " " << found.g << " " << found.b << ", expected "
        << expected.r << " " << expected.g;
  }
}

/// A shape under a white sky with an image of red, green, blue and grey: first row, then second.
std::string textured(const std::string& shape, const std::string& texture = "") {
  return plugin("emitter", "constant") +
         plugin("shape", shape,
                plugin("bsdf", "twosided",
                       plugin("bsdf", "diffuse",
                              bitmap("reflectance", "four.pfm",
                                     value("string", "filterType", "nearest") + texture))));
}
const Rgb kRed{0.8f, 0, 0}, kGreen{0, 0.8f, 0}, kBlue{0, 0, 0.8f}, kGrey{0.8f, 0.8f, 0.8f};

/// The pixels of a picture of 2 x 2, the first row first.
void expect_four(const Film& film, const std::vector<Rgb>& expected) {
  for (int i = 0; i < 4; ++i)
    EXPECT_TRUE(is_color(film.value(i % 2, i / 2), expected[static_cast<size_t>(i)])) << i;
}

TEST(MitsubaConvention, TheFirstRowOfAnImageIsAtVZero) {
  Pictures pictures;
  pictures.folder().write("four.pfm", pfm(2, 2, {kRed, kGreen, kBlue, kGrey}));
  const auto expect_image = [&](const std::string& texture, const std::vector<Rgb>& expected) {
    SCOPED_TRACE(texture);
    expect_four(pictures.film(square_from_above() + textured("rectangle", texture), 64), expected);
  };
  // A rectangle has uv = (0, 0) at its lower left corner (-1, -1).
  expect_image("", {kBlue, kGrey, kRed, kGreen});
  // Half a unit further, by offset and by transform.
  const auto to_uv = [](const std::string& elements) {
    return "<transform name=\"to_uv\">" + elements + "</transform>";
  };
  expect_image(value("float", "voffset", "0.5"), {kRed, kGreen, kBlue, kGrey});
  expect_image(to_uv("<translate y=\"0.5\"/>"), {kRed, kGreen, kBlue, kGrey});
  // A quarter turn takes (u, v) to (-v, u): the lower left corner shows what is at (-0.25, 0.25).
  expect_image(to_uv("<rotate z=\"1\" angle=\"90\"/>"), {kRed, kBlue, kGreen, kGrey});
}

TEST(MitsubaConvention, SpheresHaveTheFirstRowAtPlusZ) {
  Pictures pictures;
  pictures.folder().write("four.pfm", pfm(2, 2, {kRed, kGreen, kBlue, kGrey}));
  // The upper half of a sphere, seen from +x and +y: u is 1/8, in the first column.
  const auto seen = [&](const std::string& from, const std::string& at) {
    return pictures.color(camera(from, at, 1, 0.5, "0,0,1") + textured("sphere"));
  };
  EXPECT_TRUE(is_color(seen("3,3,0.5", "0,0,0.5"), kRed));
  EXPECT_TRUE(is_color(seen("3,3,-0.5", "0,0,-0.5"), kBlue));
  EXPECT_TRUE(is_color(seen("3,-3,0.5", "0,0,0.5"), kGreen));
}

TEST(MitsubaConvention, ChecksBeginWithTheFirstColour) {
  Pictures pictures;
  const std::string checks =
      plugin("texture", "checkerboard",
             value("rgb", "color0", "0.8 0 0") + value("rgb", "color1", "0 0 0.8"),
             "name=\"reflectance\"");
  expect_four(pictures.film(square_from_above() + plugin("emitter", "constant") +
                                plugin("shape", "rectangle", plugin("bsdf", "diffuse", checks)),
                            64),
              {kBlue, kRed, kRed, kBlue});
}

TEST(MitsubaConvention, FlippedAndMirroredLampsShineAsInMitsuba) {
  // A lamp shines along its normal: +z, -z when it is flipped or mirrored at the plane of x and y.
  Pictures pictures;
  const auto seen = [&](const std::string& from, const std::string& body) {
    return pictures
        .color(
            camera(from, "0,0,0") + plugin("shape", "rectangle", body + plugin("emitter", "area")),
            4)
        .g;
  };
  const std::string flip = value("boolean", "flipNormals", "true");
  const std::string mirror = to_world("<scale z=\"-1\"/>"),
                    mirror_x = to_world("<scale x=\"-1\"/>");
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
  const std::string sensor = plugin(
      "sensor", "orthographic",
      to_world("<scale x=\"3\" y=\"3\"/><lookat origin=\"0,0,5\" target=\"0,0,0\" up=\"0,1,0\"/>") +
          film_of(3));
  const Film film =
      pictures.film(sensor + plugin("shape", "rectangle", plugin("emitter", "area")), 16);
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
  const std::string glass =
      plugin("bsdf", "roughdielectric",
             value("float", "alpha", "0.3") + value("string", "distribution", "ggx") +
                 value("float", "intIOR", "1.5") + value("float", "extIOR", "1"));
  const auto mine = pictures.scene(
      camera("0,0,5", "0,0,0", 8, 40) +
      plugin("emitter", "directional",
             value("vector", "direction", "1 -1 -1") + value("rgb", "irradiance", "3 3 3")) +
      plugin("shape", "sphere", glass) + floor_of_0_6());
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
