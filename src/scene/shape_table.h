// From a Shape directive to geometry: one table of shape names.
// Who calls it: the scene builder. It must not know materials or lights.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "input/format_rows.h"
#include "scene/shape/shape.h"
#include "scene/texture/texture.h"

namespace nephroid {

/// What shapes with a "displacement" need of the scene.
struct DisplacementInputs {
  const TextureLibrary& textures;
  float edge_scale = 1;  ///< Option "displacementedgescale"
};

/// True if the shapes of this directive stand under a transform that moves them. Emitting ones do
/// not: they stay at their start.
bool is_moving(const ShapeDescription& description);

/// The shapes of one directive, or of all `alike` ones (see shapes_alike), with the directive's
/// transform applied (in world space, or in that of the object definition) unless they move: then
/// in the space before it. A PLY file with triangles and quads gives two. Empty after a warning
/// where nothing is left to render. Throws SceneError or IoError.
std::vector<ShapePtr> make_shapes(std::span<const ShapeDescription> alike, SceneFiles& files,
                                  Diagnostics& diagnostics, const DisplacementInputs& displacement);

/// How many directives from the first on make_shapes takes at once: 1 but for curves alike.
size_t shapes_alike(std::span<const ShapeDescription> descriptions);

/// Warns of parameters of the directive that have no effect.
void report_unused_parameters(const ShapeDescription& description, Diagnostics& diagnostics);

/// All types of the format.
std::vector<FormatType> shape_types();

}  // namespace nephroid
