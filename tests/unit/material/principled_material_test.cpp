// The material "principled": the meaning of its parameters, what it tells others of itself, also
// where textures decide, and its warnings.
#include <gtest/gtest.h>

#include "scene/bsdf/dielectric.h"
#include "scene/bsdf/principled.h"
#include "unit/material/made_materials.h"

namespace nephroid {
namespace {

using namespace testing_support;

using Parameters = std::vector<Parameter>;

Parameter number(const std::string& name, double value) {
  return numbers("float", name, {value});
}
Parameter grey(const std::string& name, double value) {
  return numbers("spectrum", name, {200, value, 900, value});
}
MaterialDescription principled(Parameters parameters) {
  return material("principled", std::move(parameters));
}
SampledWavelengths wavelengths() {
  return SampledWavelengths::sample_visible(0.3f);
}

/// Materials with a texture "split" that is 0 for small u and 1 for large u. flat_point() sees 0.
struct MadeWithTexture {
  SceneDescription description;
  Diagnostics diagnostics;
  MaterialPtr material;

  explicit MadeWithTexture(Parameters parameters) {
    TextureDescription split;
    split.name = "split";
    split.type = "checkerboard";
    split.value_type = "float";
    split.parameters.list = {number("uscale", 1), number("vscale", 1), number("tex1", 0),
                             number("tex2", 1)};
    description.textures = {split};
    description.materials = {principled(std::move(parameters))};
    const TextureLibrary textures(description, diagnostics);
    material = make_materials(description, textures, {}, diagnostics)[0];
  }
};
Parameter split(const std::string& name) {
  return strings("texture", name, {"split"});
}

TEST(PrincipledMaterial, SmoothGlassIsADielectric) {
  const Made made({principled({number("transmission_weight", 1), number("specular_roughness", 0)}),
                   material("dielectric")});
  const Material &glass = *made.materials[0], &expected = *made.materials[1];
  EXPECT_EQ(glass.possible_classes(), expected.possible_classes());
  EXPECT_EQ(glass.refractive_index(), expected.refractive_index());
  EXPECT_EQ(glass.transmits_straight(), expected.transmits_straight());
  EXPECT_EQ(glass.facet_alpha(), expected.facet_alpha());
  EXPECT_FALSE(glass.has_bssrdf());
  SampledWavelengths lambda = wavelengths();
  BsdfArena arena;
  const Bsdf* a = glass.make_bsdf(flat_point(), lambda, kSpecularAlpha, arena);
  const Bsdf* b = expected.make_bsdf(flat_point(), lambda, kSpecularAlpha, arena);
  EXPECT_FALSE(lambda.secondary_terminated());
  const auto pair = a->delta_pair(kWo, TransportMode::kRadiance);
  const auto same = b->delta_pair(kWo, TransportMode::kRadiance);
  ASSERT_TRUE(pair && same);
  for (const int i : {0, 1}) {
    EXPECT_LT(length((*pair)[i].wi - (*same)[i].wi), 1e-6f);
    EXPECT_NEAR((*pair)[i].f[1], (*same)[i].f[1], 1e-5f);
    EXPECT_FLOAT_EQ((*pair)[i].eta, (*same)[i].eta);
  }
}

TEST(PrincipledMaterial, ACoatCanLeaveTheBaseAsItIsInAir) {
  // By default a coat of the base's index hides the boundary. As of glTF it only takes its part.
  const Parameter alone = boolean("coat_affects_specular", false), coat = number("coat_weight", 1),
                  index = number("coat_ior", 1.5);
  const SurfaceInteraction point = flat_point();
  const Vec3f up(0, 0, 1);
  for (const double film : {0.0, 1.0}) {
    const Parameter with_film = number("thin_film_weight", film);
    const Made made({principled({with_film}), principled({with_film, coat, index, alone}),
                     principled({coat, index})});
    const auto glossy = [&](size_t i) {
      SampledWavelengths lambda = wavelengths();
      BsdfArena arena;
      return made.materials[i]
          ->make_bsdf(point, lambda, kSpecularAlpha, arena)
          ->eval(up, up, TransportMode::kRadiance, EventClass::kGlossy, ClassMask::kAll)
          .f[2];
    };
    EXPECT_NEAR(glossy(1), 0.96f * glossy(0), 1e-4f * glossy(0));
    EXPECT_EQ(glossy(2), 0.0f);
  }
}

TEST(PrincipledMaterial, ARoughCoatRoughensTheBaseUnlessToldNotTo) {
  const Parameter coat = number("coat_weight", 1), rough = number("coat_roughness", 0.9),
                  alone = boolean("coat_affects_specular", false);
  const Made made({principled({coat, rough}), principled({coat, rough, alone}),
                   principled({coat, rough, alone, number("specular_ior", 1)})});
  EXPECT_GT(*made.materials[0]->facet_alpha(), 0.5f);
  EXPECT_FLOAT_EQ(*made.materials[1]->facet_alpha(), 0.09f);
  // There is no boundary below the coat: its facets alone count.
  EXPECT_FLOAT_EQ(*made.materials[2]->facet_alpha(), 0.81f);
}

TEST(PrincipledMaterial, WithoutSpecularItIsDiffuse) {
  const Made made(
      {principled({number("specular_weight", 0), numbers("rgb", "base_color", {.7, .5, .2}),
                   number("base_weight", 0.5)}),
       material("diffuse", {numbers("rgb", "reflectance", {.7, .5, .2})})});
  EXPECT_EQ(made.materials[0]->possible_classes(), ClassMask::kDiffuse);
  const BsdfEval a = eval_of(*made.materials[0], EventClass::kDiffuse);
  const BsdfEval b = eval_of(*made.materials[1], EventClass::kDiffuse);
  for (int i = 0; i < kSpectrumSamples; ++i) EXPECT_NEAR(a.f[i], 0.5f * b.f[i], 1e-6f);
  EXPECT_FLOAT_EQ(a.pdf_w, b.pdf_w);
}

TEST(PrincipledMaterial, AlphaIsTheSquareOfRoughness) {
  const Made made({principled({number("specular_roughness", 0.5)}),
                   principled({number("coat_weight", 1), number("coat_roughness", 0.2)}),
                   principled({number("base_metalness", 1), number("specular_roughness", 0.5),
                               number("specular_roughness_anisotropy", 1)}),
                   principled({number("specular_weight", 0)})});
  EXPECT_NEAR(*made.materials[0]->facet_alpha(), 0.25f, 1e-6f);
  EXPECT_NEAR(*made.materials[1]->facet_alpha(), 0.04f, 1e-6f);
  EXPECT_NEAR(*made.materials[2]->facet_alpha(), 0.25f * std::sqrt(2.0f), 1e-6f);
  EXPECT_FALSE(made.materials[3]->facet_alpha());
}

TEST(PrincipledMaterial, RoughnessThatIsNotRemappedIsAlpha) {
  const Parameter raw = boolean("remaproughness", false);
  const Made made({principled({number("specular_roughness", 0.25), raw}),
                   principled({number("coat_weight", 1), number("coat_roughness", 0.04), raw})});
  EXPECT_NEAR(*made.materials[0]->facet_alpha(), 0.25f, 1e-6f);
  EXPECT_NEAR(*made.materials[1]->facet_alpha(), 0.04f, 1e-6f);
  EXPECT_EQ(made.diagnostics.warnings().size(), 0u);
}

TEST(PrincipledMaterial, ARoughCoatRoughensItsBase) {
  const Made made({principled({number("base_metalness", 1), number("specular_roughness", 0),
                               number("coat_weight", 1), number("coat_roughness", 0.6)})});
  SampledWavelengths lambda = wavelengths();
  BsdfArena arena;
  const Bsdf* bsdf = made.materials[0]->make_bsdf(flat_point(), lambda, kSpecularAlpha, arena);
  EXPECT_EQ(bsdf->classes(), ClassMask::kGlossy);
  EXPECT_EQ(made.materials[0]->possible_classes(), ClassMask::kGlossy);
  // alpha^2 = 2 (1 - 1/1.6) 0.36^2
  EXPECT_NEAR(*made.materials[0]->facet_alpha(), std::sqrt(0.75f) * 0.36f, 1e-5f);
}

TEST(PrincipledMaterial, DispersionHasItsAbbeNumberAndKeepsTheHero) {
  const auto glass = [](Parameters more) {
    more.push_back(number("specular_ior", 1.6));
    more.push_back(number("transmission_weight", 1));
    more.push_back(number("transmission_dispersion_abbe_number", 30));
    return principled(std::move(more));
  };
  const Made made({glass({}), glass({boolean("geometry_thin_walled", true)}),
                   glass({number("base_metalness", 1)})});
  EXPECT_TRUE(made.diagnostics.warnings().empty());
  std::vector<float> squares, indices;  // of 1/lambda in micrometres
  for (const float u : {0.05f, 0.3f, 0.55f}) {
    SampledWavelengths lambda = SampledWavelengths::sample_visible(u);
    BsdfArena arena;
    const Bsdf* bsdf = made.materials[0]->make_bsdf(flat_point(), lambda, kSpecularAlpha, arena);
    EXPECT_TRUE(lambda.secondary_terminated());
    squares.push_back(sqr(1e3f / lambda.hero()));
    indices.push_back(bsdf->eta_between(Vec3f(0, 0, 1), Vec3f(0, 0, -1)));
  }
  // A straight line in 1/lambda^2, through 1.6 at 587.56 nm.
  const float slope = (indices[1] - indices[0]) / (squares[1] - squares[0]);
  EXPECT_NEAR((indices[2] - indices[0]) / (squares[2] - squares[0]), slope, 1e-3f * slope);
  EXPECT_NEAR(indices[0] + slope * (sqr(1.0f / 0.58756f) - squares[0]), 1.6f, 1e-4f);
  const float spread = slope * (sqr(1.0f / 0.48613f) - sqr(1.0f / 0.65627f));
  EXPECT_NEAR(0.6f / spread, 30.0f, 0.05f);
  EXPECT_NEAR(*made.materials[0]->refractive_index(),
              1.6f + slope * (sqr(1.0f / 0.55f) - sqr(1.0f / 0.58756f)), 1e-4f);
  for (const int i : {1, 2}) {
    SampledWavelengths lambda = wavelengths();
    BsdfArena arena;
    made.materials[static_cast<size_t>(i)]->make_bsdf(flat_point(), lambda, kSpecularAlpha, arena);
    EXPECT_FALSE(lambda.secondary_terminated());
    EXPECT_FALSE(made.materials[static_cast<size_t>(i)]->refractive_index());
  }
}

TEST(PrincipledMaterial, WhatGoesStraightHasTheWeightOfTheSample) {
  const Parameter thin = boolean("geometry_thin_walled", true);
  const Parameter half = number("transmission_weight", 0.5),
                  smooth = number("specular_roughness", 0);
  const Made made({principled({thin, half, smooth, number("coat_weight", 1),
                               grey("coat_color", 0.5), number("fuzz_weight", 0.3)}),
                   principled({half, number("specular_ior", 1)}),
                   principled({thin, half, smooth, grey("transmission_color", 0.3)}),
                   principled({thin, half}), principled({half, smooth}),
                   principled({thin, half, smooth, number("base_metalness", 1)})});
  const SurfaceInteraction point = flat_point();
  const Vec3f wo = point.shading.to_local(point.wo);
  SampledWavelengths lambda = wavelengths();
  for (size_t i = 0; i < made.materials.size(); ++i) {
    const Material& m = *made.materials[i];
    EXPECT_EQ(m.transmits_straight(), i < 3) << i;
    const SampledSpectrum weight = m.straight_transmittance(point, lambda);
    EXPECT_EQ(weight.is_black(), i >= 3) << i;
    BsdfArena arena;
    const auto s = m.make_bsdf(point, lambda, kSpecularAlpha, arena)
                       ->sample(wo, 0.5f, {0, 0}, TransportMode::kRadiance, ClassMask::kNone);
    ASSERT_EQ(s.has_value(), i < 3) << i;
    if (!s) continue;
    EXPECT_TRUE(s->straight_through);
    EXPECT_FLOAT_EQ(s->pdf_w, 1.0f);
    EXPECT_NEAR(weight[2], s->f[2] * std::abs(s->wi.z), 1e-6f) << i;
  }
}

TEST(PrincipledMaterial, TexturesLeaveEverythingPossible) {
  const MadeWithTexture glass({split("transmission_weight")});
  EXPECT_TRUE(glass.material->refractive_index());
  EXPECT_FALSE(glass.material->transmits_straight());
  const MadeWithTexture wall({split("transmission_weight"), split("specular_roughness"),
                              boolean("geometry_thin_walled", true)});
  EXPECT_TRUE(wall.material->transmits_straight());
  EXPECT_FALSE(wall.material->refractive_index());
  EXPECT_FALSE(wall.material->facet_alpha());
  EXPECT_EQ(wall.material->possible_classes(), ClassMask::kAll);
  EXPECT_FALSE(MadeWithTexture({split("specular_ior"), number("transmission_weight", 1)})
                   .material->transmits_straight());
  EXPECT_TRUE(MadeWithTexture({split("subsurface_weight")}).material->has_bssrdf());
  EXPECT_FALSE(MadeWithTexture({split("subsurface_weight"), number("base_metalness", 1)})
                   .material->has_bssrdf());
  EXPECT_FALSE(MadeWithTexture({split("subsurface_weight"), boolean("geometry_thin_walled", true)})
                   .material->has_bssrdf());
  EXPECT_EQ(MadeWithTexture({split("coat_weight"), number("specular_weight", 0)})
                .material->possible_classes(),
            ClassMask::kDiffuse | ClassMask::kSpecular);
  EXPECT_EQ(MadeWithTexture({split("base_metalness"), number("specular_roughness", 0)})
                .material->possible_classes(),
            ClassMask::kDiffuse | ClassMask::kSpecular);
}

TEST(PrincipledMaterial, PossibleClassesCoverWhatTheBsdfHas) {
  const SpecularBand band{0.1f, 0.3f};
  const char* const kWeights[] = {
      "base_metalness",    "transmission_weight",         "coat_weight",     "fuzz_weight",
      "subsurface_weight", "diffuse_transmission_weight", "thin_film_weight"};
  std::vector<MaterialDescription> all;
  for (int bits = 0; bits < 128; ++bits)
    for (const double roughness : {0.0, 0.45, 0.8})
      for (const int kind : {0, 1, 2}) {
        Parameters list = {number("specular_roughness", roughness),
                           number("coat_roughness", 0.8 - roughness),
                           boolean("geometry_thin_walled", kind == 1)};
        if (kind == 2) list.push_back(number("specular_ior", 1));
        for (int i = 0; i < 7; ++i)
          if (bits >> i & 1) list.push_back(number(kWeights[i], i % 2 == 0 ? 1.0 : 0.5));
        all.push_back(principled(list));
      }
  const Made made(std::move(all), {band});
  int checked = 0;
  for (const MaterialPtr& m : made.materials) {
    for (const float threshold : {0.1f, 0.19f, 0.21f, 0.3f}) {
      SampledWavelengths lambda = wavelengths();
      BsdfArena arena;
      const Bsdf* bsdf = m->make_bsdf(flat_point(), lambda, threshold, arena);
      ASSERT_TRUE(bsdf);
      EXPECT_EQ(bsdf->classes() & m->possible_classes(), bsdf->classes()) << m->index();
      ++checked;
    }
  }
  EXPECT_GT(checked, 4000);
}

TEST(PrincipledMaterial, LightBelowTheSurfaceHasItsColourAndRadius) {
  const Made made(
      {principled({number("subsurface_weight", 1), grey("subsurface_color", 0.6),
                   number("subsurface_radius", 2), grey("subsurface_radius_scale", 0.5)}),
       material("subsurface", {grey("reflectance", 0.6), grey("mfp", 1), number("eta", 1.5)})});
  SampledWavelengths lambda = wavelengths();
  const SurfaceInteraction point = flat_point();
  BsdfArena arena, other;
  ASSERT_TRUE(made.materials[0]->has_bssrdf());
  const Bssrdf* a = made.materials[0]->make_bssrdf(point, lambda, arena);
  const Bssrdf* b = made.materials[1]->make_bssrdf(point, lambda, other);
  ASSERT_TRUE(a && b);
  for (const float r : {0.1f, 0.7f, 2.0f}) {
    const Vec3f p = point.p + Vec3f(r, 0, 0);
    EXPECT_GT(a->sp(p)[3], 0.0f);
    EXPECT_NEAR(a->sp(p)[3], b->sp(p)[3], 1e-3f * b->sp(p)[3]);
    EXPECT_NEAR(a->pdf_a(p, Vec3f(0, 0, 1)), b->pdf_a(p, Vec3f(0, 0, 1)),
                1e-3f * b->pdf_a(p, Vec3f(0, 0, 1)));
  }
  EXPECT_TRUE(a->exit_bsdf(arena));
}

TEST(PrincipledMaterial, AFreePathOfZeroIsTheDiffuseLobe) {
  const Parameter half = number("subsurface_weight", 0.5), blue = grey("base_color", 0.2),
                  red = grey("subsurface_color", 0.8);
  const MadeWithTexture varies({half, blue, red, split("subsurface_radius")});
  const Made made({principled({half, blue, red, number("subsurface_radius", 0)}),
                   principled({half, blue, red, grey("subsurface_radius_scale", 0)}),
                   principled({grey("base_color", 0.5)})});
  const BsdfEval expected = eval_of(*made.materials[2], EventClass::kDiffuse);
  for (const MaterialPtr& m : {varies.material, made.materials[0], made.materials[1]}) {
    EXPECT_EQ(m->has_bssrdf(), m == varies.material);
    const BsdfEval e = eval_of(*m, EventClass::kDiffuse);
    EXPECT_NEAR(e.f[2], expected.f[2], 1e-5f);
    EXPECT_NEAR(e.pdf_w, expected.pdf_w, 1e-5f);
  }
}

/// Share of light that a profile gives back at a wavelength, on a plane.
double given_back(const Bssrdf& profile, const Vec3f& p, int wavelength) {
  constexpr double kStep = 0.02;
  double sum = 0;
  for (double log_r = std::log(1e-6); log_r < std::log(50.0); log_r += kStep) {
    const double r = std::exp(log_r);
    const SampledSpectrum sp = profile.sp(p + Vec3f(static_cast<float>(r), 0, 0));
    sum += 2 * M_PI * r * sp[wavelength] * r * kStep;
  }
  return sum;
}

TEST(PrincipledMaterial, AFreePathOfZeroAtSomeWavelengthsLosesNoLight) {
  const Made made({principled(
      {number("subsurface_weight", 1), grey("subsurface_color", 0.6),
       numbers("spectrum", "subsurface_radius_scale", {200, 0, 550, 0, 551, 1, 900, 1})})});
  const SampledWavelengths lambda = wavelengths();
  const SurfaceInteraction point = flat_point(Vec3f(0, 0, 0));
  BsdfArena arena;
  const Bssrdf* profile = made.materials[0]->make_bssrdf(point, lambda, arena);
  ASSERT_TRUE(profile);
  int short_paths = 0;
  for (int i = 0; i < kSpectrumSamples; ++i) {
    EXPECT_NEAR(given_back(*profile, point.p, i), 0.6, 0.01) << lambda.lambdas()[i];
    short_paths += lambda.lambdas()[i] < 550.0f;
  }
  EXPECT_GT(short_paths, 0);
  EXPECT_LT(short_paths, kSpectrumSamples);
}

TEST(PrincipledMaterial, AThinWallSpreadsSubsurfaceLightToBothSides) {
  const Made made({principled({number("subsurface_weight", 1), number("specular_weight", 0),
                               grey("subsurface_color", 0.6), boolean("geometry_thin_walled", true),
                               number("subsurface_scatter_anisotropy", 0.5)})});
  SampledWavelengths lambda = wavelengths();
  BsdfArena arena;
  const Bsdf* bsdf = made.materials[0]->make_bsdf(flat_point(), lambda, kSpecularAlpha, arena);
  const auto f = [&](const Vec3f& wi) {
    return bsdf->eval(kWo, wi, TransportMode::kRadiance, EventClass::kDiffuse, ClassMask::kAll)
        .f[4];
  };
  EXPECT_NEAR(f(kWi), 0.25f * 0.6f * kInvPi, 1e-5f);
  EXPECT_NEAR(f(-kWi), 0.75f * 0.6f * kInvPi, 1e-5f);
}

TEST(PrincipledMaterial, EverythingAtOnceFitsTheArena) {
  Parameters all;
  for (const char* weight :
       {"base_metalness", "transmission_weight", "coat_weight", "fuzz_weight", "subsurface_weight",
        "diffuse_transmission_weight", "thin_film_weight", "base_diffuse_roughness"})
    all.push_back(number(weight, 0.5));
  const Made made({principled(all)});
  SampledWavelengths lambda = wavelengths();
  BsdfArena arena;
  EXPECT_TRUE(made.materials[0]->make_bsdf(flat_point(), lambda, kSpecularAlpha, arena));
  const Bssrdf* below = made.materials[0]->make_bssrdf(flat_point(), lambda, arena);
  ASSERT_TRUE(below);
  EXPECT_TRUE(below->exit_bsdf(arena));
}

TEST(PrincipledMaterial, NumbersOutOfRangeAreToldAndClamped) {
  const auto warning = [](Parameters list) {
    const Made made({principled(std::move(list))});
    const auto& warnings = made.diagnostics.warnings();
    return warnings.size() == 1 ? warnings[0].message : std::to_string(warnings.size());
  };
  EXPECT_NE(warning({number("coat_weight", 1.5)})
                .find("\"coat_weight\" is 1.5, expected a number from 0 to 1; 1 is used"),
            std::string::npos);
  EXPECT_NE(warning({number("subsurface_radius", -1)})
                .find("\"subsurface_radius\" is -1, expected a number of at least 0"),
            std::string::npos);
  EXPECT_NE(warning({number("specular_ior", 0)}).find("from 0.1 to 10"), std::string::npos);
  EXPECT_NE(warning({number("coat_wieght", 1)}).find("coat_wieght"), std::string::npos);
  const MadeWithTexture varies({split("subsurface_scatter_anisotropy")});
  ASSERT_EQ(varies.diagnostics.warnings().size(), 1u);
  EXPECT_NE(varies.diagnostics.warnings()[0].message.find("varies over the surface"),
            std::string::npos);
}

}  // namespace
}  // namespace nephroid
