// A point on a surface: position, orientation, parametrisation. Filled by Scene::intersect; read by
// textures, materials, lights and transport.
#pragma once

#include "core/math.h"

namespace nephroid {

struct MeshData;
struct ShapeRecord;

/// World space throughout. `ng` and the shading frame's z point to the outside of the shape,
/// whichever side the ray came from. ReverseOrientation flips the outside, and shading normals of a
/// mesh decide it. dpdu x dpdv points inwards if a transform swaps handedness.
struct SurfaceInteraction {
  Vec3f p;
  Vec3f p_error;  ///< absolute bound per axis
  Vec3f ng;       ///< unit geometric normal
  Vec3f wo;       ///< unit, back along the ray
  Vec2f uv;
  Vec3f dpdu, dpdv;  ///< derivatives of the geometric surface
  Vec3f dndu, dndv;  ///< derivatives of the shading normal
  Frame shading;     ///< z is the shading normal, x along the shading dpdu
  Vec3f shading_dpdu, shading_dpdv;
  /// Probability that a walk arriving here meets the surface at all (alpha, mixes with an
  /// interface). The flux of photons stored here is divided by it, since camera paths find them
  /// with the same probability.
  float coverage = 1.0f;
  float time = 0.0f;
  float distance = 0.0f;  ///< distance from the ray's origin
  int face_index = 0;
  int material = -1;    ///< index into Scene's materials
  int area_light = -1;  ///< index into Scene's lights, -1 if the surface does not emit
  uint32_t shape = 0, primitive = 0;    ///< in the Scene's numbering
  const ShapeRecord* record = nullptr;  ///< the shape's record in the Scene
  /// The mesh that was hit, if its vertices have more than the usual attributes; else null.
  const MeshData* mesh = nullptr;
  Vec2f barycentric{0, 0};  ///< place in the triangle, if there is a mesh

  Vec3f spawn_origin(const Vec3f& w) const { return offset_ray_origin(p, p_error, ng, w); }
};

}  // namespace nephroid
