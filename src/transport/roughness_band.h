// Where S ends and G begins in a pass. A fixed threshold of roughness would move a caustic from one
// route to another at one step of a slider; so the threshold is drawn for each pass from a band,
// and a lobe inside of the band is S in a share of the passes that falls evenly from 1 to 0 (docs/
// routes.md). All walks of a pass agree, so every path still has one owner. It must not know
// routes.
#pragma once

#include <cmath>

#include "core/sampler.h"
#include "scene/bsdf/bsdf.h"

namespace nephroid {

/// Alpha up to which a lobe is of class S in this pass; even over the band for any run of passes.
inline float specular_alpha_of_pass(const SpecularBand& band, const PassKey& key) {
  if (!(band.low < band.high)) return band.high;
  // Multiples of the golden ratio: unlike a digit sequence they have nothing in common with the
  // Sobol' points by which a pass chooses all else.
  constexpr uint64_t kStream = 0x62616e64;  // "band"
  constexpr uint64_t kGolden = 0x9e3779b97f4a7c15ull;
  const uint64_t bits = hash_combine(key.seed, kStream) + kGolden * key.pass;
  const float u = bits_to_unit_float(static_cast<uint32_t>(bits >> 32));
  return band.low + (band.high - band.low) * u;
}

}  // namespace nephroid
