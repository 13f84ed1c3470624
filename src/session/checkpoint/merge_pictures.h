// Merges pictures of disjoint passes. Sums are exact, so the result is that of one run, in any
// order. It must not know scenes: the film is described in its state.
#pragma once

#include <string>
#include <vector>

#include "film/film_output.h"
#include "session/checkpoint/pass_ranges.h"

namespace nephroid {

struct Merged {
  PassRanges passes;
  double seconds = 0;  ///< rendering time of all runs
  std::vector<std::string> warnings;
};

/// Adds up the states of the pictures and writes the sum with its state to `output`. Throws
/// UsageError for pictures of different renders, for passes that two pictures have, and for renders
/// whose passes do not add up. Throws IoError for files that cannot be read or written.
Merged merge_pictures(const std::vector<std::string>& inputs, const std::string& output,
                      LayerPrecision precision = LayerPrecision::kHalf);

}  // namespace nephroid
