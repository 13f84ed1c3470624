// Samples of a film that clamps, with photons in batches: each sample is clamped once all batches
// are merged. It must not know photons.
#pragma once

#include <span>
#include <vector>

#include "core/color.h"

namespace nephroid {

struct SamplesToClamp {
  size_t parts = 1;
  std::vector<Rgb> values;     ///< [sample * parts + part]
  std::vector<float> weights;  ///< magnitude of the filter's weight, times the sample's share

  void resize(size_t samples, size_t parts_of_each) {
    parts = parts_of_each;
    values.resize(samples * parts);
    weights.resize(samples);
  }
  bool empty() const { return weights.empty(); }
  std::span<Rgb> sums(size_t sample) { return std::span(values).subspan(sample * parts, parts); }
};

}  // namespace nephroid
