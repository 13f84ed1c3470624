// Lights with hostile images; see targets.h.
#include <cmath>
#include <cstdio>

#include "fuzz/disk_file.h"
#include "fuzz/targets.h"
#include "input/pbrt_parser.h"
#include "scene/light/light.h"

namespace nephroid::fuzz {
namespace {

const char* const kLights[] = {"\"infinite\"",
                               "\"infinite\" \"point3 portal\" [-1 1 1  1 1 1  1 1 -1  -1 1 -1]",
                               "\"goniometric\"",
                               "\"projection\" \"float fov\" 40",
                               "\"infinite\" \"float illuminance\" 3",
                               "\"goniometric\" \"float power\" 2"};

bool is_density(float pdf) {
  return std::isfinite(pdf) && pdf >= 0.0f;
}

/// Samples and densities must be finite, and their signs consistent.
void use(Light& light) {
  light.set_scene_sphere({Vec3f(0, 0, 0), 2});
  const SampledWavelengths lambda = SampledWavelengths::sample_visible(0.4f);
  const auto must = [](bool good, const char* what) {
    if (good) return;
    std::fprintf(stderr, "a light: %s\n", what);
    __builtin_trap();
  };
  must(std::isfinite(light.power()) && light.power() >= 0, "power");
  for (const Vec2f& u : {Vec2f(0, 0), Vec2f(0.3f, 0.8f), Vec2f(kOneMinusEpsilon, 0.5f)}) {
    const Vec3f from(0.1f, -0.2f, 0.3f);
    if (const auto s = light.sample_towards(from, u, lambda)) {
      must(s->radiance.is_finite() && is_finite(s->wi) && is_density(s->pdf_w) && s->pdf_w > 0,
           "sample_towards");
      must(is_density(light.pdf_towards(from, s->wi, s->p, s->ng)), "pdf_towards");
    }
    if (const auto e = light.sample_emission(u, u, lambda)) {
      must(e->radiance.is_finite() && is_finite(e->ray.d), "sample_emission");
      must(is_density(e->pdf_a) && is_density(e->pdf_w) && e->pdf_a > 0 && e->pdf_w > 0,
           "its densities");
      const EmissionDensity density = light.emission_pdf(e->ng, e->ray.d);
      must(is_density(density.pdf_a) && is_density(density.pdf_w), "emission_pdf");
    }
    must(light.radiance_at_infinity(from, Vec3f(0.6f, 0, 0.8f), lambda).is_finite(),
         "radiance_at_infinity");
  }
}

}  // namespace

void environment(const std::string& bytes) {
  const DiskFile file(bytes, image_suffix(bytes));
  for (const char* light : kLights) {
    Diagnostics diagnostics;
    try {
      const SceneDescription description =
          parse_pbrt_string(std::string("WorldBegin LightSource ") + light +
                                " \"string filename\" \"" + file.path() + "\"",
                            "fuzz.pbrt", ".", diagnostics);
      for (const LightPtr& made : make_lights(description, diagnostics)) use(*made);
    } catch (const Error&) {
    }
  }
}

}  // namespace nephroid::fuzz
