// Maps from image to sphere: an equal-area octahedral map (pbrt-v4's) if the image is square, a
// latitude-longitude map if it is twice as wide as high. The latter is pbrt-v4 imgtool's: +z above
// the top row, u = phi / (2 pi), v = theta / pi from the upper left corner.
#pragma once

#include "scene/light/piecewise_constant_2d.h"
#include "scene/texture/image.h"

namespace nephroid {

class SphereMap {
 public:
  /// The map of an image of this size; height is equal to width or half of it.
  SphereMap(int width, int height);

  int width() const { return width_; }
  int height() const { return height_; }

  /// The pixel of a unit direction.
  Vec2i pixel(const Vec3f& w) const;
  /// The unit direction at a point of [0,1]^2. Uniform points in a pixel give directions uniform in
  /// the pixel's solid angle.
  Vec3f direction(const Vec2f& square) const;
  /// Solid angle of a pixel in this row over the mean one, 4 pi / (width * height).
  float relative_solid_angle(int row) const {
    return is_octahedral_ ? 1.0f : static_cast<float>((below_[row + 1] - below_[row]) * height_);
  }
  /// Colour of an image with this map at a unit direction, interpolated between the centres of the
  /// four nearest pixels.
  Rgb bilinear(const Image& image, const Vec3f& w) const;

 private:
  int width_, height_;
  bool is_octahedral_;
  /// Latitude-longitude maps: sin^2(theta/2) at the upper edges of the rows, then 1. It is the
  /// share of the sphere above the edge.
  std::vector<double> below_;
};

}  // namespace nephroid
