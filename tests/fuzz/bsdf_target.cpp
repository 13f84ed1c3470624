// Reads hostile files of measured BSDFs and evaluates them; see targets.h.
#include "fuzz/targets.h"
#include "scene/material/measured_file.h"

namespace nephroid::fuzz {
namespace {

/// Evaluates and samples a few times on both sides: all results must be numbers.
void use(const MeasuredBrdf& brdf) {
  const MeasuredBsdf bsdf(brdf, SampledWavelengths::sample_visible(0.4f));
  const Vec3f directions[] = {
      {0, 0, 1}, {0.6f, 0, 0.8f}, {-0.6f, 0.64f, 0.48f}, {0, -1, 1e-20f}, {0, 0.8f, -0.6f}};
  bool good = true;
  for (const Vec3f& wo : directions) {
    good = good && bsdf.albedo(wo).is_finite();
    for (const TransportMode mode : {TransportMode::kRadiance, TransportMode::kImportance}) {
      for (const Vec3f& wi : directions) {
        const BsdfEval e = bsdf.eval(wo, wi, mode, EventClass::kGlossy, ClassMask::kAll);
        good = good && e.f.is_finite() && (e.f * -1.0f).max_component() <= 0.0f && e.pdf_w >= 0.0f;
      }
      for (const Vec2f& u : {Vec2f(0, 0), Vec2f(0.3f, 0.8f), Vec2f(kOneMinusEpsilon, 0.5f)}) {
        const auto s = bsdf.sample(wo, 0, u, mode, ClassMask::kAll);
        if (s) good = good && s->f.is_finite() && is_finite(s->wi) && s->pdf_w > 0.0f;
      }
    }
  }
  if (!good) __builtin_trap();
}

}  // namespace

void bsdf(const std::string& bytes) {
  try {
    use(measured_brdf_from(TensorFile(bytes, "measured.bsdf", {})));
  } catch (const Error&) {
  }
}

}  // namespace nephroid::fuzz
