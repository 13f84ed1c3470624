// The geometry of one shape of Mitsuba: type, parameters and transform of pbrt-v4's shape. Media
// and light are not set, and a material only if the shape's file gives one.
#pragma once

#include <optional>
#include <vector>

#include "input/mesh_data.h"
#include "input/mitsuba/plugin.h"

namespace nephroid::mitsuba {

struct Geometry {
  std::vector<ShapeDescription> shapes;
  bool is_open = false;  ///< true if the backs of its surfaces can be seen
  /// The surface of each shape. Empty if no part of the file has a surface of its own.
  std::vector<std::optional<Surface>> surfaces = {};
  std::vector<const Child*> of_parts = {};  ///< BSDFs that stand in `surfaces`
};

using GeometryWriter = Geometry (*)(PluginProperties& properties);

// quadric_shapes.cpp
Geometry sphere_geometry(PluginProperties& properties);
Geometry disk_geometry(PluginProperties& properties);
Geometry cylinder_geometry(PluginProperties& properties);

// mesh_files.cpp
Geometry rectangle_geometry(PluginProperties& properties);
Geometry cube_geometry(PluginProperties& properties);
Geometry ply_geometry(PluginProperties& properties);
Geometry serialized_geometry(PluginProperties& properties);

/// A mesh of a file. Without normals Mitsuba makes smooth ones.
Geometry mesh_geometry(PluginProperties& properties, MeshData mesh, bool has_face_normals);

// obj_shapes.cpp
Geometry obj_geometry(PluginProperties& properties);

// curve_shapes.cpp
Geometry hair_geometry(PluginProperties& properties);
Geometry spline_geometry(PluginProperties& properties);
Geometry polyline_geometry(PluginProperties& properties);

}  // namespace nephroid::mitsuba
