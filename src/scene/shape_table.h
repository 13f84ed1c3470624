// Makes geometry from Shape directives: one table of shape names. It must not know materials or
// lights.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "input/format_rows.h"
#include "scene/shape/shape.h"
#include "scene/texture/texture.h"

namespace nephroid {

/// Scene data used by shapes with a "displacement".
struct DisplacementInputs {
  const TextureLibrary& textures;
  float edge_scale = 1;  ///< Option "displacementedgescale"
};

/// True if the directive's shapes have an animated transform. Emitting shapes do not move: they
/// stay at their start.
bool is_moving(const ShapeDescription& description);

/// The shapes of one directive, or of all `alike` ones (see shapes_alike). The directive's
/// transform is applied (to world space or that of the object definition) unless the shapes move. A
/// PLY file with triangles and quads gives two shapes. Empty after a warning if nothing is left to
/// render. Throws SceneError or IoError.
std::vector<ShapePtr> make_shapes(std::span<const ShapeDescription> alike, SceneFiles& files,
                                  Diagnostics& diagnostics, const DisplacementInputs& displacement);

/// Number of directives, from the first on, for one make_shapes call: 1 except for similar curves.
size_t shapes_alike(std::span<const ShapeDescription> descriptions);

/// Warns of parameters of the directive that have no effect.
void report_unused_parameters(const ShapeDescription& description, Diagnostics& diagnostics);

/// All types of the format.
std::vector<FormatType> shape_types();

}  // namespace nephroid
