// Mitsuba's media, with their volumes and phase functions, as media of pbrt-v4.
#pragma once

#include <string>
#include <vector>

#include "input/mitsuba/plugin.h"

namespace nephroid::mitsuba {

/// The name of the medium, which is written at its first use.
std::string write_medium(ImportContext& context, const Object& object);

std::vector<Plugin> medium_plugins();

}  // namespace nephroid::mitsuba
