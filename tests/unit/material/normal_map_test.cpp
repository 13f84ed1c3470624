// Normal maps: the surface gets the normal stored in the image.
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "scene/material/surface_material.h"

namespace nephroid {
namespace {

std::string write_image(const std::vector<float>& pixels, int width, int height, int channels) {
  const auto path = std::filesystem::path(::testing::TempDir()) / "nephroid_normal_map_test.exr";
  const auto out = OIIO::ImageOutput::create(path.string());
  EXPECT_TRUE(out);
  EXPECT_TRUE(
      out->open(path.string(), OIIO::ImageSpec(width, height, channels, OIIO::TypeDesc::FLOAT)));
  EXPECT_TRUE(out->write_image(OIIO::TypeDesc::FLOAT, pixels.data()));
  out->close();
  return path.string();
}

/// The parameters of a material with a normal map.
ParameterSet with_map(const std::string& file) {
  Parameter p;
  p.type = "string";
  p.name = "normalmap";
  p.strings = {file};
  ParameterSet set;
  set.list = {p};
  return set;
}
TextureContext at(const Vec2f& uv) {
  TextureContext context;
  context.uv = uv;
  return context;
}

TEST(NormalMapImage, ValuesAreMappedFlippedAndRepeated) {
  // Two rows: the upper one points up, the lower one along u.
  const std::string file =
      write_image({.5f, .5f, 1, .5f, .5f, 1, 1, .5f, .5f, 1, .5f, .5f}, 2, 2, 3);
  SceneFiles files;
  const NormalMap map(with_map(file), files);
  EXPECT_EQ(map.at(at({0.25f, 0.75f})), Vec3f(0, 0, 1));
  EXPECT_EQ(map.at(at({0.25f, 0.25f})), Vec3f(1, 0, 0));
  EXPECT_EQ(map.at(at({3.25f, -0.75f})), Vec3f(1, 0, 0));
  EXPECT_EQ(map.at(at({0.25f, 0.5f})), Vec3f(0.5f, 0, 0.5f));
  std::filesystem::remove(file);
}

TEST(NormalMapImage, ScaleAndPlacement) {
  const std::string file =
      write_image({.5f, .5f, 1, .5f, .5f, 1, 1, .5f, .5f, 1, .5f, .5f}, 2, 2, 3);
  ParameterSet set = with_map(file);
  Parameter scale;
  scale.type = "float";
  scale.name = "normalmap.scale";
  scale.numbers = {0.25};
  Parameter transform = scale;
  transform.name = "normalmap.uvtransform";
  transform.numbers = {1, 0, 0, 0, 1, 0.5};
  set.list.push_back(scale);
  set.list.push_back(transform);
  SceneFiles files;
  const NormalMap map(set, files);
  EXPECT_EQ(map.at(at({0.25f, 0.25f})), Vec3f(0, 0, 1));
  EXPECT_EQ(map.at(at({0.25f, 0.75f})), Vec3f(0.25f, 0, 0));
  std::filesystem::remove(file);
}

TEST(NormalMapImage, MirroredCoordinatesMirrorTheMapIfAskedTo) {
  // Tilted along v.
  const std::string file = write_image({.5f, .8f, .9f}, 1, 1, 3);
  for (const bool handed : {false, true}) {
    SceneDescription description;
    MaterialDescription d;
    d.type = "diffuse";
    d.parameters = with_map(file);
    Parameter p;
    p.type = "bool";
    p.name = "normalmap.handedness";
    p.bools = {handed};
    d.parameters.list.push_back(p);
    description.materials = {d};
    Diagnostics diagnostics;
    const TextureLibrary textures(description, diagnostics);
    const auto made = make_materials(description, textures, {}, diagnostics);
    SurfaceInteraction s;
    s.ng = Vec3f(0, 0, 1);
    s.dpdu = s.shading_dpdu = Vec3f(1, 0, 0);
    s.dpdv = Vec3f(0, -1, 0);
    s.shading_dpdv = Vec3f(0, 1, 0);
    made[0]->bump(s);
    EXPECT_GT(s.shading.z.y * (handed ? -1.0f : 1.0f), 0.3f);
  }
  std::filesystem::remove(file);
}

TEST(NormalMapImage, TiltsTheFrameOfAMaterial) {
  const Vec3f n = normalize(Vec3f(0.3f, -0.2f, 0.9f));
  const Vec3f stored = n * 0.5f + Vec3f(0.5f);
  const std::string file = write_image({stored.x, stored.y, stored.z}, 1, 1, 3);
  SceneDescription description;
  MaterialDescription d;
  d.type = "diffuse";
  Parameter p;
  p.type = "string";
  p.name = "normalmap";
  p.strings = {file};
  d.parameters.list = {p};
  description.materials = {d};
  Diagnostics diagnostics;
  const TextureLibrary textures(description, diagnostics);
  const auto made = make_materials(description, textures, {}, diagnostics);
  SurfaceInteraction s;
  s.uv = Vec2f(0.5f, 0.5f);
  s.ng = Vec3f(0, 0, 1);
  s.dpdu = s.shading_dpdu = Vec3f(2, 0, 0);
  s.dpdv = s.shading_dpdv = Vec3f(0, 3, 0);
  made[0]->bump(s);
  EXPECT_LT(length(s.shading.z - n), 1e-5f);
  EXPECT_NEAR(length(s.shading_dpdu), 2.0f, 1e-4f);
  EXPECT_NEAR(length(s.shading_dpdv), 3.0f, 1e-4f);
  std::filesystem::remove(file);
}

TEST(NormalMapImage, BadFilesAreErrors) {
  SceneFiles files;
  EXPECT_THROW(NormalMap(with_map("no_such_image.png"), files), IoError);
  const std::string file = write_image({0.5f}, 1, 1, 1);
  EXPECT_THROW(NormalMap(with_map(file), files), SceneError);
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace nephroid
