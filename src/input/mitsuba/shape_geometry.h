// The geometry of one shape of Mitsuba: type, parameters and transform of pbrt-v4's shape.
// Material, media and light are not set.
#pragma once

#include <vector>

#include "input/mitsuba/plugin.h"

namespace nephroid::mitsuba {

struct Geometry {
  std::vector<ShapeDescription> shapes;
  bool is_open = false;  ///< true if the backs of its surfaces can be seen
};

using GeometryWriter = Geometry (*)(PluginProperties& properties);

// quadric_shapes.cpp
Geometry sphere_geometry(PluginProperties& properties);
Geometry disk_geometry(PluginProperties& properties);
Geometry cylinder_geometry(PluginProperties& properties);

// mesh_files.cpp
Geometry rectangle_geometry(PluginProperties& properties);
Geometry cube_geometry(PluginProperties& properties);
Geometry obj_geometry(PluginProperties& properties);
Geometry ply_geometry(PluginProperties& properties);
Geometry serialized_geometry(PluginProperties& properties);

// curve_shapes.cpp
Geometry hair_geometry(PluginProperties& properties);
Geometry spline_geometry(PluginProperties& properties);
Geometry polyline_geometry(PluginProperties& properties);

}  // namespace nephroid::mitsuba
