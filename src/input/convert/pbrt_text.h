// Values, parameters and matrices as text of pbrt-v4 scenes. It must not know directives.
#pragma once

#include <string>

#include "input/scene_description.h"

namespace nephroid {

/// The text in quotes, with escapes.
std::string quoted_text(const std::string& text);
/// The shortest text that reads as the same number.
std::string shortest_text(double value);
/// `"type name" [ values ]`.
std::string parameter_text(const Parameter& parameter);
/// The sixteen numbers in brackets.
std::string matrix_text(const Mat44d& matrix);
/// Transform directives, on lines of their own, that set both keyframes.
std::string transform_text(const TransformDescription& transform);

}  // namespace nephroid
