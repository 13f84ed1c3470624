// Makes shapes from "curve" directives. Hair comes as a hundred thousand directives of one curve
// each: adjacent ones that differ only in points and widths are joined into one geometry. It must
// not know materials or lights.
#pragma once

#include <span>

#include "input/scene_description.h"
#include "scene/shape/shape.h"

namespace nephroid {

/// Number of directives, from the first on, that form one shape: 1 unless they are similar curves.
size_t curves_alike(std::span<const ShapeDescription> descriptions);

/// The curves of one or more similar directives, mapped by `transform`. Null after a warning if
/// they have no length or no width. Throws SceneError.
ShapePtr make_curves(std::span<const ShapeDescription> alike, const Transform& transform,
                     Diagnostics& diagnostics);

}  // namespace nephroid
