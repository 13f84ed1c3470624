// A point on a surface as a path sees it: where, which way up, and how its texture runs.
// Filled by Scene::intersect; read by textures, materials, lights and transport.
#pragma once

#include "core/math.h"

namespace nephroid {

struct ShapeRecord;

/// World space throughout. `ng` and the shading frame's z point to the outside of the shape,
/// whatever side the ray came from (flipped by ReverseOrientation, and to the side of the shading
/// normals where a mesh has them). dpdu x dpdv points inwards where a transform swaps handedness.
struct SurfaceInteraction {
  Vec3f p;
  Vec3f p_error;  ///< absolute bound per axis
  Vec3f ng;       ///< unit geometric normal
  Vec3f wo;       ///< unit, back along the ray
  Vec2f uv;
  Vec3f dpdu, dpdv;  ///< of the geometric surface
  Vec3f dndu, dndv;  ///< of the shading normal
  Frame shading;     ///< z is the shading normal, x along the shading dpdu
  Vec3f shading_dpdu, shading_dpdv;
  /// Probability with which a walk that comes this way meets the surface at all (alpha, mixes with
  /// an interface). What is stored here for others to meet is divided by it: they meet it as
  /// rarely.
  float coverage = 1.0f;
  float time = 0.0f;
  float distance = 0.0f;  ///< from the ray's origin
  int face_index = 0;
  int material = -1;    ///< index into Scene's materials
  int area_light = -1;  ///< index into Scene's lights, -1 if the surface does not emit
  uint32_t shape = 0, primitive = 0;    ///< as the Scene numbers them
  const ShapeRecord* record = nullptr;  ///< what the Scene knows of the shape

  Vec3f spawn_origin(const Vec3f& w) const { return offset_ray_origin(p, p_error, ng, w); }
};

}  // namespace nephroid
