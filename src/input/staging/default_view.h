// Camera and light for scenes without them: a three-quarter view, a neutral sky and a soft key
// light.
#pragma once

#include <array>
#include <span>

#include "input/scene_description.h"
#include "input/staging/scene_bounds.h"
#include "input/staging/surroundings.h"

namespace nephroid {

/// A perspective camera whose square of view just holds the scene, from the front right and above;
/// the front is the south.
class FramedView {
 public:
  explicit FramedView(const Surroundings& surroundings);

  /// Directions for scene_extent: the outward normals of the four sides of the field of view.
  std::span<const Vec3d> sides() const { return sides_; }
  /// The camera for an extent in these directions, which is not empty.
  CameraDescription camera(const SceneExtent& extent) const;

 private:
  Vec3d up_, right_, above_, forward_;
  std::array<Vec3d, 4> sides_;
};

/// True if the scene has a light, or a shape that emits more than `glow`, in cd/m^2.
bool has_light(const SceneDescription& scene, double glow);

/// Adds a sky of equal luminance in all directions and a lamp above the left of the front. A white
/// surface that faces the lamp gets the value 1 at iso 100. The bounds are not empty.
void add_studio_light(SceneDescription* scene, const Bounds3d& bounds,
                      const Surroundings& surroundings);

/// Adds a matte grey disk just under the lowest point. The bounds are not empty.
void add_floor(SceneDescription* scene, const Bounds3d& bounds, const Surroundings& surroundings);

/// The location of directives that no file has.
SourceLocation not_in_a_file(const char* what);

}  // namespace nephroid
