// Scenes with names of pbrt-v3: how they are converted, the warnings, and what is refused.
#include "input/pbrt_v3.h"

#include <gtest/gtest.h>

#include <cmath>

#include "unit/input/parse_text.h"

namespace nephroid {
namespace {

using testing::parse;
using testing::parse_error;
using testing::parse_warnings;

using Numbers = std::vector<double>;
using Strings = std::vector<std::string>;

const Parameter& parameter(const DirectiveDescription& directive, const std::string& name) {
  static const Parameter kNone;
  const Parameter* const found = directive.parameters.find(name);
  EXPECT_NE(found, nullptr) << name;
  return found ? *found : kNone;
}
MaterialDescription material(const std::string& text) {
  return parse("WorldBegin Material " + text).materials.at(0);
}
LightDescription light(const std::string& text) {
  return parse("WorldBegin LightSource " + text).lights.at(0);
}
ShapeDescription shape(const std::string& text) {
  return parse("WorldBegin Shape " + text).shapes.at(0);
}

TEST(PbrtV3, IsSaidOnceWithThePlaceOfTheFirst) {
  const std::string scene =
      "Film \"image\"\nWorldBegin\nMaterial \"matte\" \"color Kd\" [.1 .2 .3]\n"
      "Material \"matte\"\nWorldEnd";
  EXPECT_EQ(parse_warnings(scene),
            "t.pbrt:1:1: the scene has names of pbrt-v3, upgraded to pbrt-v4: "
            "Film \"image\" is \"rgb\"; parameter type \"color\" is \"rgb\"; "
            "Material \"matte\" is \"diffuse\"; WorldEnd is not needed\n");
  EXPECT_EQ(parse_warnings("Film \"rgb\" WorldBegin Material \"diffuse\""), "");
}

TEST(PbrtV3, OptionsOfTheRender) {
  const SceneDescription scene = parse(
      "SurfaceIntegrator \"path\" \"integer maxdepth\" 3 \"float rrthreshold\" 1\n"
      "Sampler \"lowdiscrepancy\" \"integer pixelsamples\" 8\n"
      "PixelFilter \"gaussian\" \"float xwidth\" 3 \"float alpha\" 8\n"
      "Film \"image\" \"float scale\" 2 \"float maxsampleluminance\" 5\n"
      "Camera \"environment\" WorldBegin");
  EXPECT_EQ(scene.integrator->type, "path");
  EXPECT_EQ(scene.integrator->parameters.list.size(), 1u);
  EXPECT_EQ(scene.sampler->type, "paddedsobol");
  EXPECT_EQ(scene.pixel_filter->parameters.get_float("xradius", 0), 3);
  EXPECT_EQ(scene.pixel_filter->parameters.get_float("sigma", 0), 0.25f);
  EXPECT_EQ(scene.film->type, "rgb");
  EXPECT_EQ(scene.film->parameters.get_float("iso", 0), 200);
  EXPECT_EQ(scene.film->parameters.get_float("maxcomponentvalue", 0), 5);
  EXPECT_EQ(scene.camera->type, "spherical");
  EXPECT_EQ(scene.camera->parameters.get_string("mapping", ""), "equirectangular");
  EXPECT_EQ(parse("Sampler \"random\" WorldBegin").sampler->type, "independent");
}

TEST(PbrtV3, MaterialsThatAreTheSame) {
  const MaterialDescription matte =
      material("\"matte\" \"rgb Kd\" [.1 .2 .3] \"float sigma\" 0 \"texture bumpmap\" \"b\"");
  EXPECT_EQ(matte.type, "diffuse");
  EXPECT_EQ(parameter(matte, "reflectance").numbers, (Numbers{.1, .2, .3}));
  EXPECT_EQ(parameter(matte, "displacement").strings, Strings{"b"});
  EXPECT_EQ(matte.parameters.list.size(), 2u);

  const MaterialDescription glass = material("\"glass\" \"float index\" 1.3 \"rgb Kr\" [1 1 1]");
  EXPECT_EQ(glass.type, "dielectric");
  EXPECT_EQ(glass.parameters.get_float("eta", 0), 1.3f);
  EXPECT_EQ(glass.parameters.list.size(), 1u);

  const MaterialDescription mirror = material("\"mirror\"");
  EXPECT_EQ(mirror.type, "conductor");
  EXPECT_EQ(parameter(mirror, "eta").strings, Strings{"metal-Ag-eta"});
  EXPECT_EQ(parameter(mirror, "k").strings, Strings{"metal-Ag-k"});
  EXPECT_EQ(parameter(material("\"mirror\" \"rgb Kr\" [.9 .5 .5]"), "reflectance").numbers,
            (Numbers{.9, .5, .5}));

  const MaterialDescription plastic =
      material("\"plastic\" \"rgb Ks\" [0 0 0] \"float roughness\" 1");
  EXPECT_EQ(plastic.type, "diffuse");
  EXPECT_EQ(parameter(plastic, "reflectance").numbers, (Numbers{.25, .25, .25}));
  EXPECT_EQ(plastic.parameters.list.size(), 1u);

  const MaterialDescription sheet = material(
      "\"translucent\" \"rgb Kd\" [1 .5 0] \"rgb Ks\" [0 0 0] \"rgb transmit\" [.2 .2 .2]");
  EXPECT_EQ(sheet.type, "diffusetransmission");
  EXPECT_EQ(parameter(sheet, "reflectance").numbers, (Numbers{.5, .25, 0}));
  EXPECT_EQ(parameter(sheet, "transmittance").numbers, (Numbers{.2, .1, 0}));

  const MaterialDescription skin = material("\"kdsubsurface\" \"texture Kd\" \"t\"");
  EXPECT_EQ(skin.type, "subsurface");
  EXPECT_EQ(skin.parameters.get_float("eta", 0), 1.3f);
}

// The microfacet alpha is kept: pbrt-v4 takes the square root of a roughness.
TEST(PbrtV3, RoughnessGivesTheSameMicrofacets) {
  const auto alpha = [](const std::string& text) {
    return std::sqrt(material(text).parameters.get_float("roughness", -1));
  };
  EXPECT_NEAR(alpha("\"metal\""), 0.1390, 1e-3) << "pbrt-v3's default is 0.01";
  EXPECT_NEAR(alpha("\"metal\" \"float roughness\" 0.1"), 0.4616, 1e-3);
  EXPECT_NEAR(alpha("\"glass\" \"float roughness\" 1"), 1.62142, 1e-4);
  EXPECT_EQ(alpha("\"glass\" \"float roughness\" 0"), 0);
  EXPECT_NE(parse_warnings("WorldBegin Material \"metal\"").find("\"roughness\" is converted"),
            std::string::npos);
  EXPECT_NE(parse_warnings("WorldBegin Material \"glass\" \"texture roughness\" \"t\"")
                .find("\"texture roughness\" is remapped as in pbrt-v4"),
            std::string::npos);
  EXPECT_EQ(alpha("\"metal\" \"float roughness\" 0.25 \"bool remaproughness\" false"), 0.5f);
}

TEST(PbrtV3, NamedMaterialsAndMixtures) {
  const SceneDescription scene = parse(
      "WorldBegin MakeNamedMaterial \"a\" \"string type\" \"matte\"\n"
      "MakeNamedMaterial \"b\" \"string type\" \"mirror\"\n"
      "MakeNamedMaterial \"c\" \"string type\" \"mix\" \"rgb amount\" [.3 .3 .3]\n"
      "  \"string namedmaterial1\" \"a\" \"string namedmaterial2\" \"b\"");
  EXPECT_EQ(scene.materials.at(0).type, "diffuse");
  EXPECT_EQ(scene.materials.at(1).type, "conductor");
  EXPECT_EQ(parameter(scene.materials.at(2), "materials").strings, (Strings{"b", "a"}));
  EXPECT_EQ(scene.materials.at(2).parameters.get_float("amount", 0), 0.3f);
}

TEST(PbrtV3, MaterialsThatAreNotTheSameAreRefusedWithThePbrtV4Way) {
  EXPECT_EQ(parse_error("WorldBegin\nMaterial \"plastic\""),
            "t.pbrt:2:1: pbrt-v3 material \"plastic\" cannot be upgraded: pbrt-v4 has no "
            "counterpart to its \"Ks\" (set by default), expected Material \"coateddiffuse\" with "
            "\"reflectance\" and \"roughness\", "
            "or \"Ks\" 0");
  EXPECT_EQ(
      parse_error("WorldBegin\nMaterial \"matte\" \"float sigma\" 20"),
      "t.pbrt:2:18: pbrt-v3 material \"matte\" cannot be upgraded: pbrt-v4 has no counterpart "
      "to its \"sigma\", expected Material \"diffuse\", which has no \"sigma\"");
  for (const std::string type : {"uber", "substrate", "translucent", "disney", "fourier"}) {
    const std::string error = parse_error("WorldBegin\nMaterial \"" + type + "\"");
    EXPECT_EQ(error.find("t.pbrt:2:1: pbrt-v3 material \"" + type + "\" cannot be upgraded: "), 0u)
        << error;
    EXPECT_NE(error.find("expected Material \""), std::string::npos) << error;
  }
  EXPECT_EQ(parse_error("WorldBegin Material \"glass\" \"rgb Kt\" [1 .5 .5]")
                .find("t.pbrt:1:29: pbrt-v3 material \"glass\" cannot be upgraded: pbrt-v4 has no "
                      "counterpart to its \"Kt\""),
            0u);
}

TEST(PbrtV3, TextureCoordinates) {
  EXPECT_EQ(
      parse_warnings("WorldBegin Shape \"trianglemesh\"\n  \"float st\" [0 0 1 0 0 1]"),
      "t.pbrt:2:3: the scene has names of pbrt-v3, upgraded to pbrt-v4: Shape \"float st\" is "
      "\"point2 uv\"\n");
  for (const std::string name : {"float st", "float uv", "point2 st"}) {
    const ShapeDescription mesh = shape("\"trianglemesh\" \"" + name + "\" [0 0 1 0 0 1]");
    EXPECT_EQ(mesh.parameters.get_point2s("uv").size(), 3u) << name;
  }
  EXPECT_EQ(shape("\"loopsubdiv\" \"integer nlevels\" 2").parameters.get_int("levels", 0), 2);
  EXPECT_EQ(shape("\"trianglemesh\" \"float shadowalpha\" 1").parameters.list.size(), 0u);
  EXPECT_NE(parse_error("WorldBegin Shape \"trianglemesh\" \"texture shadowalpha\" \"a\"")
                .find("is pbrt-v3's, expected \"alpha\", which counts for all rays"),
            std::string::npos);
}

TEST(PbrtV3, Lights) {
  const LightDescription sky = light(
      "\"infinite\" \"string mapname\" \"a.exr\" \"integer samples\" 4 \"rgb L\" [2 2 2] "
      "\"rgb scale\" [3 3 3]");
  EXPECT_EQ(sky.parameters.get_string("filename", ""), "a.exr");
  EXPECT_EQ(sky.parameters.get_float("scale", 0), 6);
  EXPECT_EQ(sky.parameters.list.size(), 2u);
  const LightDescription lamp = light("\"point\" \"blackbody I\" [3000 5] \"float scale\" 2");
  EXPECT_EQ(parameter(lamp, "I").numbers, Numbers{3000});
  EXPECT_EQ(lamp.parameters.get_float("scale", 0), 10);
  EXPECT_NE(parse_error("WorldBegin LightSource \"point\" \"rgb scale\" [1 2 3]")
                .find("t.pbrt:1:32: parameter \"rgb scale\" of light \"point\" is pbrt-v3's, "
                      "expected \"float scale\""),
            std::string::npos);
  const SceneDescription scene =
      parse("WorldBegin AreaLightSource \"area\" \"integer nsamples\" 4 Shape \"sphere\"");
  EXPECT_EQ(scene.shapes.at(0).area_light->type, "diffuse");
  EXPECT_TRUE(scene.shapes.at(0).area_light->parameters.list.empty());
}

TEST(PbrtV3, TexturesAndMedia) {
  const auto texture = [](const std::string& text) {
    return parse("WorldBegin Texture \"t\" " + text).textures.at(0);
  };
  const TextureDescription image = texture(
      "\"color\" \"imagemap\" \"string filename\" \"a.png\" \"bool gamma\" false "
      "\"bool trilinear\" true");
  EXPECT_EQ(image.value_type, "spectrum");
  EXPECT_EQ(image.parameters.get_string("encoding", ""), "linear");
  EXPECT_EQ(image.parameters.get_string("filter", ""), "trilinear");
  const TextureDescription scale =
      texture("\"color\" \"scale\" \"rgb tex1\" [.5 .5 .5] \"texture tex2\" \"i\"");
  EXPECT_EQ(scale.parameters.get_float("scale", 0), 0.5f);
  EXPECT_EQ(parameter(scale, "tex").strings, Strings{"i"});
  EXPECT_NE(parse_error("WorldBegin Texture \"t\" \"spectrum\" \"scale\" \"texture tex1\" \"a\" "
                        "\"texture tex2\" \"b\"")
                .find("is pbrt-v3's, expected \"tex\" and \"float scale\""),
            std::string::npos);
  EXPECT_EQ(
      parse("MakeNamedMedium \"m\" \"string type\" \"heterogeneous\" WorldBegin").media.at(0).type,
      "uniformgrid");
}

}  // namespace
}  // namespace nephroid
