// From "curve" directives to one shape. Hair comes as a hundred thousand directives of one curve
// each: neighbours that differ in nothing but their points and widths are made into one geometry.
// Who calls it: the shape table. It must not know materials or lights.
#pragma once

#include <span>

#include "input/scene_description.h"
#include "scene/shape/shape.h"

namespace nephroid {

/// How many directives from the first on are made into one shape: 1 unless they are curves alike.
size_t curves_alike(std::span<const ShapeDescription> descriptions);

/// The curves of one or more directives that are alike, mapped by `transform`. Null after a warning
/// if they have no length or no width. Throws SceneError.
ShapePtr make_curves(std::span<const ShapeDescription> alike, const Transform& transform,
                     Diagnostics& diagnostics);

}  // namespace nephroid
