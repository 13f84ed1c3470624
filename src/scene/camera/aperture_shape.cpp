// Aperture shapes as small bilinear images: built-in shapes and files; see aperture_shape.h.
#include "scene/camera/aperture_shape.h"

#include <vector>

#include "scene/texture/image_file.h"

namespace nephroid {
namespace {

constexpr int kResolution = 256;

/// True if the polygon winds around p.
bool is_inside(const std::vector<Vec2f>& polygon, const Vec2f& p) {
  bool inside = false;
  for (size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Vec2f &a = polygon[i], &b = polygon[j];
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y))
      inside = !inside;
  }
  return inside;
}

/// An image of f over [-1,1]^2. The format draws its shapes upside down: y grows from the first row
/// to the last.
template <class F>
Image draw(const F& f) {
  Image::Floats values;
  for (int y = 0; y < kResolution; ++y)
    for (int x = 0; x < kResolution; ++x)
      values.push_back(f(Vec2f(-1 + 2 * (static_cast<float>(x) + 0.5f) / kResolution,
                               -1 + 2 * (static_cast<float>(y) + 0.5f) / kResolution)));
  return {kResolution, kResolution, 1, std::move(values), RgbColorSpace::srgb()};
}

Image draw_polygon(const std::vector<Vec2f>& polygon) {
  return draw([&](const Vec2f& p) { return is_inside(polygon, p) ? 1.0f : 0.0f; });
}

/// Corners alternating between two radii, the first one at `angle` (radians from +x).
std::vector<Vec2f> corners(int count, float angle, float even_radius, float odd_radius) {
  std::vector<Vec2f> polygon;
  for (int i = 0; i < count; ++i) {
    const float phi = angle + 2 * kPi * static_cast<float>(i) / static_cast<float>(count);
    const float r = i % 2 == 0 ? even_radius : odd_radius;
    polygon.push_back({r * std::cos(phi), r * std::sin(phi)});
  }
  return polygon;
}

std::optional<Image> built_in_shape(const std::string& name) {
  if (name == "gaussian")
    return draw([](const Vec2f& p) {
      return std::max(0.0f, std::exp(-sqr(p.x) - sqr(p.y)) - std::exp(-1.0f));
    });
  if (name == "square")
    return draw(
        [](const Vec2f& p) { return std::abs(p.x) < 0.5f && std::abs(p.y) < 0.5f ? 1.0f : 0.0f; });
  if (name == "pentagon") return draw_polygon(corners(5, kPi / 2, 0.8f, 0.8f));
  // Five points; the notches lie at the intersections of the lines between the points.
  if (name == "star")
    return draw_polygon(corners(10, 0, std::cos(0.4f * kPi) / std::cos(0.2f * kPi), 1.0f));
  return std::nullopt;
}

}  // namespace

ApertureShape::ApertureShape(const Image& image, const SourceLocation& where)
    : width_(image.width()), height_(image.height()) {
  double sum = 0;
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x) {
      float value = image.value(x, y, 0);
      if (image.channels() >= 3) value = (value + image.value(x, y, 1) + image.value(x, y, 2)) / 3;
      if (!(value >= 0 && std::isfinite(value)))
        throw SceneError(
            where,
            "the aperture image has a value that is negative or not finite, expected 0 or more");
      values_.push_back(value);
      sum += value;
      if (!(value > 0)) continue;
      // By interpolation a pixel's light reaches its neighbours' centres.
      const auto distance = [](int i, int size) {
        return (std::abs(2.0 * (i + 0.5) - size) + 2) / size;
      };
      reach_ = std::max(reach_, std::hypot(distance(x, width_), distance(y, height_)));
    }
  const double mean = sum / (static_cast<double>(width_) * height_);
  if (!(mean > 0)) throw SceneError(where, "the aperture image is black, expected a value above 0");
  reach_ = std::min(reach_, std::sqrt(2.0));
  // A round stop covers pi/4 of its square.
  for (float& value : values_) value *= static_cast<float>(static_cast<double>(kPi) / 4 / mean);
}

float ApertureShape::at(double x, double y) const {
  if (!(std::abs(x) <= 1 && std::abs(y) <= 1)) return 0;
  const double px = (x + 1) / 2 * width_ - 0.5, py = (1 - y) / 2 * height_ - 0.5;
  const int x0 = static_cast<int>(std::floor(px)), y0 = static_cast<int>(std::floor(py));
  const double dx = px - x0, dy = py - y0;
  const auto value = [&](int i, int j) {
    if (i < 0 || j < 0 || i >= width_ || j >= height_) return 0.0;
    return static_cast<double>(values_[static_cast<size_t>(j) * width_ + i]);
  };
  return static_cast<float>((1 - dy) * ((1 - dx) * value(x0, y0) + dx * value(x0 + 1, y0)) +
                            dy * ((1 - dx) * value(x0, y0 + 1) + dx * value(x0 + 1, y0 + 1)));
}

std::shared_ptr<const ApertureShape> make_aperture_shape(const std::string& name, SceneFiles& files,
                                                         const SourceLocation& where) {
  if (name.empty() || name == "circular") return nullptr;
  if (const std::optional<Image> shape = built_in_shape(name))
    return std::make_shared<ApertureShape>(*shape, where);
  const std::string path = files.counted_path_of(name);
  return std::make_shared<ApertureShape>(*read_image(path, std::nullopt, where), where);
}

}  // namespace nephroid
