// Complex refractive indices of conductors by Mitsuba's names. It must not know BSDFs.
#pragma once

#include <string>

#include "input/scene_description.h"

namespace nephroid::mitsuba {

struct MetalIndex {
  Parameter eta, k;  ///< without names
};

/// Throws SceneError at `where` if the name is unknown.
MetalIndex metal_index(const std::string& name, const SourceLocation& where);

}  // namespace nephroid::mitsuba
