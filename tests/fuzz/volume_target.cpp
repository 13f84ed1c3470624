// The reader of Mitsuba's volumes on hostile bytes; see targets.h.
#include <cmath>

#include "fuzz/targets.h"
#include "input/mitsuba/volume_grid.h"

namespace nephroid::fuzz {

void volume(const std::string& bytes) {
  try {
    const nephroid::mitsuba::VolumeGrid grid = nephroid::mitsuba::read_volume_grid(bytes, {});
    size_t expected = static_cast<size_t>(grid.channels);
    for (const int n : grid.resolution) expected *= static_cast<size_t>(n);
    bool good = grid.values.size() == expected;
    for (const float v : grid.values) good = good && std::isfinite(v) && v >= 0;
    if (!good) __builtin_trap();
  } catch (const Error&) {
  }
}

}  // namespace nephroid::fuzz
