// Octahedral and latitude-longitude maps, see sphere_map.h.
#include "scene/light/sphere_map.h"

#include "core/equal_area_map.h"

namespace nephroid {
namespace {

/// (u, v) of a unit direction in a latitude-longitude map, both in [0,1].
Vec2f latitude_longitude(const Vec3f& w) {
  const double phi = std::atan2(double{w.y}, double{w.x});
  const double theta = std::atan2(std::hypot(double{w.x}, double{w.y}), double{w.z});
  const double turns = phi / (2.0 * kPiDouble);
  return {static_cast<float>(turns < 0.0 ? turns + 1.0 : turns),
          static_cast<float>(theta / kPiDouble)};
}

}  // namespace

SphereMap::SphereMap(int width, int height)
    : width_(width), height_(height), is_octahedral_(width == height) {
  if (is_octahedral_) return;
  below_.resize(static_cast<size_t>(height) + 1);
  for (int y = 0; y <= height; ++y) {
    // Below the equator by the angle from the lower pole, which keeps precision for small pixels.
    const bool lower = 2 * y > height;
    const double half = std::sin(0.5 * kPiDouble * (lower ? height - y : y) / height);
    below_[y] = lower ? 1.0 - half * half : half * half;
  }
}

Vec2i SphereMap::pixel(const Vec3f& w) const {
  const Vec2f st = is_octahedral_ ? equal_area_sphere_to_square(w) : latitude_longitude(w);
  return {std::clamp(static_cast<int>(st.x * static_cast<float>(width_)), 0, width_ - 1),
          std::clamp(static_cast<int>(st.y * static_cast<float>(height_)), 0, height_ - 1)};
}

Vec3f SphereMap::direction(const Vec2f& square) const {
  if (is_octahedral_) return equal_area_square_to_sphere(square);
  const double y = double{square.y} * height_;
  const int row = std::clamp(static_cast<int>(y), 0, height_ - 1);
  const double above = below_[row] + (y - row) * (below_[row + 1] - below_[row]);
  const double ring = 2.0 * std::sqrt(std::max(0.0, above * (1.0 - above)));
  const double phi = 2.0 * kPiDouble * square.x;
  return to_float(Vec3d(ring * std::cos(phi), ring * std::sin(phi), 1.0 - 2.0 * above));
}

Rgb SphereMap::bilinear(const Image& image, const Vec3f& w) const {
  if (is_octahedral_)
    return image.bilinear(equal_area_sphere_to_square(w), WrapMode::kOctahedralSphere);
  const Vec2f st = latitude_longitude(w);
  const float x = st.x * static_cast<float>(width_) - 0.5f;
  const float y = st.y * static_cast<float>(height_) - 0.5f;
  const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
  const float dx = x - static_cast<float>(x0), dy = y - static_cast<float>(y0);
  const float weights[4] = {(1 - dx) * (1 - dy), dx * (1 - dy), (1 - dx) * dy, dx * dy};
  Rgb sum{0, 0, 0};
  for (int i = 0; i < 4; ++i) {
    int xi = x0 + (i & 1) + width_, yi = y0 + (i >> 1);
    // Beyond a pole the map continues half a turn away.
    if (yi < 0 || yi >= height_) {
      yi = yi < 0 ? 0 : height_ - 1;
      xi += width_ / 2;
    }
    const Rgb c = image.texel(xi % width_, yi, WrapMode::kClamp);
    sum = {sum.r + weights[i] * c.r, sum.g + weights[i] * c.g, sum.b + weights[i] * c.b};
  }
  return sum;
}

}  // namespace nephroid
