// Points on the meshes of a description, each for a piece of their area. It must not know what for.
#pragma once

#include <vector>

#include "input/scene_description.h"

namespace nephroid {

struct SurfacePoint {
  Vec3d p;
  Vec3d area_vector;  ///< normal times the area for which it stands
};

/// Some thousand points of the triangle meshes in the world that emit nothing, at the start of
/// their motion. Large meshes are represented by some of their triangles, and large triangles by
/// several points.
std::vector<SurfacePoint> surface_points(const SceneDescription& scene);

}  // namespace nephroid
