// The shape of an aperture stop that is not round: how much light gets through at each point.
// Who calls it: the lens system (through a pointer) and the realistic camera, which makes it from
// the scene's words. It must not know lenses.
#pragma once

#include <memory>
#include <string>

#include "core/errors.h"
#include "input/scene_files.h"
#include "scene/texture/image.h"

namespace nephroid {

class ApertureShape {
 public:
  /// From an image over the square around the stop, first row on top; its values are averaged over
  /// its channels and scaled so that as much light gets through as through the round stop in it.
  /// Throws SceneError if it is black or has negative values.
  ApertureShape(const Image& image, const SourceLocation& where);

  /// Share of light at a point in units of the stop's radius; 0 outside of [-1,1]^2.
  float at(double x, double y) const;
  /// No light gets through further from the axis than this, in units of the stop's radius.
  double reach() const { return reach_; }

 private:
  int width_, height_;
  std::vector<float> values_;
  double reach_ = 0;
};

/// "gaussian", "square", "pentagon" or "star", or else the image file of that name, relative to
/// the scene; null for "" and "circular". Throws SceneError at `where`.
std::shared_ptr<const ApertureShape> make_aperture_shape(const std::string& name, SceneFiles& files,
                                                         const SourceLocation& where);

}  // namespace nephroid
