// Materials from descriptions: every row of the table makes a BSDF with the format's defaults,
// classes are predicted, mixes choose with the right probability. Bumps tilt the frame, errors are
// located. material_kinds_test.cpp tests single materials.
#include "scene/material/material.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "unit/material/made_materials.h"

namespace nephroid {
namespace {

using namespace testing_support;

TEST(MaterialTable, EveryTypeMakesABsdfWithItsDefaults) {
  for (const MaterialRow& row : material_table()) {
    // These have no defaults: they need materials or a file (measured_material_test.cpp).
    if (std::string(row.name) == "mix" || std::string(row.name) == "measured") continue;
    const Made made({material(row.name)});
    ASSERT_EQ(made.materials.size(), 1u) << row.name;
    EXPECT_TRUE(made.diagnostics.warnings().empty()) << row.name;
    const Material& m = *made.materials[0];
    const SurfaceInteraction point = flat_point();
    EXPECT_EQ(m.resolve(point), &m);
    SampledWavelengths lambda = SampledWavelengths::sample_visible(0.3f);
    BsdfArena arena;
    const Bsdf* bsdf = m.make_bsdf(point, lambda, kSpecularAlpha, arena);
    EXPECT_FALSE(lambda.secondary_terminated()) << row.name;
    EXPECT_EQ(bsdf == nullptr, m.is_interface()) << row.name;
    if (!bsdf) {
      EXPECT_TRUE(m.transmits_straight());
      EXPECT_EQ(m.straight_transmittance(point, lambda)[0], 1.0f);
      continue;
    }
    EXPECT_EQ(bsdf->classes() & m.possible_classes(), bsdf->classes()) << row.name;
    const auto s =
        bsdf->sample(kWo, 0.5f, Vec2f(0.3f, 0.6f), TransportMode::kRadiance, ClassMask::kAll);
    ASSERT_TRUE(s) << row.name;
    EXPECT_TRUE(s->f.is_finite() && !s->f.is_black()) << row.name;
  }
}

TEST(MaterialTable, WrongScenesGetLocatedErrors) {
  EXPECT_NE(error_of({material("plastik")}).find("unknown material \"plastik\""),
            std::string::npos);
  EXPECT_NE(error_of({material("mix")}).find("expected two"), std::string::npos);
  EXPECT_NE(error_of({material("mix", {strings("string", "materials", {"a", "b"})})})
                .find("no material named \"a\""),
            std::string::npos);
  EXPECT_NE(error_of({material("mix", {strings("string", "materials", {"b", "b"})}, "a"),
                      material("mix", {strings("string", "materials", {"a", "a"})}, "b")})
                .find("mixed from itself"),
            std::string::npos);
  EXPECT_NE(error_of({material("conductor", {numbers("rgb", "reflectance", {.5, .5, .5}),
                                             numbers("float", "eta", {1.5})})})
                .find("either a reflectance or eta and k"),
            std::string::npos);
  EXPECT_NE(error_of({material("dielectric", {strings("texture", "eta", {"t"})})})
                .find("expected a float or a spectrum"),
            std::string::npos);
  EXPECT_NE(error_of({material("coateddiffuse", {numbers("integer", "maxdepth", {0})})})
                .find("expected at least 1"),
            std::string::npos);
}

TEST(MaterialTable, UnusedParametersAreReported) {
  const Made made({material("diffuse", {numbers("float", "shininess", {3})})});
  ASSERT_EQ(made.diagnostics.warnings().size(), 1u);
  EXPECT_NE(made.diagnostics.warnings()[0].message.find("shininess"), std::string::npos);
}

ClassMask classes_of(const Material& m, float specular_alpha) {
  SampledWavelengths lambda = SampledWavelengths::sample_visible(0.3f);
  BsdfArena arena;
  return m.make_bsdf(flat_point(), lambda, specular_alpha, arena)->classes();
}

TEST(PossibleClasses, AreThoseOfAllThresholdsInTheBand) {
  const SpecularBand band{0.1f, 0.3f};
  const auto rough = [](const std::string& type, double alpha) {
    return material(type, {numbers("float", "roughness", {alpha}), boolean("remaproughness", false),
                           numbers("float", "interface.roughness", {alpha}),
                           numbers("float", "conductor.roughness", {alpha})});
  };
  const ClassMask s = ClassMask::kSpecular, g = ClassMask::kGlossy;
  const std::pair<double, ClassMask> kLobe[] = {{0.0, s},     {0.05, s}, {0.1, s}, {0.2, s | g},
                                                {0.3, s | g}, {0.4, g},  {1.0, g}};
  for (const auto& [alpha, lobe] : kLobe) {
    for (const char* type :
         {"conductor", "dielectric", "subsurface", "coateddiffuse", "coatedconductor"}) {
      const Made made({rough(type, alpha)}, {band});
      const Material& m = *made.materials[0];
      const bool has_base =
          std::string(type) == "subsurface" || std::string(type) == "coateddiffuse";
      EXPECT_EQ(m.possible_classes(), has_base ? lobe | ClassMask::kDiffuse : lobe)
          << type << " " << alpha;
      EXPECT_EQ(m.possible_classes(), classes_of(m, band.low) | classes_of(m, band.high))
          << type << " " << alpha;
    }
  }
}

TEST(PossibleClasses, CoverWhatTheBsdfHas) {
  // All combinations of coat, metal, gap and index, for thresholds in the band.
  const SpecularBand band{0.1f, 0.3f};
  for (const double coat : {0.0, 0.2, 0.5})
    for (const double metal : {0.0, 0.2, 0.5})
      for (const double albedo : {0.0, 0.5})
        for (const double eta : {1.0, 1.5})
          for (const char* type :
               {"coatedconductor", "coateddiffuse", "subsurface", "dielectric"}) {
            const Made made(
                {material(type,
                          {numbers("float", "interface.roughness", {coat}),
                           numbers("float", "roughness", {coat}),
                           numbers("float", "interface.eta", {eta}), numbers("float", "eta", {eta}),
                           numbers("float", "conductor.roughness", {metal}),
                           boolean("remaproughness", false),
                           numbers("spectrum", "albedo", {200, albedo, 900, albedo})})},
                {band});
            const Material& m = *made.materials[0];
            for (const float threshold : {0.1f, 0.19f, 0.21f, 0.3f}) {
              if (std::string(type) == "dielectric" && eta == 1.0) continue;  // straight, no event
              const ClassMask classes = classes_of(m, threshold);
              EXPECT_EQ(classes & m.possible_classes(), classes)
                  << type << coat << metal << albedo << eta << threshold;
            }
          }
}

TEST(MaterialIndex, IsThePlaceInTheScene) {
  for (const bool force_diffuse : {false, true}) {
    const Made made({material("mix", {strings("string", "materials", {"metal", "wall"})}),
                     material("conductor", {}, "metal"), material("diffuse", {}, "wall"),
                     material("interface")},
                    {SpecularBand(), force_diffuse});
    for (size_t i = 0; i < made.materials.size(); ++i)
      EXPECT_EQ(made.materials[i]->index(), static_cast<int>(i));
    std::set<int> chosen;
    for (int i = 0; i < 50; ++i)
      chosen.insert(made.materials[0]
                        ->resolve(flat_point(Vec3f(static_cast<float>(i), 0.5f, 0.0f)))
                        ->index());
    EXPECT_EQ(chosen, (std::set<int>{1, 2}));
  }
}

TEST(MixMaterials, ChooseByAmountAndNest) {
  const Made made({material("mix", {strings("string", "materials", {"outer", "glass"}),
                                    numbers("float", "amount", {0.3})}),
                   material("mix", {strings("string", "materials", {"metal", "wall"})}, "outer"),
                   material("conductor", {}, "metal"), material("diffuse", {}, "wall"),
                   material("dielectric", {}, "glass")});
  const Material& mix = *made.materials[0];
  EXPECT_EQ(mix.possible_classes(), ClassMask::kDiffuse | ClassMask::kSpecular);
  int counts[3] = {0, 0, 0};
  constexpr int kCount = 20000;
  for (int i = 0; i < kCount; ++i) {
    const SurfaceInteraction point = flat_point(Vec3f(static_cast<float>(i) * 1e-3f, 0.5f, 0.0f));
    const Material* chosen = mix.resolve(point);
    EXPECT_EQ(chosen, mix.resolve(point));
    for (int m = 0; m < 3; ++m) counts[m] += chosen == made.materials[2 + m].get();
  }
  EXPECT_EQ(counts[0] + counts[1] + counts[2], kCount);
  const double p[3] = {0.35, 0.35, 0.3};
  for (int m = 0; m < 3; ++m)
    EXPECT_NEAR(counts[m], p[m] * kCount, 5.0 * std::sqrt(kCount * p[m] * (1 - p[m])));
}

// `tiles` ramps side by side, each one unit of length wide.
void expect_ramps_tilt(double tiles) {
  SceneDescription description;
  Diagnostics diagnostics;
  // Two interpolated texels: between their centres at 1/4 and 3/4 the slope is 1/2.
  const auto file = std::filesystem::path(::testing::TempDir()) / "nephroid_bump_test.exr";
  const float texels[2] = {0.0f, 0.25f};
  const auto out = OIIO::ImageOutput::create(file.string());
  ASSERT_TRUE(out && out->open(file.string(), OIIO::ImageSpec(2, 1, 1, OIIO::TypeDesc::FLOAT)));
  ASSERT_TRUE(out->write_image(OIIO::TypeDesc::FLOAT, texels));
  out->close();
  TextureDescription ramp;
  ramp.name = "ramp";
  ramp.type = "imagemap";
  ramp.value_type = "float";
  ramp.parameters.list = {strings("string", "filename", {file.string()}),
                          numbers("float", "uscale", {tiles})};
  description.textures.push_back(ramp);
  description.materials = {material("diffuse", {strings("texture", "displacement", {"ramp"})})};
  const TextureLibrary textures(description, diagnostics);
  const auto made = make_materials(description, textures, {}, diagnostics);
  ASSERT_TRUE(made[0]->has_bump());
  const auto wide_point = [&] {
    SurfaceInteraction wide = flat_point();
    wide.uv.x = 0.3f / static_cast<float>(tiles);
    wide.dpdu = wide.shading_dpdu = Vec3f(static_cast<float>(tiles), 0, 0);
    return wide;
  };
  SurfaceInteraction point = wide_point();
  made[0]->bump(point);
  const Vec3f expected = normalize(Vec3f(-0.5f, 0.0f, 1.0f));
  EXPECT_LT(length(point.shading.z - expected), 1e-3f) << tiles;
  EXPECT_NEAR(dot(point.shading.x, point.shading.z), 0.0f, 1e-5f);
  // On a flipped surface the normal stays on the outside.
  SurfaceInteraction flipped = wide_point();
  flipped.ng = Vec3f(0, 0, -1);
  flipped.shading = Frame::from_z_and_tangent(Vec3f(0, 0, -1), flipped.dpdu);
  made[0]->bump(flipped);
  EXPECT_LT(flipped.shading.z.z, 0.0f);
  std::filesystem::remove(file);
}

TEST(Bump, ARampTiltsTheNormalByItsSlope) {
  for (const double tiles : {1.0, 100.0, 2000.0}) expect_ramps_tilt(tiles);
}

// The same noise on planes of several sizes.
TEST(Bump, NoiseDoesNotDependOnTheParametrisation) {
  SceneDescription description;
  Diagnostics diagnostics;
  TextureDescription noise;
  noise.name = "noise";
  noise.type = "fbm";
  noise.value_type = "float";
  description.textures.push_back(noise);
  description.materials = {material("diffuse", {strings("texture", "displacement", {"noise"})})};
  const TextureLibrary textures(description, diagnostics);
  const auto made = make_materials(description, textures, {}, diagnostics);
  const auto normal = [&](float x, float size) {
    SurfaceInteraction point = flat_point({x, 0.4f, 0.0f});
    point.uv = point.uv * (1 / size);
    point.dpdu = point.shading_dpdu = Vec3f(size, 0, 0);
    point.dpdv = point.shading_dpdv = Vec3f(0, size, 0);
    made[0]->bump(point);
    return point.shading.z;
  };
  const Vec3f fine = normal(0.3f, 1);
  EXPECT_LT(fine.z, 0.999f);
  for (const float size : {10.0f, 1000.0f})
    EXPECT_LT(length(normal(0.3f, size) - fine), 0.05f) << size;
  // Far from the origin, steps must not drown in rounding.
  EXPECT_LT(length(normal(1000.3f, 1000) - normal(1000.3f, 10)), 0.05f);
}

}  // namespace
}  // namespace nephroid
