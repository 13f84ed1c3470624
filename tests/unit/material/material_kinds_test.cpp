// Each material: the meaning of its parameters, and the BSDF that it makes.
#include <gtest/gtest.h>

#include "core/sampler.h"
#include "scene/bsdf/conductor.h"
#include "scene/bsdf/hair.h"
#include "unit/material/made_materials.h"

namespace nephroid {
namespace {

using namespace testing_support;

TEST(DiffuseMaterials, DefaultsAndClamping) {
  const Made made({material("diffuse"), material("diffusetransmission"),
                   material("diffusetransmission", {numbers("float", "scale", {2})})});
  EXPECT_NEAR(eval_of(*made.materials[0], EventClass::kDiffuse).f[0], 0.5f * kInvPi, 1e-6f);
  EXPECT_NEAR(eval_of(*made.materials[1], EventClass::kDiffuse).f[0], 0.25f * kInvPi, 1e-6f);
  EXPECT_NEAR(eval_of(*made.materials[2], EventClass::kDiffuse).f[0], 0.5f * kInvPi, 1e-6f);
}

TEST(ConductorMaterials, RoughnessIsRemappedUnlessToldOtherwise) {
  const Made made({material("conductor", {numbers("float", "roughness", {0.09})}),
                   material("conductor", {numbers("float", "roughness", {0.3}),
                                          boolean("remaproughness", false)}),
                   material("conductor", {numbers("float", "roughness", {0.09}),
                                          numbers("float", "uroughness", {0.25})})});
  SampledWavelengths lambda = SampledWavelengths::sample_visible(0.3f);
  const SampledSpectrum eta = named_spectrum("metal-Cu-eta")->sample(lambda);
  const SampledSpectrum k = named_spectrum("metal-Cu-k")->sample(lambda);
  const auto expected = [&](float ax, float ay) {
    return ConductorBsdf({eta, k, {ax, ay}}, kSpecularAlpha)
        .eval(kWo, kWi, TransportMode::kRadiance, EventClass::kGlossy, ClassMask::kAll)
        .f[2];
  };
  EXPECT_NEAR(eval_of(*made.materials[0], EventClass::kGlossy).f[2] / expected(0.3f, 0.3f), 1.0f,
              1e-4f);
  EXPECT_NEAR(eval_of(*made.materials[1], EventClass::kGlossy).f[2] / expected(0.3f, 0.3f), 1.0f,
              1e-4f);
  EXPECT_NEAR(eval_of(*made.materials[2], EventClass::kGlossy).f[2] / expected(0.5f, 0.3f), 1.0f,
              1e-4f);
}

TEST(ConductorMaterials, ReflectanceIsMetAtNormalIncidence) {
  Parameter reflectance = numbers("spectrum", "reflectance", {200, 0.6, 900, 0.6});
  const Made made({material("conductor", {reflectance})});
  SampledWavelengths lambda = SampledWavelengths::sample_visible(0.3f);
  BsdfArena arena;
  const Bsdf* bsdf = made.materials[0]->make_bsdf(flat_point(), lambda, kSpecularAlpha, arena);
  const Vec3f up(0, 0, 1);
  const auto s = bsdf->sample(up, 0, {0, 0}, TransportMode::kRadiance, ClassMask::kAll);
  ASSERT_TRUE(s && s->delta);
  EXPECT_NEAR(s->f[3], 0.6f, 1e-4f);
}

TEST(DielectricMaterials, DispersionKeepsTheHeroOnly) {
  const Made made({material("dielectric", {strings("spectrum", "eta", {"glass-BK7"})}),
                   material("thindielectric", {strings("spectrum", "eta", {"glass-BK7"})})});
  SampledWavelengths lambda = SampledWavelengths::sample_visible(0.3f);
  BsdfArena arena;
  made.materials[1]->make_bsdf(flat_point(), lambda, kSpecularAlpha, arena);
  EXPECT_FALSE(lambda.secondary_terminated());
  const Bsdf* glass = made.materials[0]->make_bsdf(flat_point(), lambda, kSpecularAlpha, arena);
  EXPECT_TRUE(lambda.secondary_terminated());
  const auto s =
      glass->sample(kWo, kOneMinusEpsilon, {0, 0}, TransportMode::kRadiance, ClassMask::kAll);
  ASSERT_TRUE(s && s->transmitted);
  EXPECT_NEAR(s->eta, (*named_spectrum("glass-BK7"))(lambda.lambda(0)), 1e-5f);
}

TEST(DielectricMaterials, StraightPassageHasTheWeightOfTheSample) {
  const Made made({material("thindielectric"), material("dielectric"),
                   material("dielectric", {numbers("float", "eta", {1})})});
  const SurfaceInteraction point = flat_point();
  SampledWavelengths lambda = SampledWavelengths::sample_visible(0.3f);
  EXPECT_FALSE(made.materials[1]->transmits_straight());
  EXPECT_TRUE(made.materials[1]->straight_transmittance(point, lambda).is_black());
  for (const int i : {0, 2}) {
    const Material& m = *made.materials[i];
    EXPECT_TRUE(m.transmits_straight());
    BsdfArena arena;
    const Vec3f wo = point.shading.to_local(point.wo);
    const auto s =
        m.make_bsdf(point, lambda, kSpecularAlpha, arena)
            ->sample(wo, kOneMinusEpsilon, {0, 0}, TransportMode::kRadiance, ClassMask::kAll);
    ASSERT_TRUE(s && s->straight_through);
    EXPECT_NEAR(m.straight_transmittance(point, lambda)[0], s->f[0] * std::abs(s->wi.z), 1e-6f);
  }
}

TEST(CoatedMaterials, ClosedFormAndWalkAgreeInTheMean) {
  // A tiny anisotropy forces the second material to use random walks.
  const Made made({material("coateddiffuse", {numbers("float", "roughness", {0.09})}),
                   material("coateddiffuse", {numbers("float", "uroughness", {0.09}),
                                              numbers("float", "vroughness", {0.090001})})});
  SampledWavelengths lambda = SampledWavelengths::sample_visible(0.3f);
  BsdfArena arena;
  const SurfaceInteraction point = flat_point();
  double sums[2] = {0, 0}, squares[2] = {0, 0};
  constexpr int kCount = 20000;
  for (int m = 0; m < 2; ++m) {
    const Bsdf* bsdf = made.materials[m]->make_bsdf(point, lambda, kSpecularAlpha, arena);
    ASSERT_TRUE(bsdf);
    for (int i = 0; i < kCount; ++i) {
      const auto at = [&](int k) {
        return bits_to_unit_float(static_cast<uint32_t>(hash_combine(i, k) >> 32));
      };
      const auto s =
          bsdf->sample(kWo, at(0), {at(1), at(2)}, TransportMode::kRadiance, ClassMask::kAll);
      const double w = s ? s->f[0] * s->wi.z / s->pdf_w : 0.0;
      sums[m] += w;
      squares[m] += w * w;
    }
    sums[m] /= kCount;
    squares[m] = (squares[m] / kCount - sums[m] * sums[m]) / kCount;
  }
  EXPECT_NEAR(sums[0], sums[1], 5.0 * std::sqrt(squares[0] + squares[1]));
}

TEST(CoatedMaterials, AConductorsCoatIsAsThickByEitherName) {
  const auto albedo = [](const char* name) {
    const Made made(
        {material("coatedconductor",
                  {numbers("float", name, {3}), numbers("float", "interface.roughness", {0.3}),
                   numbers("float", "conductor.roughness", {0.3})})});
    EXPECT_TRUE(made.diagnostics.warnings().empty());
    SampledWavelengths lambda = SampledWavelengths::sample_visible(0.3f);
    BsdfArena arena;
    const Bsdf* bsdf = made.materials[0]->make_bsdf(flat_point(), lambda, kSpecularAlpha, arena);
    const Vec3f w = normalize(Vec3f(0.2f, 0.1f, 1));
    return bsdf->eval(w, w, TransportMode::kRadiance, EventClass::kGlossy, ClassMask::kAll).f[0];
  };
  const float thick = albedo("thickness");
  EXPECT_EQ(albedo("interface.thickness"), thick);
  EXPECT_NE(albedo("g"), thick);  // 0.01 mean free paths
}

TEST(CoatedMaterials, FitTheArena) {
  const Made made({material("coatedconductor", {numbers("float", "interface.roughness", {0.2}),
                                                numbers("spectrum", "albedo", {200, .5, 900, .5}),
                                                numbers("float", "conductor.roughness", {0.3})}),
                   material("coateddiffuse", {numbers("spectrum", "albedo", {200, .5, 900, .5})})});
  EXPECT_TRUE(made.diagnostics.warnings().empty());
  SampledWavelengths lambda = SampledWavelengths::sample_visible(0.3f);
  for (const MaterialPtr& m : made.materials) {
    BsdfArena arena;
    EXPECT_NE(m->make_bsdf(flat_point(), lambda, kSpecularAlpha, arena), nullptr);
  }
}

TEST(HairMaterials, ColoursByEveryParametrisation) {
  const Made made({material("hair", {numbers("float", "eumelanin", {1.3})}), material("hair"),
                   material("hair", {numbers("rgb", "sigma_a", {0.5447, 0.9061, 1.781})}),
                   material("hair", {numbers("rgb", "reflectance", {0.6, 0.6, 0.6})}),
                   material("hair", {numbers("rgb", "color", {0.6, 0.6, 0.6})}),
                   material("hair", {numbers("float", "pheomelanin", {1.3})})});
  EXPECT_TRUE(made.diagnostics.warnings().empty());
  SampledWavelengths lambda = SampledWavelengths::sample_visible(0.3f);
  const auto albedo = [&](size_t i) {
    BsdfArena arena;
    return made.materials[i]->make_bsdf(flat_point(), lambda, kSpecularAlpha, arena)->albedo(kWo);
  };
  for (int i = 0; i < kSpectrumSamples; ++i) {
    EXPECT_FLOAT_EQ(albedo(0)[i], albedo(1)[i]);
    EXPECT_NEAR(albedo(0)[i], albedo(2)[i], 1e-4f);
    EXPECT_FLOAT_EQ(albedo(3)[i], albedo(4)[i]);
  }
  EXPECT_GT(albedo(5).average(), albedo(0).average());
  EXPECT_FALSE(made.materials[0]->merges_photons());
  EXPECT_EQ(made.materials[0]->possible_classes(), ClassMask::kDiffuse);

  // Reflectance fit: sigma_a = (ln c / polynomial(beta_n))^2, at beta_n = 0.3.
  const double b = 0.3, c = 0.6;
  const double fit = 5.969 - 0.215 * b + 2.532 * b * b - 10.73 * std::pow(b, 3) +
                     5.574 * std::pow(b, 4) + 0.245 * std::pow(b, 5);
  const float sigma = static_cast<float>(std::pow(std::log(c) / fit, 2));
  const HairBsdf expected(2 * 0.4f - 1, 1.55f, SampledSpectrum(sigma), HairShape(0.3f, 0.3f, 2.0f));
  EXPECT_NEAR(albedo(3)[0], expected.albedo(kWo)[0], 1e-4f);
}

TEST(HairMaterials, ContradictionsAreReported) {
  const Made made(
      {material("hair", {numbers("rgb", "sigma_a", {1, 1, 1}), numbers("rgb", "color", {1, 1, 1}),
                         numbers("float", "eumelanin", {1})})});
  ASSERT_EQ(made.diagnostics.warnings().size(), 2u);
  EXPECT_NE(made.diagnostics.warnings()[0].message.find("\"color\" is ignored"), std::string::npos);
  EXPECT_NE(error_of({material("hair", {numbers("float", "beta_m", {1.5})})})
                .find("scene.pbrt:7:3: \"beta_m\""),
            std::string::npos);
  EXPECT_NE(error_of({material("hair", {numbers("float", "eta", {0})})}).find("not positive"),
            std::string::npos);
}

}  // namespace
}  // namespace nephroid
