// Mitsuba's volumes: constants, and grids in files.
#pragma once

#include <vector>

#include "input/mitsuba/plugin.h"
#include "input/mitsuba/volume_grid.h"

namespace nephroid::mitsuba {

struct VolumeSource {
  VolumeGrid grid;
  Vec3d p0, p1;  ///< box whose cells have the values in their middle
  Mat44d to_world;
};

bool is_grid(const Object& object);

/// The value of a constant volume. Throws SceneError for others.
Vec3d constant_volume(ImportContext& context, const Object& object);

/// The values of a grid. Throws SceneError for other volumes.
VolumeSource read_volume(ImportContext& context, const Object& object);

std::vector<Plugin> volume_plugins();

}  // namespace nephroid::mitsuba
