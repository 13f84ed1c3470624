// Bad scenes for the real program: it locates every fault, exits with the right status and leaves
// no file behind. Faults that still allow a picture are warnings. Variants of a fault are only read
// and built, without starting the program.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <filesystem>

#include "film/image_io.h"
#include "input/scene_files.h"
#include "regression/scene_folder.h"

namespace nephroid::testing_support {
namespace {

TEST(BadSceneFile, IsAnInputErrorIfItCannotBeRead) {
  SceneFolder folder;
  folder.expect_error(kUsage, "", {"another.pbrt"});
  std::filesystem::remove(folder.path("scene.pbrt"));
  folder.expect_error(kInputOutput, "cannot read \"scene.pbrt\": No such file");
  std::filesystem::create_directory(folder.path("scene.pbrt"));
  folder.expect_error(kInputOutput, "cannot read \"scene.pbrt\": it is a directory");

  folder.write("scene.pbrt.gz", kHead);
  const ProgramRun run = run_program(folder.path("."), {"render", "scene.pbrt.gz"});
  EXPECT_EQ(run.status, kInputOutput);
  EXPECT_NE(run.errors.find("cannot read \"scene.pbrt.gz\": not valid gzip data"),
            std::string::npos)
      << run.errors;
}

TEST(BadSceneFile, IsASceneErrorIfItIsNoScene) {
  SceneFolder("").expect_error(kScene, "scene.pbrt:1:1: the scene ends before WorldBegin");
  std::string garbage(5000, '\0');
  for (size_t i = 0; i < garbage.size(); ++i) garbage[i] = static_cast<char>(i * i * 31 + i / 7);
  SceneFolder(garbage).expect_error(kScene, "scene.pbrt:1:1: the file contains NUL bytes");
  // Control characters are not passed on to the terminal.
  std::replace(garbage.begin(), garbage.end(), '\0', '\x1b');
  const ProgramRun run = SceneFolder(garbage).render();
  EXPECT_EQ(run.status, kScene);
  EXPECT_NE(run.errors.find("nephroid: error: scene.pbrt:1:1: unknown directive \"\\x1b"),
            std::string::npos)
      << run.errors;
  EXPECT_EQ(run.errors.find('\x1b'), std::string::npos);
}

TEST(BadSceneFile, APipeIsReadOnce) {
  const SceneFolder folder;
  ASSERT_EQ(mkfifo(folder.path("pipe").c_str(), 0600), 0);
  EXPECT_EQ(hash_file(folder.path("pipe")), hash_file("/dev/null"));
}

TEST(BadSyntax, IsLocated) {
  expect_scene_error("  Shpere \"sphere\"\n", "7:3: unknown directive \"Shpere\"");
  expect_scene_error("Shape \"sphere\n\"float radius\" 1\n",
                     "7:7: the string has no closing quote on its line");
  expect_scene_error("AttributeBegin\nAttributeEnd\nAttributeEnd\n",
                     "9:1: AttributeEnd without AttributeBegin");
  expect_refused("AttributeBegin\n", "7:1: AttributeBegin without AttributeEnd");
  expect_refused("ObjectBegin \"o\"\n", "7:1: ObjectBegin without ObjectEnd");
  expect_refused("Shape \"sphere\" \"float radius\" [ 1\n", "7:31: this '[' is not closed");
}

TEST(BadInclude, IsLocated) {
  expect_scene_error("Include \"absent.pbrt\"\n", "7:9: cannot read \"absent.pbrt\": No such file");
  expect_scene_error("Include \"scene.pbrt\"\n", "7:9: the file includes itself");
  SceneFolder two(kHead + "Include \"part.pbrt\"\n");
  two.write("part.pbrt", "\nImport \"scene.pbrt\"\n");
  two.expect_error(
      kScene, "part.pbrt:2:8: the file includes itself: scene.pbrt -> part.pbrt -> scene.pbrt");
}

const std::string kPly =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
    "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

void expect_ply_error(const std::string& bytes, const std::string& message) {
  SceneFolder folder(kHead + "Shape \"plymesh\" \"string filename\" \"mesh.ply\"\n");
  folder.write("mesh.ply", bytes);
  folder.expect_error(kScene, "scene.pbrt:7:1: cannot use \"mesh.ply\": " + message);
}

TEST(BadMeshFile, IsLocated) {
  expect_scene_error("Shape \"plymesh\" \"string filename\" \"absent.ply\"\n",
                     "7:1: cannot read \"absent.ply\": No such file");
  expect_ply_error(kPly.substr(0, kPly.size() - 5), "the file is too short");
  expect_ply_error(kPly.substr(0, kPly.size() - 2) + "7\n",
                   "face 0 (counted from 0): vertex index 7 is out of range");
  std::string nan = kPly;
  nan.replace(nan.find("\n0 1 0"), 6, "\n0 nan 0");
  expect_ply_error(nan, "vertex 2 (counted from 0): \"y\" is not a finite float");
}

TEST(BadMesh, IsLocated) {
  const std::string positions = "Shape \"trianglemesh\" \"point3 P\" [ 0 0 0 1 0 0 0 1 0 ] ";
  expect_scene_error(positions + "\"integer indices\" [ 0 1 3 ]\n",
                     "7:1: shape \"trianglemesh\" has the vertex index 3 in triangle 0, expected 0 "
                     "to 2");
  expect_scene_error("Shape \"trianglemesh\" \"point3 P\" [ 0 nan 0 1 0 0 0 1 0 ]\n",
                     "7:37: \"nan\" is not a finite number");
  expect_refused(positions + "\"integer indices\" [ 0 1 -1 ]\n",
                 "7:1: shape \"trianglemesh\": index -1 is negative");
  expect_refused(positions + "\"integer indices\" [ 0 1 ]\n",
                 "7:1: shape \"trianglemesh\": \"indices\" has 2 values");
  expect_refused(positions + "\"normal N\" [ 0 0 1 ]\n",
                 "7:1: shape \"trianglemesh\" has 1 normal, expected 3");
  expect_refused("Shape \"trianglemesh\" \"point3 P\" [ 0 1e39 0 ]\n",
                 "7:37: parameter \"P\" has type \"point3\", but \"1e39\" does not fit");
  expect_refused(
      "Shape \"loopsubdiv\" \"point3 P\" [ 0 0 0 1 0 0 0 1 0 ] \"integer indices\" "
      "[ 0 1 9 ]\n",
      "7:1: shape \"loopsubdiv\" has the vertex index 9");
}

TEST(BadParameter, IsLocated) {
  expect_scene_error("Shape \"sphere\" \"string radius\" \"large\"\n",
                     "7:16: parameter \"radius\" has type \"string\", expected \"float\"");
  expect_scene_error("Shape \"sphere\" \"float radius\" 0\n",
                     "7:16: shape \"sphere\": \"radius\" is 0, expected a positive number");
  expect_refused("Shape \"sphere\" \"float radius\" -1\n",
                 "7:16: shape \"sphere\": \"radius\" is -1, expected a positive number");
  expect_refused("Shape \"sphere\" \"flaot radius\" 1\n",
                 "7:16: parameter \"radius\" has the unknown type \"flaot\", expected one of");
  expect_refused("Shape \"sphere\" \"float radius\" [ 1 2 ]\n",
                 "7:16: parameter \"radius\" has 2 values, expected 1");
  expect_refused("Shape \"spere\"\n", "7:1: unknown shape \"spere\", did you mean \"sphere\"?");
}

TEST(BadMaterial, IsLocated) {
  expect_scene_error("Material \"difuse\"\n" + kTriangle,
                     "7:1: unknown material \"difuse\", did you mean \"diffuse\"?");
  expect_scene_error("NamedMaterial \"absent\"\n" + kTriangle,
                     "7:1: named material \"absent\" is not defined");
  expect_scene_error(
      "MakeNamedMaterial \"a\" \"string type\" \"mix\" \"string materials\" [ \"b\" \"b\" ]\n"
      "MakeNamedMaterial \"b\" \"string type\" \"mix\" \"string materials\" [ \"a\" \"a\" ]\n",
      "7:1: material \"a\" is mixed from itself");
  expect_refused("Material \"diffuse\" \"rgb reflectance\" [ 2 0 0 ]\n",
                 "7:20: \"rgb reflectance\" has a component above 1");
  expect_refused("Material \"dielectric\" \"float eta\" -1\n",
                 "7:23: \"eta\" is a negative refractive index");
  expect_refused("Material \"dielectric\" \"spectrum eta\" \"absent\"\n",
                 "7:23: \"absent\" is not the name of a known spectrum");
  expect_refused("Material \"conductor\" \"float roughness\" -1\n",
                 "7:22: \"roughness\" is negative");
  expect_refused("Material \"diffuse\" \"string normalmap\" \"absent.png\"\n",
                 "7:20: cannot read image \"absent.png\"");
}

// Numbers whose inverse is infinite, for colours that are looked up in tables.
TEST(DarkestColour, IsDrawn) {
  SceneFolder(kHead + "Material \"diffuse\" \"rgb reflectance\" [ 1e-45 -0 0 ]\n" + kTriangle +
              "LightSource \"infinite\" \"rgb L\" [ 0 1e-40 0 ]\n")
      .expect_picture({});
}

TEST(BadTexture, IsLocated) {
  expect_scene_error("Material \"diffuse\" \"texture reflectance\" \"absent\"\n",
                     "7:20: there is no spectrum texture named \"absent\"");
  expect_scene_error(
      "Texture \"a\" \"float\" \"scale\" \"texture tex\" \"b\"\n"
      "Texture \"b\" \"float\" \"scale\" \"texture tex\" \"a\"\n",
      "8:29: texture \"a\" refers to itself");
  expect_refused("Texture \"a\" \"float\" \"imagemap\" \"string filename\" \"absent.png\"\n",
                 "7:32: cannot read image \"absent.png\"");
  expect_refused("Texture \"a\" \"float\" \"constnat\"\n",
                 "7:1: unknown texture class \"constnat\"");
}

void expect_image_error(const std::string& lines, const std::string& name, const std::string& bytes,
                        const std::string& message) {
  SceneFolder folder(kHead + lines);
  folder.write(name, bytes);
  folder.expect_error(kScene, "scene.pbrt:" + message);
}

TEST(BadImage, IsLocated) {
  const std::string texture = "Texture \"a\" \"spectrum\" \"imagemap\" \"string filename\" ";
  expect_image_error(texture + "\"a.png\"\n", "a.png", "no png",
                     "7:35: cannot read image \"a.png\": ");
  // A header that promises far more than the file holds.
  expect_image_error(texture + "\"a.pfm\"\n", "a.pfm", "PF\n20000 20000\n-1.0\n" + kPly,
                     "7:35: image \"a.pfm\" is damaged: its header claims 20000 x 20000 pixels of "
                     "3 channels, more than the file can hold");
  expect_image_error("LightSource \"infinite\" \"string filename\" \"a.pfm\"\n", "a.pfm",
                     "PF\n3 1\n-1.0\n" + std::string(36, '\0'),
                     "7:24: the image of an infinite light is 3 x 1, expected a square");
  // The smallest normal float, little-endian.
  const std::string faint = "Pf\n1 1\n-1.0\n" + std::string("\0\0\x80\0", 4);
  const std::string sky = "LightSource \"infinite\" \"string filename\" \"a.pfm\" ";
  expect_image_error(
      sky + "\"float illuminance\" 1000\n", "a.pfm", faint,
      "7:50: the light would have to be scaled by more than 1e30 to emit this \"illuminance\"");
  expect_image_error(sky + "\"float scale\" 1e38\n", "a.pfm", faint,
                     "7:50: \"scale\" makes the light too bright for floating-point numbers, "
                     "expected at most 1e30");
}

TEST(BadTransform, IsLocated) {
  expect_scene_error("Scale 0 0 0\n", "7:1: Scale gives a singular matrix, expected");
  expect_refused("Transform [ 1 0 0 0 1 0 0 0 0 0 1 0 0 0 0 1 ]\n",
                 "7:1: Transform is a singular matrix");
  expect_refused("ConcatTransform [ 1 0 0 0 0 1 0 0 0 0 1 1 0 0 0 1 ]\n",
                 "7:1: ConcatTransform gives a projective matrix, expected");
  expect_refused("LookAt 0 0 0 0 0 0 0 1 0\n", "7:1: LookAt looks from a point to itself");
  expect_refused("Rotate 10 0 0 0\n", "7:1: the axis of Rotate is the zero vector");
}

// The ray tracer would abort the program at coordinates that it cannot represent.
TEST(FarAwayThings, AreLocated) {
  expect_scene_error("ObjectBegin \"o\"\nScale 1e-30 1e-30 1e-30\n" + kTriangle +
                         "ObjectEnd\nScale 1e30 1e30 1e30\nObjectInstance \"o\"\n",
                     "12:1: the transform of this instance is too extreme, expected");
  SceneFolder("Translate 1e30 0 0\n" + kHead + kTriangle)
      .expect_error(kScene, "scene.pbrt:5:1: the camera is too far away");
  expect_refused("Scale 1e30 1e30 1e30\n" + kTriangle,
                 "8:1: shape \"trianglemesh\" has a position that is not finite or too far away");
  expect_refused("Scale 1e30 1e30 1e30\nShape \"sphere\"\n", "8:1: shape \"sphere\" is too large");
  expect_refused("LightSource \"point\" \"point3 from\" [ 1e20 0 0 ]\n",
                 "7:1: light \"point\" is too far away");
}

TEST(BadLight, IsLocated) {
  expect_scene_error("LightSource \"point\" \"rgb I\" [ -1 1 1 ]\n",
                     "7:21: \"rgb I\" has a negative or infinite component");
  expect_scene_error("LightSource \"point\" \"float scale\" nan\n",
                     "7:35: \"nan\" is not a finite number");
  expect_refused("LightSource \"point\" \"float scale\" -1\n", "7:21: a light's \"scale\" must be");
  expect_refused("LightSource \"point\" \"spectrum I\" [ 400 1 700 -1 ]\n",
                 "7:21: \"spectrum I\" has a negative value");
  expect_refused("LightSource \"point\" \"blackbody I\" 0\n", "7:21: \"blackbody I\" needs");
  expect_refused("LightSource \"point\" \"rgb I\" [ 1e38 0 0 ] \"float scale\" 1e30\n",
                 "7:21: the light is too bright");
  expect_refused(
      "LightSource \"spot\" \"float coneangle\" 0.01 \"float conedeltaangle\" 0.001 "
      "\"float power\" 1e38\n",
      "7:72: the light would have to be scaled by more than 1e30 to emit this \"power\"");
  expect_refused("LightSource \"pont\"\n", "7:1: unknown light \"pont\", did you mean \"point\"?");
  expect_refused("AreaLightSource \"diffuse\" \"rgb L\" [ 0 -1 0 ]\n" + kTriangle,
                 "7:27: \"rgb L\" has a negative or infinite component");
  expect_refused("AreaLightSource \"diffuse\" \"float power\" 1e38\n" + kTriangle,
                 "7:27: the light would have to be scaled by more than 1e30");
}

/// kOptions with one line replaced.
std::string options_with(const std::string& directive, const std::string& line) {
  std::string text = kOptions;
  const size_t begin = text.find(directive), end = text.find('\n', begin);
  return text.replace(begin, end - begin, line);
}

TEST(BadCamera, IsLocated) {
  const auto camera = [](const std::string& text) {
    return options_with("Camera", "Camera " + text);
  };
  SceneFolder(camera("\"perspective\" \"float fov\" 180") + "WorldBegin\n")
      .expect_error(kScene, "scene.pbrt:4:1: \"fov\" must lie between 0 and 180 degrees");
  expect_refused("", "4:1: \"fov\" must lie", camera("\"perspective\" \"float fov\" 0"));
  expect_refused("", "4:1: \"lensradius\"", camera("\"perspective\" \"float lensradius\" -1"));
  expect_refused("", "4:1: unknown camera \"prespective\"", camera("\"prespective\""));
}

TEST(BadFilm, IsLocated) {
  const auto film = [](const std::string& text) { return options_with("Film", "Film " + text); };
  SceneFolder(film("\"rgb\" \"integer xresolution\" 65536 \"integer yresolution\" 65536") +
              "WorldBegin\n")
      .expect_error(kScene, "scene.pbrt:1:1: 4294967296 pixels (65536 x 65536) need about");
  expect_refused("", "1:1: the resolution 100000 x 1 must lie in 1..65536",
                 film("\"rgb\" \"integer xresolution\" 100000 \"integer yresolution\" 1"));
  expect_refused("", "1:12: \"iso\" of the film must be above 0", film("\"rgb\" \"float iso\" 0"));
  expect_refused("", "1:12: \"maxcomponentvalue\" of the film must be above 0",
                 film("\"rgb\" \"float maxcomponentvalue\" -1"));
  expect_refused("", "1:1: unknown film \"rbg\"", film("\"rbg\""));
}

// A filter that is zero everywhere would send no rays.
TEST(BadPixelFilter, IsLocated) {
  SceneFolder("PixelFilter \"gaussian\" \"float sigma\" 1e-30\n" + kHead + kTriangle)
      .expect_error(kScene, "scene.pbrt:1:1: the parameters of the pixel filter \"gaussian\"");
  for (const char* filter : {"\"sinc\" \"float tau\" 0", "\"box\" \"float xradius\" 0",
                             "\"gaussian\" \"float xradius\" 1e30", "\"tent\""})
    expect_refused("", "1:1: ", "PixelFilter " + std::string(filter) + "\n" + kOptions);
}

TEST(BadSampler, IsLocated) {
  const auto sampler = [](const std::string& t) { return options_with("Sampler", "Sampler " + t); };
  expect_refused("", "2:1: the number of pixel samples must be at least 1",
                 sampler("\"halton\" \"integer pixelsamples\" 0"));
  expect_refused("", "2:1: the number of pixel samples must be at least 1 and fit",
                 sampler("\"stratified\" \"integer xsamples\" 65536 \"integer ysamples\" 65536"));
}

TEST(NotRendered, IsALocatedError) {
  expect_scene_error(
      "AreaLightSource \"diffuse\"\nShape \"curve\" \"point3 P\" [ 0 0 0 1 0 0 1 1 0 0 1 0 ]\n",
      "7:1: a curve cannot be an area light");
  expect_scene_error("Material \"measured\"\n", "7:1: ");
  SceneFolder(options_with("Film", "Film \"spectral\"") + "WorldBegin\n")
      .expect_error(kScene, "scene.pbrt:1:1: film \"spectral\" is not rendered");
  expect_refused("LightSource \"projection\"\n", "7:1: ");
  expect_refused("Texture \"t\" \"float\" \"ptex\"\n", "7:1: texture class \"ptex\"");
  expect_refused("MediumInterface \"smoke\" \"\"\n" + kTriangle,
                 "8:1: medium \"smoke\" is not defined");
}

TEST(NotRendered, IsALocatedWarningWhereThereIsAPicture) {
  const std::string moving =
      "AttributeBegin\nActiveTransform EndTime\nTranslate 1 0 0\nActiveTransform All\n";
  const std::string scene = kHead + moving +                              // lines 7 to 10
                            "LightSource \"point\"\n" +                   // line 11
                            "Texture \"t\" \"float\" \"constant\"\n" +    // line 12
                            "AreaLightSource \"diffuse\"\n" + kTriangle;  // line 14
  SceneFolder(scene + "AttributeEnd\n")
      .expect_picture({"scene.pbrt:11:1: a light source cannot move",
                       "scene.pbrt:12:1: a texture cannot move",
                       "scene.pbrt:14:1: a shape that emits light cannot move"});
}

TEST(SuspiciousScene, IsAWarning) {
  const SceneFolder folder(
      "Integrator \"path\" \"integer maxdpth\" 3\n"
      "Film \"rgb\" \"integer xresolution\" 8 \"integer yresolution\" 8 \"string filename\" "
      "\"picture.exr\" \"float gamma\" 2\n"
      "Sampler \"holton\" \"integer pixelsamples\" 1 \"integer sets\" 1\n"
      "WorldBegin\n"
      "Shape \"sphere\" \"float radus\" 1\n"
      "LightSource \"point\" \"float power\" 1 \"float watts\" 1\n"
      "Material \"diffuse\" \"float rogue\" 1\n"
      "Texture \"t\" \"float\" \"constant\" \"float vlaue\" 1\n"
      "Shape \"trianglemesh\" \"point3 P\" [ 0 0 3 1 0 3 0 1 3 0 2 3 ] \"integer indices\" "
      "[ 0 1 2 0 2 3 0 1 3 0 1 1 ]\n"
      "Shape \"disk\" \"float innerradius\" 1\n");
  folder.expect_picture(
      {"scene.pbrt:1:19: unknown parameter \"maxdpth\"",
       "scene.pbrt:2:92: unknown parameter \"gamma\"", "scene.pbrt:3:1: unknown sampler \"holton\"",
       "scene.pbrt:3:43: unknown parameter \"sets\"",
       "scene.pbrt:5:16: unknown parameter \"radus\"",
       "scene.pbrt:6:37: unknown parameter \"watts\"",
       "scene.pbrt:7:20: unknown parameter \"rogue\"",
       "scene.pbrt:8:32: unknown parameter \"vlaue\"",
       "scene.pbrt:9:1: shape \"trianglemesh\": 2 of 4 faces have no area and were removed",
       "scene.pbrt:10:1: shape \"disk\" has no area",
       "scene.pbrt: the scene has no Camera, so a perspective camera at the origin is used"});
}

TEST(EmptyScene, IsABlackPictureAndWarnings) {
  const SceneFolder folder(kOptions.substr(0, kOptions.find("LookAt")) + "WorldBegin\n");
  folder.expect_picture({"scene.pbrt: the scene has no shapes",
                         "scene.pbrt: the scene has no light",
                         "scene.pbrt: the scene has no Camera"});
  const Picture picture = read_picture(folder.path("picture.exr"));
  EXPECT_EQ(picture.width(), 8);
  const size_t stride = picture.channels.size(),
               red = static_cast<size_t>(picture.find_channel("R"));
  for (size_t i = 0; i < picture.pixels.size(); i += stride) EXPECT_EQ(picture.pixels[i + red], 0);
}

TEST(SceneWithoutLight, IsAWarning) {
  SceneFolder(kOptions + "WorldBegin\n" + kTriangle)
      .expect_picture({"scene.pbrt: the scene has no light, the picture will be black"});
}

}  // namespace
}  // namespace nephroid::testing_support
