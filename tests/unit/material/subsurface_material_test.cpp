// The material "subsurface" from scene text: every description of the medium, the boundary's
// roughness, and located errors.
#include <gtest/gtest.h>

#include "input/pbrt_parser.h"
#include "scene/bsdf/dielectric.h"
#include "scene/bsdf/tabulated_bssrdf.h"
#include "scene/material/material.h"

namespace nephroid {
namespace {

struct MadeSubsurface {
  Diagnostics diagnostics;
  MaterialPtr material;

  explicit MadeSubsurface(const std::string& parameters) {
    const SceneDescription d = parse_pbrt_string(
        "WorldBegin\nMaterial \"subsurface\" " + parameters + "\nShape \"sphere\"", "t.pbrt", ".",
        diagnostics);
    const TextureLibrary textures(d, diagnostics);
    material = make_materials(d, textures, {}, diagnostics).back();
  }
};

SurfaceInteraction plain_point() {
  SurfaceInteraction s;
  s.p = Vec3f(0.3f, 0.4f, 0.0f);
  s.ng = Vec3f(0, 0, 1);
  s.wo = Vec3f(0, 0, 1);
  s.dpdu = s.shading_dpdu = Vec3f(1, 0, 0);
  s.dpdv = s.shading_dpdv = Vec3f(0, 1, 0);
  return s;
}

SampledWavelengths test_wavelengths() {
  return SampledWavelengths::sample_visible(0.3f);
}

/// Sp at distance r.
SampledSpectrum profile_of(const MadeSubsurface& made, float r,
                           const SampledWavelengths& lambda = test_wavelengths()) {
  BsdfArena arena;
  const SurfaceInteraction point = plain_point();
  const Bssrdf* below = made.material->make_bssrdf(point, lambda, arena);
  EXPECT_NE(below, nullptr);
  return below ? below->sp(point.p + Vec3f(r, 0, 0)) : SampledSpectrum();
}

constexpr float kR = 0.4f;

void expect_medium(const MadeSubsurface& made, const BssrdfTable& table, float sigma_a,
                   float sigma_s) {
  EXPECT_TRUE(made.diagnostics.warnings().empty());
  const TabulatedBssrdf expected({0, 0, 0}, {0, 0, 1}, SampledSpectrum(sigma_a),
                                 SampledSpectrum(sigma_s), &table, kAllWavelengths);
  const SampledSpectrum found = profile_of(made, kR);
  for (int i = 0; i < kSpectrumSamples; ++i)
    EXPECT_NEAR(found[i], expected.profile(i, kR), 1e-4f * found[i]);
}

TEST(SubsurfaceMaterial, WithoutParametersItIsWholeMilk) {
  const SampledSpectrum milk = profile_of(MadeSubsurface(""), kR);
  EXPECT_LT((milk * -1.0f).max_component(), 0.0f);
  const SampledSpectrum named = profile_of(MadeSubsurface("\"string name\" \"Wholemilk\""), kR);
  const SampledSpectrum written = profile_of(
      MadeSubsurface("\"rgb sigma_a\" [ .0011 .0024 .014 ] \"rgb sigma_s\" [ 2.55 3.21 3.77 ]"),
      kR);
  for (int i = 0; i < kSpectrumSamples; ++i) {
    EXPECT_NEAR(named[i], milk[i], 1e-5f * milk[i]);
    EXPECT_NEAR(written[i], milk[i], 1e-5f * milk[i]);
  }
}

TEST(SubsurfaceMaterial, CoefficientsAreScaled) {
  expect_medium(
      MadeSubsurface("\"spectrum sigma_a\" [ 200 .25 900 .25 ] \"spectrum sigma_s\" [ 200 .75 900 "
                     ".75 ] \"float scale\" 4 \"float g\" 0.2 \"float eta\" 1.5"),
      BssrdfTable(0.2f, 1.5f), 1.0f, 3.0f);
}

TEST(SubsurfaceMaterial, ReflectanceAndFreePathAreInverted) {
  const BssrdfTable table(0.0f, 1.33f);
  const float albedo = table.invert_effective_albedo(0.6f);
  EXPECT_NEAR(table.effective_albedo(table.albedo_weights(albedo)), 0.6f, 1e-4f);
  expect_medium(MadeSubsurface(
                    "\"spectrum reflectance\" [ 200 .6 900 .6 ] \"spectrum mfp\" [ 200 .25 900 .25 "
                    "] \"float scale\" 2"),
                table, 2.0f * (1.0f - albedo), 2.0f * albedo);
  // The default free path is 1.
  expect_medium(MadeSubsurface("\"spectrum reflectance\" [ 200 .6 900 .6 ]"), table, 1.0f - albedo,
                albedo);
}

TEST(SubsurfaceMaterial, DroppedWavelengthsAreLeftOut) {
  const MadeSubsurface milk("");
  for (const int number : {0, 5}) {
    SampledWavelengths hero = test_wavelengths().with_hero(number);
    hero.terminate_secondary();
    const SampledSpectrum alone = profile_of(milk, kR, hero);
    EXPECT_FLOAT_EQ(alone[number], profile_of(milk, kR)[number]);
    EXPECT_EQ(alone[1], 0.0f);
  }
}

TEST(SubsurfaceMaterial, BoundaryHasTheRoughnessOfTheFormat) {
  const ClassMask smooth = ClassMask::kDiffuse | ClassMask::kSpecular;
  EXPECT_EQ(MadeSubsurface("").material->possible_classes(), smooth);
  EXPECT_EQ(MadeSubsurface("\"float roughness\" 0.03 \"bool remaproughness\" false")
                .material->possible_classes(),
            smooth);
  EXPECT_EQ(MadeSubsurface("\"float roughness\" 0.04 \"bool remaproughness\" false")
                .material->possible_classes(),
            ClassMask::kAll);
  const MadeSubsurface rough("\"float roughness\" 0.04");
  EXPECT_EQ(rough.material->possible_classes(), ClassMask::kRough);
  const DielectricBsdf glass({1.33f, TrowbridgeReitz(0.2f, 0.2f)}, 0.05f);
  SampledWavelengths lambda = test_wavelengths();
  BsdfArena arena;
  const Vec3f wo = normalize(Vec3f(0.5f, 0.0f, 0.7f)), wi = normalize(Vec3f(-0.2f, 0.3f, 0.9f));
  const auto value = [&](const Bsdf& b) {
    return b.eval(wo, wi, TransportMode::kRadiance, EventClass::kGlossy, ClassMask::kAll).f[0];
  };
  EXPECT_GT(value(glass), 0.0f);
  EXPECT_FLOAT_EQ(value(*rough.material->make_bsdf(plain_point(), lambda, 0.05f, arena)),
                  value(glass));
}

TEST(SubsurfaceMaterial, MistakesAreLocated) {
  const auto expect_error = [](const std::string& parameters, const std::string& message) {
    try {
      const MadeSubsurface made(parameters);
      FAIL() << parameters;
    } catch (const SceneError& e) {
      EXPECT_NE(std::string(e.what()).find("t.pbrt:2:23: "), std::string::npos) << e.what();
      EXPECT_NE(std::string(e.what()).find(message), std::string::npos) << e.what();
    }
  };
  expect_error("\"string name\" \"Wholemilch\"", "did you mean \"Wholemilk\"?");
  expect_error("\"rgb sigma_a\" [ 1 1 1 ]", "\"sigma_a\" is given without \"sigma_s\"");
  expect_error("\"rgb sigma_s\" [ 1 1 1 ]", "\"sigma_s\" is given without \"sigma_a\"");
  expect_error("\"float g\" 1", "\"g\" is 1, expected a number between -1 and 1");
  expect_error("\"float eta\" 0.1", "\"eta\" is 0.1, expected a number between 0.4 and 2.5");
}

TEST(SubsurfaceMaterial, IdleParametersAreTold) {
  const auto warning = [](const std::string& parameters) {
    const auto warnings = MadeSubsurface(parameters).diagnostics.warnings();
    return warnings.size() == 1 ? warnings[0].message : "";
  };
  EXPECT_NE(warning("\"string name\" \"Cream\" \"float g\" 0.5").find("\"g\" is ignored"),
            std::string::npos);
  EXPECT_NE(warning("\"rgb mfp\" [ 1 1 1 ]").find("mfp"), std::string::npos);
}

}  // namespace
}  // namespace nephroid
