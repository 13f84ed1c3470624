// The shape of an aperture stop that is not round: the share of light that passes at each point. It
// must not know lenses.
#pragma once

#include <memory>
#include <string>

#include "core/errors.h"
#include "input/scene_files.h"
#include "scene/texture/image.h"

namespace nephroid {

class ApertureShape {
 public:
  /// Made from an image over the square around the stop, first row on top. Channels are averaged,
  /// and values scaled so that as much light passes as through the round stop in that square.
  /// Throws SceneError if the image is black or has negative values.
  ApertureShape(const Image& image, const SourceLocation& where);

  /// Share of light that passes at a point, in units of the stop's radius; 0 outside of [-1,1]^2.
  float at(double x, double y) const;
  /// Distance from the axis beyond which no light passes, in units of the stop's radius.
  double reach() const { return reach_; }

 private:
  int width_, height_;
  std::vector<float> values_;
  double reach_ = 0;
};

/// The built-in shape "gaussian", "square", "pentagon" or "star", or else the image file of that
/// name, relative to the scene. Null for "" and "circular". Throws SceneError at `where`.
std::shared_ptr<const ApertureShape> make_aperture_shape(const std::string& name, SceneFiles& files,
                                                         const SourceLocation& where);

}  // namespace nephroid
