#include "input/mitsuba/plugin_tables.h"

#include "input/mitsuba/bsdf_plugins.h"
#include "input/mitsuba/color_value.h"
#include "input/mitsuba/emitter_plugins.h"
#include "input/mitsuba/integrator_names.h"
#include "input/mitsuba/medium_plugins.h"
#include "input/mitsuba/sensor_plugins.h"
#include "input/mitsuba/shape_plugins.h"
#include "input/mitsuba/subsurface_plugins.h"
#include "input/mitsuba/texture_plugins.h"

namespace nephroid::mitsuba {

std::vector<Plugin> plugin_tables() {
  std::vector<Plugin> all;
  for (const auto& table : {shape_plugins(), bsdf_plugins(), subsurface_plugins(),
                            texture_plugins(), spectrum_plugins(), emitter_plugins(),
                            sensor_plugins(), medium_plugins(), integrator_plugins()})
    all.insert(all.end(), table.begin(), table.end());
  return all;
}

}  // namespace nephroid::mitsuba
