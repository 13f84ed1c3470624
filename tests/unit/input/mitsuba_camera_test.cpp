// Sensors, films and media of Mitsuba, and integrators by their names.
#include <cmath>

#include "unit/input/mitsuba_files.h"
#include "unit/input/mitsuba_scene.h"

namespace nephroid::testing {
namespace {

using Numbers = std::vector<double>;

std::string film(int width, int height, const std::string& body = "") {
  return "<film type=\"hdrfilm\">" + value("integer", "width", std::to_string(width)) +
         value("integer", "height", std::to_string(height)) + body + "</film>";
}
SceneDescription with_sensor(MitsubaScene& scene, const std::string& body,
                             const std::string& type = "perspective") {
  return scene.read("<sensor type=\"" + type + "\">" + body + "</sensor>\n");
}

double fov_of(const std::string& body) {
  MitsubaScene scene;
  return number(with_sensor(scene, body).camera->parameters, "fov");
}

TEST(MitsubaCamera, AnglesOfViewBecomeThoseOfTheShorterSide) {
  const std::string wide = film(200, 100), high = film(100, 200);
  const auto half = [](double fov) { return std::tan(0.5 * fov * kDegree); };
  EXPECT_NEAR(half(fov_of(value("float", "fov", "60") + wide)), half(60) / 2, 1e-9);
  EXPECT_NEAR(fov_of(value("float", "fov", "60") + high), 60, 1e-9);
  EXPECT_NEAR(fov_of(value("float", "fov", "60") + value("string", "fovAxis", "y") + wide), 60,
              1e-9);
  EXPECT_NEAR(fov_of(value("float", "fov", "60") + value("string", "fovAxis", "smaller") + wide),
              60, 1e-9);
  EXPECT_NEAR(half(fov_of(value("float", "fov", "60") + value("string", "fovAxis", "diagonal") +
                          film(300, 400))),
              half(60) * 0.6, 1e-9);
  // 50 mm on film of 36 x 24 mm, by its diagonal; square pictures get its part along a side.
  EXPECT_NEAR(half(fov_of(film(64, 64))), std::hypot(36, 24) / 100 / std::sqrt(2), 1e-9);
}

TEST(MitsubaCamera, XIsTurnedToTheRight) {
  MitsubaScene scene;
  const SceneDescription d =
      with_sensor(scene,
                  "<transform name=\"toWorld\"><lookat origin=\"0,0,5\" target=\"0,0,0\" "
                  "up=\"0,1,0\"/></transform>");
  // Who looks along -z has +x at the right, which is +x of pbrt-v4's camera space.
  Vec3d right, ahead;
  d.camera->world_to_camera.start.multDirMatrix(Vec3d(1, 0, 0), right);
  d.camera->world_to_camera.start.multVecMatrix(Vec3d(0, 0, 0), ahead);
  EXPECT_NEAR((right - Vec3d(1, 0, 0)).length(), 0, 1e-12);
  EXPECT_NEAR((ahead - Vec3d(0, 0, 5)).length(), 0, 1e-12);
}

TEST(MitsubaCamera, ThePrincipalPointMovesTheScreen) {
  MitsubaScene scene;
  const SceneDescription d =
      with_sensor(scene, film(200, 100) + value("float", "principal_point_offset_x", "0.25") +
                             value("float", "principal_point_offset_y", "0.5"));
  EXPECT_EQ(parameter(d.camera->parameters, "screenwindow").numbers, (Numbers{-1, 3, -2, 0}));
}

TEST(MitsubaCamera, LensesHaveRadiusAndDistance) {
  MitsubaScene scene;
  const ParameterSet set =
      with_sensor(scene,
                  value("float", "apertureRadius", "0.1") + value("float", "focusDistance", "4"),
                  "thinlens")
          .camera->parameters;
  EXPECT_EQ(number(set, "lensradius"), 0.1);
  EXPECT_EQ(number(set, "focaldistance"), 4);
}

TEST(MitsubaCamera, OrthographicFilmIsTwoUnitsWide) {
  MitsubaScene scene;
  const SceneDescription d = with_sensor(scene, film(400, 200), "orthographic");
  EXPECT_EQ(parameter(d.camera->parameters, "screenwindow").numbers, (Numbers{-1, 1, -0.5, 0.5}));
}

TEST(MitsubaCamera, FilmsHaveSizeCropAndFilter) {
  MitsubaScene scene;
  const std::string crop =
      value("integer", "cropOffsetX", "10") + value("integer", "cropOffsetY", "20") +
      value("integer", "cropWidth", "30") + value("integer", "cropHeight", "5");
  const SceneDescription d = with_sensor(
      scene, film(100, 50, crop + "<rfilter type=\"tent\"/>") + "<sampler type=\"ldsampler\">" +
                 value("integer", "sampleCount", "64") + "</sampler>");
  EXPECT_EQ(number(d.film->parameters, "xresolution"), 100);
  EXPECT_EQ(parameter(d.film->parameters, "pixelbounds").numbers, (Numbers{10, 40, 20, 25}));
  EXPECT_EQ(text(d.film->parameters, "filename"), "scene.exr");
  EXPECT_EQ(d.pixel_filter->type, "triangle");
  EXPECT_EQ(number(d.pixel_filter->parameters, "xradius"), 1);
  EXPECT_EQ(number(d.sampler->parameters, "pixelsamples"), 64);
  EXPECT_NE(scene
                .error("<sensor type=\"perspective\">" +
                       film(100, 50, value("integer", "crop_width", "101")) + "</sensor>")
                .find("the crop lies outside of the film"),
            std::string::npos);
}

TEST(MitsubaCamera, TheDefaultFilterIsMitsubasGaussian) {
  MitsubaScene scene;
  const SceneDescription d = with_sensor(scene, "");
  EXPECT_EQ(d.pixel_filter->type, "gaussian");
  EXPECT_EQ(number(d.pixel_filter->parameters, "sigma"), 0.5);
  EXPECT_EQ(number(d.pixel_filter->parameters, "xradius"), 2);
  EXPECT_EQ(number(d.film->parameters, "xresolution"), 768);
  EXPECT_EQ(number(d.film->parameters, "yresolution"), 576);
}

TEST(MitsubaCamera, TheUserChoosesASensorByIdOrIndex) {
  const std::string body = "<sensor type=\"perspective\" id=\"a\">" + value("float", "fov", "30") +
                           film(9, 9) + "</sensor>\n<sensor type=\"perspective\" id=\"b\">" +
                           value("float", "fov", "40") + film(9, 9) + "</sensor>\n";
  MitsubaScene scene;
  const auto fov = [&] { return number(scene.read(body).camera->parameters, "fov"); };
  EXPECT_NEAR(fov(), 30, 1e-9);
  EXPECT_EQ(scene.read(body).choices.cameras, (std::vector<std::string>{"a", "b"}));
  scene.options.camera = "b";
  EXPECT_NEAR(fov(), 40, 1e-9);
  scene.options.camera = "1";
  EXPECT_NEAR(fov(), 40, 1e-9);
  scene.options.camera = "c";
  EXPECT_EQ(scene.error(body), "scene.xml:1:1: there is no camera \"c\", expected one of: a, b");
}

TEST(MitsubaIntegrator, NamesAndDepthsAreTranslated) {
  MitsubaScene scene;
  const SceneDescription d = scene.read("<integrator type=\"photonmapper\">" +
                                        value("integer", "maxDepth", "6") + "</integrator>\n");
  EXPECT_EQ(d.integrator->type, "sppm");
  // Six edges of a path have five scattering events.
  EXPECT_EQ(number(d.integrator->parameters, "maxdepth"), 5);
  const SceneDescription nested =
      scene.read("<integrator type=\"adaptive\"><integrator type=\"bdpt\"/></integrator>\n");
  EXPECT_EQ(nested.integrator->type, "bdpt");
  EXPECT_FALSE(has_parameter(nested.integrator->parameters, "maxdepth"));
  const SceneDescription unknown = scene.read(
      "<integrator type=\"guidedpath\">" + value("integer", "maxDepth", "32") + "</integrator>\n");
  EXPECT_EQ(number(unknown.integrator->parameters, "maxdepth"), 31);
  EXPECT_NE(scene.warnings().find("integrator \"guidedpath\" is unknown"), std::string::npos);
}

SceneDescription with_medium(MitsubaScene& scene, const std::string& medium,
                             const std::string& version = "0.6.0") {
  return scene.read("<shape type=\"sphere\">" + medium + "</shape>\n", version);
}

TEST(MitsubaMedium, CoefficientsComeInTwoForms) {
  MitsubaScene scene;
  const SceneDescription d = with_medium(
      scene, "<medium type=\"homogeneous\" name=\"interior\">" + value("rgb", "sigmaT", "1 2 4") +
                 value("rgb", "albedo", "0.5 0.25 0") + value("float", "scale", "10") +
                 "<phase type=\"hg\">" + value("float", "g", "0.3") + "</phase></medium>");
  const ParameterSet& set = d.media.at(0).parameters;
  EXPECT_EQ(d.shapes[0].inside_medium, d.media[0].name);
  EXPECT_EQ(parameter(set, "sigma_s").numbers, (Numbers{0.5, 0.5, 0}));
  EXPECT_EQ(parameter(set, "sigma_a").numbers, (Numbers{0.5, 1.5, 4}));
  EXPECT_EQ(number(set, "scale"), 10);
  EXPECT_EQ(number(set, "g"), 0.3);
  MitsubaScene other;
  const SceneDescription direct =
      with_medium(other, "<medium type=\"homogeneous\" name=\"exterior\">" +
                             value("rgb", "sigmaS", "1 2 3") + "</medium>");
  EXPECT_EQ(parameter(direct.media.at(0).parameters, "sigma_a").numbers, (Numbers{0, 0, 0}));
  EXPECT_EQ(direct.shapes[0].outside_medium, direct.media[0].name);
}

std::string grid_medium(const std::string& albedo) {
  return "<medium type=\"heterogeneous\" name=\"interior\"><volume type=\"gridvolume\" "
         "name=\"density\">" +
         value("string", "filename", "grid.vol") + "</volume>" + albedo +
         value("float", "scale", "5") + "</medium>";
}
const std::string kHalf = "<volume type=\"constvolume\" name=\"albedo\">" +
                          value("spectrum", "value", "0.5") + "</volume>";

TEST(MitsubaMedium, GridsHaveTheirValuesAtTheCornersInTheOldVersion) {
  VolumeSample sample;
  sample.max = {2, 4, 8};
  MitsubaScene scene;
  scene.folder().write("grid.vol", volume_file(sample));
  const SceneDescription d = with_medium(scene, grid_medium(kHalf));
  const ParameterSet& set = d.media.at(0).parameters;
  EXPECT_EQ(d.media[0].type, "uniformgrid");
  EXPECT_EQ(parameter(set, "density").numbers, (Numbers{0, 1, 2, 3, 4, 5, 6, 7}));
  EXPECT_EQ(parameter(set, "sigma_s").numbers, (Numbers{0.5, 0.5, 0.5}));
  // Cells about the corners: the box grows by half of the distance between them.
  EXPECT_EQ(parameter(set, "p0").numbers, (Numbers{-1, -2, -4}));
  EXPECT_EQ(parameter(set, "p1").numbers, (Numbers{3, 6, 12}));
  const SceneDescription current = with_medium(scene, grid_medium(kHalf), "3.0.0");
  EXPECT_EQ(parameter(current.media.at(0).parameters, "p0").numbers, (Numbers{0, 0, 0}));
  EXPECT_EQ(parameter(current.media.at(0).parameters, "p1").numbers, (Numbers{1, 1, 1}));
}

TEST(MitsubaMedium, ColouredAlbedosMakeAGridOfColours) {
  VolumeSample albedo;
  albedo.encoding = 3;
  albedo.channels = 3;
  albedo.values.assign(24, 1.0f);
  albedo.values[3] = 0;  // red of the second voxel, whose density is 1
  MitsubaScene scene;
  scene.folder().write("grid.vol", volume_file(VolumeSample()));
  scene.folder().write("albedo.vol", volume_file(albedo));
  const SceneDescription d =
      with_medium(scene, grid_medium("<volume type=\"gridvolume\" name=\"albedo\">" +
                                     value("string", "filename", "albedo.vol") + "</volume>"));
  EXPECT_EQ(d.media.at(0).type, "rgbgrid");
  const ParameterSet& set = d.media[0].parameters;
  EXPECT_EQ(parameter(set, "sigma_a").numbers.at(3), 1);
  EXPECT_EQ(parameter(set, "sigma_s").numbers.at(3), 0);
  EXPECT_EQ(parameter(set, "sigma_s").numbers.at(23), 7);
}

TEST(MitsubaMedium, BadVolumesAreErrors) {
  MitsubaScene scene;
  const auto error = [&](const std::string& bytes) {
    scene.folder().write("grid.vol", bytes);
    const std::string all =
        scene.error("<shape type=\"sphere\">" + grid_medium(kHalf) + "</shape>");
    return all.substr(all.find(": ") + 2);
  };
  EXPECT_EQ(error("VOX"),
            "the volume cannot be used: it does not start with VOL, expected a .vol file");
  VolumeSample half;
  half.encoding = 2;
  EXPECT_NE(error(volume_file(half)).find("of type 2"), std::string::npos);
  VolumeSample large;
  large.resolution[0] = 1 << 20;
  large.resolution[1] = 1 << 20;
  EXPECT_NE(error(volume_file(large)).find("more than the file holds"), std::string::npos);
  VolumeSample negative;
  negative.resolution[2] = -1;
  EXPECT_NE(error(volume_file(negative)).find("a resolution is -1"), std::string::npos);
  VolumeSample nan;
  nan.values[3] = NAN;
  EXPECT_NE(error(volume_file(nan)).find("a value is negative or not finite"), std::string::npos);
  VolumeSample empty;
  empty.max = empty.min;
  EXPECT_NE(error(volume_file(empty)).find("the box of the volume is empty"), std::string::npos);
  const std::string good = volume_file(VolumeSample());
  for (size_t size = 0; size < good.size(); ++size)
    EXPECT_NE(error(good.substr(0, size)).find("the volume cannot be used"), std::string::npos);
}

}  // namespace
}  // namespace nephroid::testing
