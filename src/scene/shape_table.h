// From a Shape directive to geometry: one table of shape names.
// Who calls it: the scene builder. It must not know materials or lights.
#pragma once

#include <string>
#include <vector>

#include "input/scene_description.h"
#include "scene/shape/shape.h"

namespace nephroid {

/// The shapes of one directive, in world space if `to_world`, else in the space of its object
/// definition (the directive's own transform applied either way). A PLY file with triangles and
/// quads gives two. Empty after a warning where nothing is left to render. Throws SceneError or
/// IoError.
std::vector<ShapePtr> make_shapes(const ShapeDescription& description, const std::string& directory,
                                  Diagnostics& diagnostics);

/// Names of all shapes that the table knows.
std::vector<std::string> shape_names();

}  // namespace nephroid
