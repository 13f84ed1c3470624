// The Sampler directive: number of samples and seed. The program chooses the sample points itself
// (core/sampler.h), so all types of the format mean the same. It must not know how samples are
// drawn.
#pragma once

#include "input/format_rows.h"

namespace nephroid {

struct SamplerDescription {
  int samples_per_pixel = 16;
  uint64_t seed = 0;
};

/// All types of the format.
std::vector<FormatType> sampler_types();

/// Reads `sampler`, with pbrt-v4's defaults, and `seed` where it has none. Warns of an unknown
/// type. Throws SceneError for an invalid number of samples.
SamplerDescription read_sampler(const std::optional<DirectiveDescription>& sampler, int seed,
                                Diagnostics& diagnostics);

}  // namespace nephroid
