// From a Shape directive to geometry: one table of shape names.
// Who calls it: the scene builder. It must not know materials or lights.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "input/scene_description.h"
#include "scene/shape/shape.h"

namespace nephroid {

/// The shapes of one directive, or of all `alike` ones (see shapes_alike), in world space if
/// `to_world`, else in the space of its object definition (the directive's own transform applied
/// either way). A PLY file with triangles and quads gives two. Empty after a warning where nothing
/// is left to render. Throws SceneError or IoError.
std::vector<ShapePtr> make_shapes(std::span<const ShapeDescription> alike,
                                  const std::string& directory, Diagnostics& diagnostics);

/// How many directives from the first on make_shapes takes at once: 1 but for curves alike.
size_t shapes_alike(std::span<const ShapeDescription> descriptions);

/// Names of all shapes that the table knows.
std::vector<std::string> shape_names();

}  // namespace nephroid
