// Texture coordinates of a surface point: pbrt-v4's mappings uv, spherical, cylindrical, planar
// and, for three dimensions, the point in the texture's frame. It must not know what a texture does
// with the coordinates.
#pragma once

#include "scene/texture/noise.h"
#include "scene/texture/texture.h"

namespace nephroid {

/// (s, t) of a point, by the parameters "mapping", "uscale", "vscale", "udelta", "vdelta", "v1" and
/// "v2".
class TextureMapping2D {
 public:
  /// Throws SceneError for an unknown mapping.
  explicit TextureMapping2D(const TextureDescription& description);
  Vec2f map(const TextureContext& context) const;
  /// The detail of a texture that has so many details per unit of s and of t. Spheres and cylinders
  /// have none.
  TextureDetail detail(const Vec2f& per_st) const;

 private:
  enum class Kind { kUv, kSpherical, kCylindrical, kPlanar };
  Kind kind_ = Kind::kUv;
  Vec2f scale_{1, 1}, offset_{0, 0};
  Vec3f axis_s_{1, 0, 0}, axis_t_{0, 1, 0};
  Transform world_to_texture_;
};

/// The point in the coordinate frame at the Texture directive.
class TextureMapping3D {
 public:
  explicit TextureMapping3D(const TextureDescription& description);
  Vec3f map(const TextureContext& context) const { return world_to_texture_.point(context.p); }
  /// The detail of a texture that has so many details per unit of length.
  TextureDetail detail(float per_length) const;
  /// Footprint of a lookup, in the same frame.
  NoiseFootprint footprint(const TextureContext& context) const {
    return {world_to_texture_.vector(context.dpdx), world_to_texture_.vector(context.dpdy)};
  }

 private:
  Transform world_to_texture_;
};

}  // namespace nephroid
