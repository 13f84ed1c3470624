// The pictures of several renders of disjoint passes as one: sums are exact, so adding them up in
// any order is what one run would have made. It must not know scenes: what a film is stands in its
// picture.
#pragma once

#include <string>
#include <vector>

#include "film/film_output.h"
#include "session/checkpoint/pass_ranges.h"

namespace nephroid {

struct Merged {
  PassRanges passes;
  double seconds = 0;  ///< of all runs
  std::vector<std::string> warnings;
};

/// Adds up the pictures, each with its state, and writes the sum with its state to `output`. Throws
/// UsageError for pictures of different renders, for passes that two of them have, and for renders
/// whose passes do not add up; IoError for files that cannot be read or written.
Merged merge_pictures(const std::vector<std::string>& inputs, const std::string& output,
                      LayerPrecision precision = LayerPrecision::kHalf);

}  // namespace nephroid
