// The light of a description at a point, before anything is built: nothing casts a shadow, and
// images are not read. It must not know shapes that emit nothing.
#pragma once

#include <vector>

#include "input/scene_description.h"

namespace nephroid {

/// A mesh that emits, as seen from afar.
struct GlowingMesh {
  Vec3d centre{0, 0, 0};
  Vec3d area_vector{0, 0, 0};  ///< sum of normals times areas: 0 for a closed mesh
  double area = 0;
  double luminance = 0;
  bool is_two_sided = false;

  double illuminance(const Vec3d& p) const;
};

class Illumination {
 public:
  /// The lights and emitting meshes of a scene, which must live as long.
  explicit Illumination(const SceneDescription& scene);

  /// Illuminance in lux of a surface that faces the light. The mean luminance of images of
  /// surroundings is taken to be 0.5 if the file does not give it, and that of images on shapes a
  /// quarter of their factor.
  double at(const Vec3d& p) const;

 private:
  const std::vector<LightDescription>& lights_;
  std::vector<GlowingMesh> glows_;
};

}  // namespace nephroid
