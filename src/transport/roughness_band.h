// The roughness threshold between S and G of a pass, drawn from a band ([C2] in docs/estimators.md,
// docs/routes.md). So a caustic moves from one route to another gradually, not at one roughness.
// All walks of a pass agree, so every path has one owner. It must not know routes.
#pragma once

#include <cmath>

#include "core/sampler.h"
#include "scene/bsdf/bsdf.h"

namespace nephroid {

/// [C2] Roughness alpha up to which a lobe is S in this pass; any run of passes covers the band
/// evenly.
inline float specular_alpha_of_pass(const SpecularBand& band, const PassKey& key) {
  if (!(band.low < band.high)) return band.high;
  // Multiples of the golden ratio: a digit sequence would correlate with the Sobol' points of the
  // pass.
  constexpr uint64_t kStream = 0x62616e64;  // "band"
  constexpr uint64_t kGolden = 0x9e3779b97f4a7c15ull;
  const uint64_t bits = hash_combine(key.seed, kStream) + kGolden * key.pass;
  const float u = bits_to_unit_float(static_cast<uint32_t>(bits >> 32));
  return band.low + (band.high - band.low) * u;
}

}  // namespace nephroid
