// How an image shows the whole sphere: an equal-area octahedral map if it is square (pbrt-v4's), a
// latitude-longitude map if it is twice as wide as high, with +z above its top row and
// u = phi / (2 pi), v = theta / pi from the upper left corner (as pbrt-v4's imgtool takes it).
#pragma once

#include "scene/light/piecewise_constant_2d.h"
#include "scene/texture/image.h"

namespace nephroid {

class SphereMap {
 public:
  /// Of an image with these pixels, height equal to width or half of it.
  SphereMap(int width, int height);

  int width() const { return width_; }
  int height() const { return height_; }

  /// The pixel of a unit direction.
  Vec2i pixel(const Vec3f& w) const;
  /// The unit direction at a point of [0,1]^2, such that points that are uniform in a pixel give
  /// directions that are uniform in its solid angle.
  Vec3f direction(const Vec2f& square) const;
  /// Solid angle of a pixel of the row over the mean one, 4 pi / (width * height).
  float relative_solid_angle(int row) const {
    return is_octahedral_ ? 1.0f : static_cast<float>((below_[row + 1] - below_[row]) * height_);
  }
  /// Colour of an image of this map between the centres of the four pixels nearest to a unit
  /// direction.
  Rgb bilinear(const Image& image, const Vec3f& w) const;

 private:
  int width_, height_;
  bool is_octahedral_;
  /// Of latitude-longitude maps, sin^2(theta/2) at the upper rims of the rows, and 1: the share of
  /// the sphere that lies above.
  std::vector<double> below_;
};

}  // namespace nephroid
