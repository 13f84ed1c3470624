// Base class of materials of real surfaces: bump and normal maps tilt the shading frame before the
// BSDF is made. It must not know lobes. Bump mapping: Blinn 1978, by finite differences as in
// pbrt-v4 section 9.8 (10.5.3 of the 4th edition).
#pragma once

#include "scene/material/table.h"
#include "scene/texture/image_placement.h"

namespace nephroid {

/// An image of tangent-space normals, without colour conversion, by default repeated over uv.
class NormalMap {
 public:
  /// Reads the image file "normalmap" and how it is used. Throws SceneError if that fails or the
  /// image does not have three channels.
  NormalMap(const ParameterSet& parameters, SceneFiles& files);
  /// Bilinear value mapped to [-1,1] per component, x and y times the scale, not normalised.
  Vec3f at(const TextureContext& context) const;
  /// True if the second axis points along v, so that mirrored coordinates mirror the map. Else it
  /// is that of a right-handed frame, as in pbrt-v4.
  bool obeys_handedness() const { return obeys_handedness_; }

 private:
  ImagePtr image_;
  ImagePlacement placement_;
  float scale_;
  bool obeys_handedness_;
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
