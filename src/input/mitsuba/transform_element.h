// The elements of a <transform>: translate, rotate, scale, matrix and lookat. It must not know what
// is transformed.
#pragma once

#include <map>
#include <string>

#include "core/errors.h"
#include "core/math.h"

namespace nephroid::mitsuba {

using Attributes = std::map<std::string, std::string>;

/// The matrix of one element, in the row-vector convention of core/math.h. Throws SceneError if
/// the element is unknown or its attributes are wrong.
Mat44d transform_element(const std::string& tag, const Attributes& attributes,
                         const SourceLocation& where);

}  // namespace nephroid::mitsuba
