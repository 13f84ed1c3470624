// Mitsuba's BSDFs as materials of pbrt-v4.
#pragma once

#include <string>
#include <vector>

#include "input/mitsuba/plugin.h"

namespace nephroid::mitsuba {

/// The material of a BSDF, which is written at its first use.
Surface write_bsdf(ImportContext& context, const Object& object);

/// The name of a diffuse material without light; written at its first use.
std::string black_material(ImportContext& context, const SourceLocation& where);
/// The name of a boundary that light passes unchanged; written at its first use.
std::string null_material(ImportContext& context, const SourceLocation& where);

std::vector<Plugin> bsdf_plugins();

}  // namespace nephroid::mitsuba
