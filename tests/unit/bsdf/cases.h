// All BSDF families with test parameters. A new family gets a row here, and every test that
// iterates over the table covers it.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "measured_ggx.h"
#include "scene/bsdf/coated.h"
#include "scene/bsdf/coated_diffuse.h"
#include "scene/bsdf/conductor.h"
#include "scene/bsdf/dielectric.h"
#include "scene/bsdf/diffuse.h"
#include "scene/bsdf/hair.h"
#include "scene/bsdf/principled.h"
#include "scene/bsdf/subsurface_interface.h"

namespace nephroid::testing_bsdf {

/// Lobes of the cases are of class S up to this alpha.
inline constexpr float kSpecularAlpha = 0.05f;

struct BsdfCase {
  std::string name;
  std::function<const Bsdf*(BsdfArena&)> make;
  bool stochastic = false;  ///< values are random estimates
  bool refracts = false;    ///< radiance and importance modes differ
  bool adjoint = true;      ///< importance equals radiance with wo and wi exchanged
  bool reciprocal = true;   ///< same value with wo and wi exchanged
  bool few_angles = false;  ///< one of many like it: fewer directions tell enough
};

inline SampledSpectrum ramp(float from, float to) {
  SampledSpectrum s;
  for (int i = 0; i < kSpectrumSamples; ++i)
    s.set(i, lerp(static_cast<float>(i) / (kSpectrumSamples - 1), from, to));
  return s;
}

inline ConductorSurface metal(float alpha_x, float alpha_y) {
  return {ramp(0.2f, 1.2f), ramp(3.9f, 2.2f), TrowbridgeReitz(alpha_x, alpha_y)};
}

inline Coat make_coat(float eta, float alpha_x, float alpha_y, float thickness, float albedo,
                      float g = 0.0f) {
  Coat coat;
  coat.boundary = {eta, TrowbridgeReitz(alpha_x, alpha_y)};
  coat.thickness = thickness;
  coat.albedo = SampledSpectrum(albedo);
  coat.scatters = albedo > 0.0f;
  coat.g = g;
  return coat;
}

inline BsdfCase conductor_case(float ax, float ay) {
  return {"conductor " + std::to_string(ax) + " " + std::to_string(ay),
          [=](BsdfArena& a) { return a.make<ConductorBsdf>(metal(ax, ay), kSpecularAlpha); }};
}
inline BsdfCase dielectric_case(float eta, float ax, float ay) {
  const DielectricInterface boundary{eta, TrowbridgeReitz(ax, ay)};
  return {"dielectric " + std::to_string(eta) + " " + std::to_string(ax) + " " + std::to_string(ay),
          [=](BsdfArena& a) { return a.make<DielectricBsdf>(boundary, kSpecularAlpha); }, false,
          true};
}
inline BsdfCase subsurface_case(float eta, float ax, float ay) {
  const DielectricInterface boundary{eta, TrowbridgeReitz(ax, ay)};
  return {"subsurface " + std::to_string(eta) + " " + std::to_string(ax) + " " + std::to_string(ay),
          [=](BsdfArena& a) { return a.make<SubsurfaceInterfaceBsdf>(boundary, kSpecularAlpha); },
          false, true};
}
inline BsdfCase coated_diffuse_case(float eta, float alpha, float thickness, float rho) {
  const auto table = std::make_shared<CoatTable>(
      DielectricInterface{eta, TrowbridgeReitz(alpha, alpha)}, thickness, 10);
  return {"coateddiffuse " + std::to_string(eta) + " " + std::to_string(alpha), [=](BsdfArena& a) {
            return a.make<CoatedDiffuseBsdf>(table.get(), ramp(rho, 0.5f * rho), kSpecularAlpha);
          }};
}
inline BsdfCase measured_case(const testing_measured::GgxSurface& surface) {
  const auto brdf = std::make_shared<MeasuredBrdf>(testing_measured::tables_of(surface));
  const auto make = [brdf](BsdfArena& a) {
    return a.make<MeasuredBsdf>(*brdf, SampledWavelengths::sample_visible(0.3f));
  };
  const std::string name = "measured " + std::to_string(surface.alpha_x) + " " +
                           std::to_string(surface.alpha_y) + " " + std::to_string(surface.symmetry);
  return {.name = name, .make = make, .reciprocal = false};
}
template <class Base>
BsdfCase coated_case(const std::string& name, const Coat& coat, const Base& base) {
  return {name, [=](BsdfArena& a) { return a.make<CoatedBsdf<Base>>(coat, base, kSpecularAlpha); },
          true};
}

inline BsdfCase hair_case(float h, float sigma, float beta_m, float beta_n, float tilt) {
  return {"hair " + std::to_string(h) + " " + std::to_string(beta_m) + " " + std::to_string(beta_n),
          [=](BsdfArena& a) {
            return a.make<HairBsdf>(h, 1.55f, ramp(0.5f * sigma, sigma),
                                    HairShape(beta_m, beta_n, tilt));
          },
          false, false, false};
}

inline const PrincipledTables& principled_tables() {
  static const PrincipledTables tables;
  return tables;
}
inline const Bsdf* make_principled_bsdf(BsdfArena& a, const PrincipledSurface& surface,
                                        float specular_alpha = kSpecularAlpha) {
  auto* film = surface.film_weight > 0 ? a.make<PrincipledLayers::FilmNodes>() : nullptr;
  const auto* layers = a.make<PrincipledLayers>(&principled_tables(), surface, film);
  return a.make<PrincipledBsdf>(layers, specular_alpha);
}
/// A surface of roughness alpha; `change` sets the rest.
inline PrincipledSurface principled(float alpha,
                                    const std::function<void(PrincipledSurface&)>& change) {
  PrincipledSurface s;
  s.facets = {alpha, alpha};
  s.metal_color = s.diffuse_color = ramp(0.9f, 0.4f);
  s.lambdas = ramp(400.0f, 700.0f);
  change(s);
  return s;
}
inline BsdfCase principled_case(const std::string& name, float alpha,
                                const std::function<void(PrincipledSurface&)>& change,
                                bool refracts = false) {
  const PrincipledSurface surface = principled(alpha, change);
  const auto make = [=](BsdfArena& a) { return make_principled_bsdf(a, surface); };
  return {.name = "principled " + name, .make = make, .refracts = refracts, .few_angles = true};
}

/// Lobes of the principled surface, alone and layered.
inline std::vector<BsdfCase> principled_cases() {
  using S = PrincipledSurface;
  const auto coat = [](S& s, float alpha) {
    s.coat_weight = 0.8f;
    s.coat_facets = {alpha, alpha};
    s.coat_color = ramp(0.9f, 0.6f);
  };
  const auto metal = [](S& s) {
    s.metalness = 1.0f;
    s.specular_color = ramp(0.5f, 1.0f);
  };
  return {
      principled_case("plastic", 0.09f, [](S&) {}),
      principled_case("smooth plastic", 0.0f, [](S&) {}),
      principled_case("clay", 0.3f,
                      [](S& s) {
                        s.specular_weight = 0.0f;
                        s.diffuse_roughness = 1.0f;
                      }),
      principled_case("metal", 0.4f, metal),
      principled_case("brushed metal", 0.4f,
                      [&](S& s) {
                        metal(s);
                        s.facets = {0.5f, 0.1f};
                      }),
      principled_case("mirror", 0.0f, metal),
      principled_case("metal with film", 0.2f,
                      [&](S& s) {
                        metal(s);
                        s.film_weight = 1.0f;
                      }),
      principled_case("half metal", 0.2f, [](S& s) { s.metalness = 0.5f; }),
      principled_case(
          "glass", 0.0f, [](S& s) { s.transmission = 1.0f; }, true),
      principled_case(
          "frosted glass", 0.3f, [](S& s) { s.transmission = 1.0f; }, true),
      principled_case(
          "air in glass", 0.2f,
          [](S& s) {
            s.transmission = 1.0f;
            s.ior = 0.7f;
          },
          true),
      principled_case(
          "tinted glass below varnish", 0.2f,
          [&](S& s) {
            s.transmission = 0.6f;
            s.transmission_color = ramp(0.9f, 0.3f);
            s.specular_weight = 0.5f;
            coat(s, 0.1f);
          },
          true),
      principled_case(
          "glass with film", 0.25f,
          [](S& s) {
            s.transmission = 0.7f;
            s.film_weight = 1.0f;
          },
          true),
      principled_case(
          "half metal in glass", 0.3f,
          [](S& s) {
            s.metalness = 0.5f;
            s.transmission = 0.7f;
          },
          true),
      principled_case("smooth wall", 0.0f,
                      [](S& s) {
                        s.transmission = 0.8f;
                        s.thin_walled = true;
                      }),
      principled_case("frosted wall", 0.2f,
                      [&](S& s) {
                        s.transmission = 0.8f;
                        s.thin_walled = true;
                        coat(s, 0.0f);
                      }),
      principled_case("leaf", 0.2f,
                      [](S& s) {
                        s.diffuse_transmission = 0.4f;
                        s.diffuse_transmission_color = ramp(0.3f, 0.9f);
                      }),
      principled_case("skin", 0.2f, [](S& s) { s.subsurface = 0.7f; }),
      principled_case("velvet", 0.2f,
                      [](S& s) {
                        s.fuzz_weight = 1.0f;
                        s.fuzz_roughness = 0.3f;
                      }),
      principled_case("car paint", 0.2f,
                      [&](S& s) {
                        s.metalness = 0.5f;
                        s.diffuse_roughness = 0.5f;
                        s.fuzz_weight = 0.3f;
                        coat(s, 0.0f);
                      }),
      principled_case("varnished mirror", 0.0f,
                      [&](S& s) {
                        metal(s);
                        coat(s, 0.0f);
                      }),
      principled_case(
          "all", 0.03f,
          [&](S& s) {
            s.metalness = 0.2f;
            s.transmission = 0.3f;
            s.diffuse_transmission = 0.3f;
            s.subsurface = 0.3f;
            s.fuzz_weight = 0.5f;
            s.film_weight = 0.5f;
            coat(s, 0.15f);
          },
          true),
  };
}

inline std::vector<BsdfCase> simple_cases() {
  const LambertSurface grey{ramp(0.8f, 0.4f)};
  std::vector<BsdfCase> cases = {
      {"diffuse", [](BsdfArena& a) { return a.make<DiffuseBsdf>(ramp(0.9f, 0.1f)); }},
      {"diffusetransmission",
       [](BsdfArena& a) {
         return a.make<DiffuseTransmissionBsdf>(ramp(0.2f, 0.5f), ramp(0.4f, 0.1f));
       }},
      conductor_case(0.0f, 0.0f),
      conductor_case(0.03f, 0.03f),
      conductor_case(0.1f, 0.1f),
      conductor_case(0.1f, 0.4f),
      conductor_case(1.0f, 1.0f),
      dielectric_case(1.5f, 0.0f, 0.0f),
      dielectric_case(1.0f, 0.3f, 0.3f),
      dielectric_case(1.5f, 0.04f, 0.04f),
      dielectric_case(1.5f, 0.2f, 0.2f),
      dielectric_case(1.5f, 0.15f, 0.6f),
      dielectric_case(0.7f, 0.3f, 0.3f),
      subsurface_case(1.33f, 0.0f, 0.0f),
      subsurface_case(1.33f, 0.04f, 0.04f),
      subsurface_case(1.5f, 0.1f, 0.3f),
      {"thindielectric", [](BsdfArena& a) { return a.make<ThinDielectricBsdf>(ramp(1.5f, 1.4f)); }},
      hair_case(0.3f, 0.2f, 0.3f, 0.3f, 2.0f),
      hair_case(-0.7f, 0.0f, 0.5f, 0.2f, 0.0f),
      hair_case(0.95f, 1.0f, 0.9f, 0.9f, 4.0f),
      coated_diffuse_case(1.5f, 0.0f, 0.01f, 0.9f),
      coated_diffuse_case(1.5f, 0.03f, 0.01f, 0.9f),
      coated_diffuse_case(1.5f, 0.3f, 0.1f, 0.5f),
      coated_diffuse_case(0.8f, 0.0f, 0.01f, 0.5f),
      measured_case({0.4f, 0.4f}),
      measured_case({0.12f, 0.12f, 1, 1, 10, 96, 16, 2}),
      measured_case({0.2f, 0.5f, 13, 1, 8, 48, 12, 2}),
      measured_case({0.5f, 0.25f, 5, 4, 8, 48, 12, 2}),
      coated_case("coated lambert anisotropic", make_coat(1.5f, 0.1f, 0.4f, 0.01f, 0.0f), grey),
      coated_case("coated lambert medium", make_coat(1.4f, 0.2f, 0.2f, 0.5f, 0.7f, 0.4f), grey),
      coated_case("coated metal smooth smooth", make_coat(1.5f, 0, 0, 0.01f, 0), metal(0, 0)),
      coated_case("coated metal smooth rough", make_coat(1.5f, 0, 0, 0.01f, 0), metal(.15f, .3f)),
      coated_case("coated metal rough smooth", make_coat(1.5f, .3f, .3f, 0.01f, 0), metal(0, 0)),
      coated_case("coated metal glossy", make_coat(1.5f, .04f, .04f, 0.01f, 0), metal(.03f, .03f)),
      coated_case("coated metal rough medium", make_coat(1.3f, .2f, .2f, 0.3f, .8f, -.2f),
                  metal(.2f, .2f)),
      coated_case("coated metal mirrors medium", make_coat(1.3f, 0, 0, 0.5f, .8f), metal(0, 0)),
  };
  return cases;
}

inline std::vector<BsdfCase> all_cases() {
  std::vector<BsdfCase> cases = simple_cases();
  for (const BsdfCase& c : principled_cases()) cases.push_back(c);
  return cases;
}

}  // namespace nephroid::testing_bsdf
