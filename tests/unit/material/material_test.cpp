// Materials from their descriptions: every row of the table makes a BSDF with the scene format's
// defaults, mixes choose with the right probability, bumps tilt the frame, errors are located.
#include "scene/material/material.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "core/sampler.h"
#include "scene/bsdf/conductor.h"
#include "scene/bsdf/dielectric.h"
#include "scene/bsdf/hair.h"
#include "scene/material/table.h"

namespace nephroid {
namespace {

Parameter numbers(const std::string& type, const std::string& name, std::vector<double> values) {
  Parameter p;
  p.type = type;
  p.name = name;
  p.numbers = std::move(values);
  return p;
}

Parameter strings(const std::string& type, const std::string& name,
                  std::vector<std::string> values) {
  Parameter p;
  p.type = type;
  p.name = name;
  p.strings = std::move(values);
  return p;
}

Parameter boolean(const std::string& name, bool value) {
  Parameter p;
  p.type = "bool";
  p.name = name;
  p.bools = {value};
  return p;
}

MaterialDescription material(const std::string& type, std::vector<Parameter> parameters = {},
                             const std::string& name = "") {
  MaterialDescription d;
  d.type = type;
  d.name = name;
  d.where = {std::make_shared<const std::string>("scene.pbrt"), 7, 3};
  d.parameters.where = d.where;
  for (Parameter& p : parameters) p.where = d.where;
  d.parameters.list = std::move(parameters);
  return d;
}

struct Made {
  SceneDescription description;
  Diagnostics diagnostics;
  std::vector<MaterialPtr> materials;

  explicit Made(std::vector<MaterialDescription> list, const MaterialSettings& settings = {}) {
    description.materials = std::move(list);
    const TextureLibrary textures(description, diagnostics);
    materials = make_materials(description, textures, settings, diagnostics);
  }
};

/// The located message of the error that making these materials throws; empty if there is none.
std::string error_of(std::vector<MaterialDescription> list) {
  try {
    Made made(std::move(list));
  } catch (const SceneError& e) {
    return e.what();
  }
  return "";
}

SurfaceInteraction flat_point(const Vec3f& p = {0.3f, 0.4f, 0.0f}) {
  SurfaceInteraction s;
  s.p = p;
  s.ng = Vec3f(0, 0, 1);
  s.wo = normalize(Vec3f(0.3f, 0.2f, 0.8f));
  s.uv = Vec2f(p.x, p.y);
  s.dpdu = s.shading_dpdu = Vec3f(1, 0, 0);
  s.dpdv = s.shading_dpdv = Vec3f(0, 1, 0);
  s.dndu = s.dndv = Vec3f(0, 0, 0);
  return s;
}

constexpr float kSpecularAlpha = 0.05f;
const Vec3f kWo = normalize(Vec3f(0.5f, 0.0f, 0.7f));
const Vec3f kWi = normalize(Vec3f(-0.2f, 0.3f, 0.9f));

TEST(MaterialTable, EveryTypeMakesABsdfWithItsDefaults) {
  for (const MaterialRow& row : material_table()) {
    // These have no defaults: other materials, and a file (measured_material_test.cpp).
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
      EXPECT_TRUE(m.passes_straight());
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

BsdfEval eval_of(const Material& m, EventClass c) {
  SampledWavelengths lambda = SampledWavelengths::sample_visible(0.3f);
  BsdfArena arena;
  return m.make_bsdf(flat_point(), lambda, kSpecularAlpha, arena)
      ->eval(kWo, kWi, TransportMode::kRadiance, c, ClassMask::kAll);
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
  // All combinations of coat, metal, gap and index at thresholds in the band.
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
  EXPECT_FALSE(made.materials[1]->passes_straight());
  EXPECT_TRUE(made.materials[1]->straight_transmittance(point, lambda).is_black());
  for (const int i : {0, 2}) {
    const Material& m = *made.materials[i];
    EXPECT_TRUE(m.passes_straight());
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
  // An invisible anisotropy sends the second material down the general road.
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

  // The fit of reflectance: sigma_a = (ln c / polynomial(beta_n))^2, at beta_n = 0.3.
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

TEST(Bump, ARampTiltsTheNormalByItsSlope) {
  SceneDescription description;
  Diagnostics diagnostics;
  // Two texels, interpolated: between their centres at u = 1/4 and 3/4 the slope is 1/2.
  const auto file = std::filesystem::path(testing::TempDir()) / "nephroid_bump_test.exr";
  const float texels[2] = {0.0f, 0.25f};
  const auto out = OIIO::ImageOutput::create(file.string());
  ASSERT_TRUE(out && out->open(file.string(), OIIO::ImageSpec(2, 1, 1, OIIO::TypeDesc::FLOAT)));
  ASSERT_TRUE(out->write_image(OIIO::TypeDesc::FLOAT, texels));
  out->close();
  TextureDescription ramp;
  ramp.name = "ramp";
  ramp.type = "imagemap";
  ramp.value_type = "float";
  ramp.parameters.list = {strings("string", "filename", {file.string()})};
  description.textures.push_back(ramp);
  description.materials = {material("diffuse", {strings("texture", "displacement", {"ramp"})})};
  const TextureLibrary textures(description, diagnostics);
  const auto made = make_materials(description, textures, {}, diagnostics);
  ASSERT_TRUE(made[0]->has_bump());
  SurfaceInteraction point = flat_point();
  made[0]->bump(point);
  const Vec3f expected = normalize(Vec3f(-0.5f, 0.0f, 1.0f));
  EXPECT_LT(length(point.shading.z - expected), 1e-3f);
  EXPECT_NEAR(dot(point.shading.x, point.shading.z), 0.0f, 1e-5f);
  // Seen from a surface that was turned inside out, the normal stays on the outside.
  SurfaceInteraction flipped = flat_point();
  flipped.ng = Vec3f(0, 0, -1);
  flipped.shading = Frame::from_z_and_tangent(Vec3f(0, 0, -1), flipped.dpdu);
  made[0]->bump(flipped);
  EXPECT_LT(flipped.shading.z.z, 0.0f);
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace nephroid
