#include "input/staging/surroundings.h"

#include <cmath>

#include "input/transform_directives.h"

namespace nephroid {
namespace {

/// The unit vector of the axis on which `v` is longest.
Vec3d nearest_axis(const Vec3d& v) {
  int axis = 0;
  for (int i = 1; i < 3; ++i)
    if (std::abs(v[i]) > std::abs(v[axis])) axis = i;
  Vec3d unit(0, 0, 0);
  unit[axis] = v[axis] < 0 ? -1 : 1;
  return unit;
}

}  // namespace

Mat44d Surroundings::to_world() const {
  Mat44d m;
  for (int i = 0; i < 3; ++i) {
    m[0][i] = east[i];
    m[1][i] = north[i];
    m[2][i] = up[i];
  }
  return m;
}

Surroundings surroundings_of(const SceneDescription& scene) {
  Surroundings s;
  if (!scene.camera) return s;
  const Mat44d& to_camera = scene.camera->world_to_camera.start;
  if (is_singular(to_camera)) return s;
  Vec3d up;
  to_camera.inverse().multDirMatrix(scene.camera->up, up);
  s.up = nearest_axis(up);
  s.east = s.up.x != 0 ? Vec3d(0, 1, 0) : Vec3d(1, 0, 0);
  s.north = s.up.cross(s.east);
  return s;
}

}  // namespace nephroid
