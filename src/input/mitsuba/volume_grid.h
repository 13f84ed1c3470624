// Reads Mitsuba's .vol files: values on a regular grid. It must not know media. Format: Mitsuba 0.6
// documentation, section 8.7.2.
#pragma once

#include <string_view>
#include <vector>

#include "core/errors.h"
#include "core/math.h"

namespace nephroid::mitsuba {

struct VolumeGrid {
  int resolution[3] = {0, 0, 0};
  int channels = 0;           ///< 1 or 3
  Vec3f min, max;             ///< box of the file
  std::vector<float> values;  ///< channels, then x, y and z, the first the fastest; not negative

  size_t voxels() const { return values.size() / static_cast<size_t>(channels); }
};

/// Reads version 3 with values of 32 bits, as floats, or of 8 bits. Memory is bounded by the size
/// of the file. Throws SceneError at `where`.
VolumeGrid read_volume_grid(std::string_view bytes, const SourceLocation& where);

}  // namespace nephroid::mitsuba
