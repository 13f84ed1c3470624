// Base class of materials of real surfaces: bump and normal maps tilt the shading frame before the
// BSDF is made. It must not know lobes. Bump mapping: Blinn 1978, by finite differences as in
// pbrt-v4 section 9.8 (10.5.3 of the 4th edition).
#pragma once

#include "scene/material/table.h"

namespace nephroid {

/// An image of tangent-space normals, without colour conversion, repeated over uv.
class NormalMap {
 public:
  /// Reads an image file. Throws IoError if that fails, and SceneError at `where` if the image does
  /// not have three channels.
  NormalMap(const std::string& file, const SourceLocation& where);
  /// Bilinear value at uv (v upwards) mapped to [-1,1] per component, not normalised.
  Vec3f at(const Vec2f& uv) const;

 private:
  ImagePtr image_;
};

class SurfaceMaterial : public Material {
 public:
  /// Reads "displacement" and "normalmap".
  SurfaceMaterial(const MaterialDescription& description, const MaterialContext& context);

  void bump(SurfaceInteraction& point) const final;
  bool has_bump() const final { return displacement_ || normal_map_; }

 private:
  FloatTexturePtr displacement_;
  std::shared_ptr<const NormalMap> normal_map_;
};

}  // namespace nephroid
