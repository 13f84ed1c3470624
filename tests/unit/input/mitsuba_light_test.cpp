// Emitters and colours of Mitsuba: types, units and frames.
#include <cmath>

#include "core/color.h"
#include "core/spectra.h"
#include "input/mitsuba/sky_emitters.h"
#include "input/mitsuba/sun_position.h"
#include "input/sky/hosek_wilkie_sky.h"
#include "input/sky/preetham_sun.h"
#include "unit/input/mitsuba_scene.h"

namespace nephroid::testing {
namespace {

using Numbers = std::vector<double>;

std::string emitter(const std::string& type, const std::string& body = "") {
  return "<emitter type=\"" + type + "\">" + body + "</emitter>\n";
}

LightDescription light(const std::string& type, const std::string& body = "",
                       const std::string& version = "0.6.0") {
  MitsubaScene scene;
  return scene.read(emitter(type, body), version).lights.at(0);
}

TEST(MitsubaLight, RadiancesAreLinearRgbAndWhiteByDefault) {
  EXPECT_EQ(parameter(light("constant").parameters, "L").numbers, (Numbers{1, 1, 1}));
  EXPECT_EQ(parameter(light("constant", value("rgb", "radiance", "5 6 7")).parameters, "L").numbers,
            (Numbers{5, 6, 7}));
  const Numbers coded =
      parameter(light("constant", value("srgb", "radiance", "#ff8000")).parameters, "L").numbers;
  EXPECT_NEAR(coded[0], 1, 1e-9);
  EXPECT_NEAR(coded[1], 0.2158605, 1e-6);
  EXPECT_NEAR(coded[2], 0, 1e-9);
}

TEST(MitsubaLight, AConstantSpectrumIsWhiteInTheOldVersionAndEqualEnergyInTheNewOne) {
  const std::string body = value("spectrum", "radiance", "3");
  EXPECT_EQ(parameter(light("constant", body).parameters, "L").numbers, (Numbers{3, 3, 3}));
  const LightDescription energy = light("constant", body, "3.0.0");
  EXPECT_EQ(parameter(energy.parameters, "L").type, "spectrum");
  EXPECT_NEAR(number(energy.parameters, "scale"), 3, 1e-4);
}

TEST(MitsubaLight, SpectraKeepTheirLuminance) {
  const LightDescription l = light("constant", value("spectrum", "radiance", "500:2, 600:4"));
  const SpectrumPtr spectrum = piecewise_linear_spectrum({500, 600}, {2, 4});
  EXPECT_EQ(parameter(l.parameters, "L").numbers, (Numbers{500, 2, 600, 4}));
  EXPECT_NEAR(number(l.parameters, "scale"), spectrum_to_xyz(*spectrum).y, 1e-6);
}

TEST(MitsubaLight, BlackBodiesHaveTheRadianceOfPlanck) {
  const LightDescription l =
      light("constant", "<blackbody name=\"radiance\" temperature=\"5000K\" scale=\"0.5\"/>");
  EXPECT_EQ(parameter(l.parameters, "L").numbers, (Numbers{5000}));
  // 2 h c^2 / lambda^5 / (exp(h c / (lambda k T)) - 1) at 560 nm is 1.27e4 W / (m^2 sr nm), near
  // the maximum: the mean over the luminous efficiency is a little less.
  EXPECT_NEAR(number(l.parameters, "scale"), 0.5 * 1.26e4, 0.5 * 0.02e4);
}

TEST(MitsubaLight, SpectraOfFilesAreRead) {
  MitsubaScene scene;
  scene.folder().write("lamp.spd", "# lamp\n400 1\n700 1 # end\n");
  const SceneDescription d =
      scene.read(emitter("constant", "<spectrum name=\"radiance\" filename=\"lamp.spd\"/>"));
  EXPECT_EQ(parameter(d.lights[0].parameters, "L").numbers, (Numbers{400, 1, 700, 1}));
  EXPECT_NE(scene.error(emitter("constant", "<spectrum name=\"radiance\" filename=\"no.spd\"/>"))
                .find("scene.xml:2:26: "),
            std::string::npos);
}

TEST(MitsubaLight, SpectraOfPluginsAreRead) {
  const auto radiance = [](const std::string& type, const std::string& body) {
    return light("constant",
                 "<spectrum name=\"radiance\" type=\"" + type + "\">" + body + "</spectrum>",
                 "3.0.0")
        .parameters;
  };
  EXPECT_EQ(parameter(radiance("d65", value("float", "scale", "4")), "L").numbers,
            (Numbers{4, 4, 4}));
  EXPECT_EQ(parameter(radiance("srgb", value("rgb", "color", "1 2 3")), "L").numbers,
            (Numbers{1, 2, 3}));
  EXPECT_EQ(parameter(radiance("regular", value("float", "wavelength_min", "400") +
                                              value("float", "wavelength_max", "500") +
                                              value("string", "values", "1, 2, 3")),
                      "L")
                .numbers,
            (Numbers{400, 1, 450, 2, 500, 3}));
  EXPECT_EQ(parameter(radiance("irregular", value("string", "wavelengths", "400, 600") +
                                                value("string", "values", "0.125, 2")),
                      "L")
                .numbers,
            (Numbers{400, 0.125, 600, 2}));
  EXPECT_EQ(parameter(radiance("blackbody", value("float", "temperature", "3000")), "L").numbers,
            (Numbers{3000}));
}

TEST(MitsubaLight, WrongSpectraAreErrors) {
  MitsubaScene scene;
  const auto error = [&](const std::string& text) {
    return scene.error(emitter("constant", "\n" + value("spectrum", "radiance", text)));
  };
  EXPECT_EQ(
      error("500:1, 400:2"),
      "scene.xml:3:1: the wavelengths of a spectrum do not increase, expected increasing ones");
  EXPECT_EQ(error("500:1, 600"),
            "scene.xml:3:1: a spectrum has \"600\", expected WAVELENGTH:VALUE");
  EXPECT_EQ(error("500:inf"),
            "scene.xml:3:1: a value of a spectrum is \"inf\", expected a finite number");
  EXPECT_EQ(error(""),
            "scene.xml:3:1: property \"radiance\" has 0 numbers, expected one, or pairs "
            "WAVELENGTH:VALUE");
}

TEST(MitsubaLight, PointsStandAtTheirPosition) {
  const LightDescription l = light("point", value("point", "position", "1 2 3"));
  EXPECT_EQ(parameter(l.parameters, "from").numbers, (Numbers{1, 2, 3}));
}

TEST(MitsubaLight, SpotsHaveAConeWithAnEdge) {
  const LightDescription l = light("spot", value("float", "cutoffAngle", "40"));
  EXPECT_EQ(number(l.parameters, "coneangle"), 40);
  EXPECT_EQ(number(l.parameters, "conedeltaangle"), 10);
}

TEST(MitsubaLight, DirectionalLightTravelsInItsDirection) {
  const LightDescription l = light("directional", value("vector", "direction", "0, -1, 0"));
  EXPECT_EQ(parameter(l.parameters, "from").numbers, (Numbers{0, 0, 0}));
  EXPECT_EQ(parameter(l.parameters, "to").numbers, (Numbers{0, -1, 0}));
}

TEST(MitsubaLight, AreaLightsBelongToShapes) {
  MitsubaScene scene;
  const SceneDescription d =
      scene.read("<shape type=\"sphere\">" + emitter("area", value("rgb", "radiance", "1 2 3")) +
                 "</shape>\n");
  EXPECT_EQ(d.shapes[0].area_light->type, "diffuse");
  EXPECT_EQ(parameter(d.shapes[0].area_light->parameters, "L").numbers, (Numbers{1, 2, 3}));
  EXPECT_NE(scene.error(emitter("area")).find("stands outside of a shape"), std::string::npos);
  EXPECT_NE(scene.error("<shape type=\"sphere\">" + emitter("point") + "</shape>\n")
                .find("stands in a shape"),
            std::string::npos);
}

/// The name of the lamp of the first shape.
std::string name_of_lamp(const std::string& id_of_shape, const std::string& id_of_emitter) {
  MitsubaScene scene;
  const SceneDescription d = scene.read("<shape type=\"sphere\"" + id_of_shape +
                                        "><emitter type=\"area\"" + id_of_emitter + "/></shape>\n");
  return d.shapes.at(0).area_light->parameters.get_string("name", "");
}

TEST(MitsubaLight, LampsHaveTheIdOfTheEmitterOrOfTheShape) {
  EXPECT_EQ(name_of_lamp("", ""), "");
  EXPECT_EQ(name_of_lamp(" id=\"bulb\"", ""), "bulb");
  EXPECT_EQ(name_of_lamp(" id=\"bulb\"", " id=\"glow\""), "glow");
  MitsubaScene scene;
  const SceneDescription d = scene.read("<emitter type=\"point\" id=\"key\"/>\n");
  EXPECT_EQ(d.lights.at(0).parameters.get_string("name", ""), "key");
}

Vec3d in_world(const LightDescription& l, const Vec3d& local) {
  Vec3d world;
  l.transform.start.multDirMatrix(local, world);
  return world;
}

TEST(MitsubaLight, EnvironmentsHaveYUpAndTheirLeftEdgeAtMinusZ) {
  const std::string file = value("string", "filename", "sky.exr");
  const LightDescription l = light("envmap", file);
  // pbrt-v4's map: +z at the top, the left edge at +x, the first quarter at +y.
  EXPECT_EQ(in_world(l, {0, 0, 1}), Vec3d(0, 1, 0));
  EXPECT_EQ(in_world(l, {1, 0, 0}), Vec3d(0, 0, -1));
  EXPECT_EQ(in_world(l, {0, 1, 0}), Vec3d(1, 0, 0));
  const LightDescription turned = light(
      "envmap", file + "<transform name=\"toWorld\"><rotate x=\"1\" angle=\"90\"/></transform>");
  EXPECT_NEAR((in_world(turned, {0, 0, 1}) - Vec3d(0, 0, 1)).length(), 0, 1e-12);
}

TEST(MitsubaSky, TheSunOfTokyoInJulyStandsInTheWest) {
  // Sunrise equation at 15:00 of UTC+9, whose meridian is 4.69 degrees to the west of Tokyo; the
  // equation of time is -5.5 minutes, the declination 22.2 degrees.
  const mitsuba::SunPosition sun = mitsuba::sun_position({});
  const double hour_angle = (15 - 12 + 4.6917 / 15 - 5.5 / 60) * 15 * kDegree;
  const double latitude = 35.6894 * kDegree, declination = 22.2 * kDegree;
  const double sine = std::sin(latitude) * std::sin(declination) +
                      std::cos(latitude) * std::cos(declination) * std::cos(hour_angle);
  EXPECT_NEAR(sun.zenith / kDegree, 90 - std::asin(sine) / kDegree, 0.3);
  const double south_west =
      std::atan2(std::sin(hour_angle), std::sin(latitude) * std::cos(hour_angle) -
                                           std::tan(declination) * std::cos(latitude));
  EXPECT_NEAR(sun.azimuth / kDegree, 180 + south_west / kDegree, 0.5);
}

TEST(MitsubaSky, TheClearSkyIsBlueAndBrighterNearTheSun) {
  const HosekWilkieSky sky(3, Vec3d(0.2), 50 * kDegree);
  const Rgb away = sky.radiance(30 * kDegree, 70 * kDegree);
  EXPECT_GT(away.b, 1.5f * away.r);
  EXPECT_GT(sky.radiance(40 * kDegree, 2 * kDegree).g, 2 * away.g);
  // Hazy skies are whiter.
  const HosekWilkieSky haze(9, Vec3d(0.2), 50 * kDegree);
  const Rgb white = haze.radiance(30 * kDegree, 70 * kDegree);
  EXPECT_LT(white.b / white.r, away.b / away.r);
  // Illuminance of the ground: some 10 to 20 klx of clear sky (683 lm/W at 107 nm of width).
  double illuminance = 0;
  for (double theta = 0.5; theta < 90; ++theta)
    illuminance += sky.radiance(theta * kDegree, 60 * kDegree).g * 2 * kPi *
                   std::sin(theta * kDegree) * std::cos(theta * kDegree) * kDegree * 683 *
                   kCieYIntegral;
  EXPECT_GT(illuminance, 5e3);
  EXPECT_LT(illuminance, 4e4);
}

TEST(MitsubaSky, TheSunGivesAHundredThousandLuxAndReddensAtTheHorizon) {
  const Rgb high = sun_radiance(20 * kDegree, 2);
  const double solid_angle = 2 * kPi * (1 - std::cos(0.5 * 0.5358 * kDegree));
  const double lux = RgbColorSpace::srgb().to_xyz(high).y * solid_angle * 683 * kCieYIntegral;
  EXPECT_GT(lux, 8e4);
  EXPECT_LT(lux, 1.3e5);
  const Rgb low = sun_radiance(85 * kDegree, 2);
  EXPECT_LT(low.b / low.r, 0.5f * high.b / high.r);
}

TEST(MitsubaSky, SunAndSkyAreTwoLights) {
  MitsubaScene scene;
  const SceneDescription d = scene.read(emitter(
      "sunsky", value("vector", "sunDirection", "0, 1, 1") + value("float", "sunRadiusScale", "2") +
                    value("float", "skyScale", "3")));
  ASSERT_EQ(d.lights.size(), 2u);
  EXPECT_EQ(d.lights[0].type, "distant");
  EXPECT_EQ(d.lights[0].parameters.get_string("name", ""), "sun");
  EXPECT_EQ(d.lights[1].parameters.get_string("name", ""), "sky");
  const Numbers from = parameter(d.lights[0].parameters, "from").numbers;
  EXPECT_NEAR(from[1], std::sqrt(0.5), 1e-9);
  EXPECT_NEAR(from[2], std::sqrt(0.5), 1e-9);
  EXPECT_NEAR(number(d.lights[0].parameters, "angle"), 2 * 0.5358, 1e-9);
  EXPECT_EQ(d.lights[1].type, "infinite");
  EXPECT_EQ(number(d.lights[1].parameters, "scale"), 3);
  EXPECT_EQ(scene.error(emitter("sky", value("vector", "sunDirection", "0 -1 0"))),
            "scene.xml:2:1: the sun is below the horizon, expected it above");
}

TEST(MitsubaSky, SkiesOfTheNewVersionHaveZUp) {
  MitsubaScene scene;
  const SceneDescription d =
      scene.read(emitter("sunsky", value("vector", "sun_direction", "0, 0, 1")), "3.5.0");
  Vec3d to_sun;
  const Numbers from = parameter(d.lights[0].parameters, "from").numbers;
  d.lights[0].transform.start.multDirMatrix(Vec3d(from[0], from[1], from[2]), to_sun);
  EXPECT_NEAR((to_sun - Vec3d(0, 0, 1)).length(), 0, 1e-9);
}

}  // namespace
}  // namespace nephroid::testing
