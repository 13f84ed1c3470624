// The Sampler directive: how many samples and which seed. Where the points lie is the program's own
// choice (core/sampler.h), so all types of the format mean the same.
// Who calls it: the scene builder. It must not know how samples are drawn.
#pragma once

#include "input/format_rows.h"

namespace nephroid {

struct SamplerDescription {
  int samples_per_pixel = 16;
  uint64_t seed = 0;
};

/// All types of the format.
std::vector<FormatType> sampler_types();

/// What `sampler` says; pbrt-v4's defaults where it does not, `seed` where it gives none. Warns of
/// an unknown type; throws SceneError for a number of samples that cannot be.
SamplerDescription read_sampler(const std::optional<DirectiveDescription>& sampler, int seed,
                                Diagnostics& diagnostics);

}  // namespace nephroid
