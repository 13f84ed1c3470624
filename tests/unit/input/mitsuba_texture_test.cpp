// Textures of Mitsuba: mappings, encodings and their uses.
#include <cmath>

#include "unit/input/mitsuba_scene.h"

namespace nephroid::testing {
namespace {

/// The first texture of a scene with a diffuse sphere.
TextureDescription texture(const std::string& type, const std::string& body) {
  MitsubaScene scene;
  return scene
      .read("<shape type=\"sphere\"><bsdf type=\"diffuse\"><texture name=\"reflectance\" type=\"" +
            type + "\">" + body + "</texture></bsdf></shape>\n")
      .textures.at(0);
}
TextureDescription bitmap(const std::string& body, const std::string& file = "a.png") {
  return texture("bitmap", value("string", "filename", file) + body);
}

/// t of pbrt-v4's uv mapping.
double t_at(const TextureDescription& t, double v) {
  return number(t.parameters, "vscale") * v + number(t.parameters, "vdelta");
}

TEST(MitsubaTexture, BitmapsShowTheSamePixel) {
  const TextureDescription t =
      bitmap(value("float", "uscale", "2") + value("float", "vscale", "3") +
             value("float", "uoffset", "0.25") + value("float", "voffset", "0.5"));
  EXPECT_EQ(t.type, "imagemap");
  EXPECT_EQ(t.value_type, "spectrum");
  EXPECT_EQ(number(t.parameters, "uscale"), 2);
  EXPECT_EQ(number(t.parameters, "udelta"), 0.25);
  // Meshes have v = 1 - v of Mitsuba, and pbrt-v4 counts rows from below: 1 - t is the place from
  // above, Mitsuba's 3 v + 0.5.
  for (const double v : {0.0, 0.3, 1.0}) EXPECT_NEAR(1 - t_at(t, 1 - v), 3 * v + 0.5, 1e-12);
}

TEST(MitsubaTexture, TransformsOfUvAreScaleAndOffset) {
  const TextureDescription t = bitmap(
      "<transform name=\"to_uv\"><scale x=\"2\" y=\"3\"/><translate x=\"0.25\" y=\"0.5\"/>"
      "</transform>");
  EXPECT_EQ(number(t.parameters, "udelta"), 0.25);
  EXPECT_NEAR(1 - t_at(t, 0.5), 2, 1e-12);
}

/// Where an image's texture coordinates (s, t) are for a mesh's (u, v), by "uvtransform".
Vec2f placed(const ParameterSet& set, const std::string& name, double u, double v) {
  const std::vector<double> m = parameter(set, name).numbers;
  return {static_cast<float>(m.at(0) * u + m.at(1) * v + m.at(2)),
          static_cast<float>(m.at(3) * u + m.at(4) * v + m.at(5))};
}

TEST(MitsubaTexture, RotationsOfUvAreLoaded) {
  const std::string turned =
      "<transform name=\"to_uv\"><rotate z=\"1\" angle=\"90\"/><scale x=\"2\" y=\"3\"/>"
      "<translate x=\"0.5\"/></transform>";
  MitsubaScene scene;
  const SceneDescription d = scene.read(
      "<bsdf type=\"normalmap\" id=\"a\"><texture type=\"bitmap\">" +
      value("string", "filename", "n.png") + turned + value("string", "wrapModeV", "clamp") +
      "</texture><bsdf type=\"diffuse\"/></bsdf>\n");
  // Mitsuba's (u, v) becomes (0.5 - 2 v, 3 u). The mesh has 1 - v, and so has the image.
  const double u = 0.3, v = 0.2;
  for (const auto& [set, name] :
       {std::pair(bitmap(turned).parameters, "uvtransform"),
        std::pair(d.materials.back().parameters, "normalmap.uvtransform")}) {
    const Vec2f st = placed(set, name, u, 1 - v);
    EXPECT_NEAR(st.x, 0.5 - 2 * v, 1e-6) << name;
    EXPECT_NEAR(1 - st.y, 3 * u, 1e-6) << name;
  }
  EXPECT_EQ(text(d.materials.back().parameters, "normalmap.vwrap"), "clamp");
  EXPECT_EQ(scene.warnings(), "");
}

TEST(MitsubaTexture, GammaAndRawAreEncodings) {
  EXPECT_FALSE(has_parameter(bitmap("").parameters, "encoding"));
  EXPECT_EQ(text(bitmap(value("float", "gamma", "1")).parameters, "encoding"), "linear");
  EXPECT_EQ(text(bitmap(value("float", "gamma", "1.8")).parameters, "encoding"), "gamma 1.8");
  EXPECT_EQ(text(bitmap(value("boolean", "raw", "true")).parameters, "encoding"), "linear");
  EXPECT_FALSE(
      has_parameter(bitmap(value("boolean", "raw", "true"), "a.exr").parameters, "encoding"));
  EXPECT_TRUE(
      has_parameter(bitmap(value("boolean", "raw", "true"), "a.jpg").parameters, "forceencoding"));
}

TEST(MitsubaTexture, BumpsAreDecodedLikeAllImages) {
  for (const bool raw : {false, true}) {
    MitsubaScene scene;
    const SceneDescription d = scene.read(
        "<bsdf type=\"bumpmap\" id=\"a\"><texture type=\"bitmap\">" +
        value("string", "filename", "b.png") + value("boolean", "raw", raw ? "true" : "false") +
        "</texture><bsdf type=\"diffuse\"/></bsdf>\n");
    EXPECT_EQ(has_parameter(d.textures.at(0).parameters, "encoding"), raw);
  }
}

TEST(MitsubaTexture, WrapAndFilterModes) {
  EXPECT_EQ(text(bitmap("").parameters, "wrap"), "repeat");
  EXPECT_EQ(text(bitmap(value("string", "wrapMode", "clamp")).parameters, "wrap"), "clamp");
  EXPECT_EQ(text(bitmap(value("string", "wrapMode", "zero")).parameters, "wrap"), "black");
  EXPECT_EQ(text(bitmap(value("string", "filterType", "nearest")).parameters, "filter"), "point");
  EXPECT_EQ(text(bitmap(value("string", "wrap_mode", "mirror")).parameters, "wrap"), "mirror");
  const ParameterSet both =
      bitmap(value("string", "wrapModeU", "clamp") + value("string", "wrapModeV", "repeat"))
          .parameters;
  EXPECT_EQ(text(both, "wrap"), "clamp");
  EXPECT_EQ(text(both, "vwrap"), "repeat");
}

TEST(MitsubaTexture, ANumberMayBeOneChannel) {
  MitsubaScene scene;
  const SceneDescription d =
      scene.read("<bsdf type=\"mask\" id=\"a\"><texture type=\"bitmap\" name=\"opacity\">" +
                 value("string", "filename", "leaf.png") + value("string", "channel", "a") +
                 "</texture><bsdf type=\"diffuse\"/></bsdf>\n");
  EXPECT_EQ(text(d.textures.at(0).parameters, "channel"), "a");
}

TEST(MitsubaTexture, ChecksAreHalfAUnitWide) {
  const TextureDescription t =
      texture("checkerboard", value("rgb", "color0", "1 0 0") + value("float", "voffset", "0.1"));
  EXPECT_EQ(parameter(t.parameters, "tex1").numbers, (std::vector<double>{1, 0, 0}));
  EXPECT_EQ(parameter(t.parameters, "tex2").numbers, (std::vector<double>{0.2, 0.2, 0.2}));
  // Mitsuba's first colour is where floor(2 u) + floor(2 v) is even; the mesh has 1 - v.
  for (const double v : {0.1, 0.3, 0.45, 0.7}) {
    const long found = std::lround(std::floor(t_at(t, 1 - v)));
    EXPECT_EQ(((found % 2) + 2) % 2, std::lround(std::floor(2 * (v + 0.1))) % 2) << v;
  }
}

TEST(MitsubaTexture, ATextureHasOneFormPerUse) {
  MitsubaScene scene;
  const SceneDescription d =
      scene.read("<texture type=\"bitmap\" id=\"t\">" + value("string", "filename", "t.png") +
                 "</texture>\n"
                 "<bsdf type=\"mask\" id=\"m\"><ref name=\"opacity\" id=\"t\"/>"
                 "<bsdf type=\"diffuse\"><ref name=\"reflectance\" id=\"t\"/></bsdf></bsdf>\n"
                 "<bsdf type=\"diffuse\" id=\"d\"><ref name=\"reflectance\" id=\"t\"/></bsdf>\n");
  ASSERT_EQ(d.textures.size(), 2u);
  EXPECT_NE(d.textures[0].value_type, d.textures[1].value_type);
  EXPECT_NE(d.textures[0].name, d.textures[1].name);
}

}  // namespace
}  // namespace nephroid::testing
