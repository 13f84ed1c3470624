// All tables of Mitsuba's plug-ins, for the documentation and tests.
#pragma once

#include <vector>

#include "input/mitsuba/plugin.h"

namespace nephroid::mitsuba {

std::vector<Plugin> plugin_tables();

}  // namespace nephroid::mitsuba
