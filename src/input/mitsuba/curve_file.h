// Reads the strands of Mitsuba's hair files, as text or BINARY_HAIR, and of its files of curves,
// which have a radius at each point. It must not know scenes.
#pragma once

#include <string_view>
#include <vector>

#include "core/errors.h"
#include "core/math.h"

namespace nephroid::mitsuba {

struct Strand {
  std::vector<Vec3f> points;
  std::vector<float> radii;  ///< per point, or empty
};

/// Strands of a text with one point in each line, "x y z" or "x y z radius", separated by empty
/// lines, or of a BINARY_HAIR file. Throws SceneError at `where` with the line in the file.
std::vector<Strand> read_strands(std::string_view bytes, bool has_radii,
                                 const SourceLocation& where);

}  // namespace nephroid::mitsuba
