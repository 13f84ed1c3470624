// The placement of an image on a surface: the set of texture coordinates, an affine map of them,
// and the wrap mode of each axis. It must not know what the image is for.
#pragma once

#include <array>
#include <string>

#include "input/scene_description.h"
#include "scene/texture/image.h"
#include "scene/texture/texture.h"

namespace nephroid {

class ImagePlacement {
 public:
  /// Reads "uvtransform", "uwrap" and "vwrap", with a prefix before each name. Throws SceneError
  /// for values that are wrong.
  ImagePlacement(const ParameterSet& parameters, const std::string& prefix, WrapModes fallback);
  /// Reads "uvset", too; without it the first set is used.
  void choose_set(const ParameterSet& parameters, const std::string& prefix);

  /// The texture coordinates of a point in the set that is used.
  Vec2f coordinates(const TextureContext& context) const {
    return second_set_ ? context.second_uv() : context.uv;
  }
  /// Position in the image (0,0 is the upper left corner) of texture coordinates, whose v runs
  /// upwards.
  Vec2f in_image(const Vec2f& uv) const {
    const auto& m = map_;
    return {m[0] * uv.x + m[1] * uv.y + m[2], 1.0f - (m[3] * uv.x + m[4] * uv.y + m[5])};
  }
  WrapModes wrap() const { return wrap_; }
  /// Pixels of an image of that size per unit of u and of v.
  Vec2f pixels_per_uv(float width, float height) const {
    return {std::hypot(map_[0] * width, map_[3] * height),
            std::hypot(map_[1] * width, map_[4] * height)};
  }

 private:
  bool second_set_ = false;
  std::array<float, 6> map_{1, 0, 0, 0, 1, 0};  ///< two rows of a matrix for columns (u, v, 1)
  WrapModes wrap_;
};

}  // namespace nephroid
