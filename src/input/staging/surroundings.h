// East, north and up of a scene: the frame of skies and suns, and what stands on a floor.
#pragma once

#include "input/scene_description.h"

namespace nephroid {

/// A right-handed orthonormal frame of world axes.
struct Surroundings {
  Vec3d east{1, 0, 0}, north{0, 0, -1}, up{0, 1, 0};

  /// Object to world of things whose +z is up and whose +y is north.
  Mat44d to_world() const;
};

/// Up is the world axis nearest to CameraDescription::up; +y without a camera.
Surroundings surroundings_of(const SceneDescription& scene);

}  // namespace nephroid
