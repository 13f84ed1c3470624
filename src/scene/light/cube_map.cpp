// Faces of a cube to a latitude-longitude map, see cube_map.h.
#include "scene/light/cube_map.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "scene/light/sphere_map.h"

namespace nephroid {
namespace {

/// Limits of the map's height in pixels: small faces have sharp edges, large ones are averaged.
constexpr int kMinHeight = 128, kMaxHeight = 2048;

/// Place on a face: (0,0) is the upper left corner.
struct CubePoint {
  int face;
  Vec2f st;
};

CubePoint cube_point(const Vec3f& w) {
  const Vec3f size(std::abs(w.x), std::abs(w.y), std::abs(w.z));
  const auto place = [](int face, float s, float t, float major) {
    return CubePoint{face, {0.5f * (s / major + 1.0f), 0.5f * (t / major + 1.0f)}};
  };
  if (size.x >= size.y && size.x >= size.z)
    return w.x > 0 ? place(0, -w.z, -w.y, size.x) : place(1, w.z, -w.y, size.x);
  if (size.y >= size.z) return w.y > 0 ? place(2, w.x, w.z, size.y) : place(3, w.x, -w.z, size.y);
  return w.z > 0 ? place(4, w.x, -w.y, size.z) : place(5, -w.x, -w.y, size.z);
}

/// The mean over a pixel, by a grid of samples.
Rgb mean_of_pixel(const CubeFaces& faces, const SphereMap& map, int x, int y, int samples) {
  Rgb sum{0, 0, 0};
  const auto place = [&](int pixel, int sample, int size) {
    return (static_cast<float>(pixel) +
            (static_cast<float>(sample) + 0.5f) / static_cast<float>(samples)) /
           static_cast<float>(size);
  };
  for (int j = 0; j < samples; ++j)
    for (int i = 0; i < samples; ++i) {
      const CubePoint p =
          cube_point(map.direction({place(x, i, map.width()), place(y, j, map.height())}));
      sum = sum + faces[p.face]->bilinear(p.st, WrapMode::kClamp);
    }
  return sum * (1.0f / static_cast<float>(samples * samples));
}

/// Colours over alpha. The alpha of integers is no colour, so it has no encoding.
ImagePtr without_divisor(const Image& image, const Image& stored) {
  constexpr float kSmallest = 1.0f / 255.0f;
  Image::Floats values;
  values.reserve(static_cast<size_t>(image.width()) * image.height() * 3);
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      const float divisor = std::max(stored.value(x, y, 3), kSmallest);
      for (int c = 0; c < 3; ++c) values.push_back(image.value(x, y, c) / divisor);
    }
  return std::make_shared<Image>(image.width(), image.height(), 3, std::move(values),
                                 image.color_space());
}

}  // namespace

ImagePtr read_cube_face(const FileSource& source, const SourceLocation& wanted_by) {
  ImagePtr image = read_image(source, std::nullopt, wanted_by);
  if (image->width() != image->height())
    throw SceneError(wanted_by, "the cube's face \"" + source.path + "\" is " +
                                    std::to_string(image->width()) + " x " +
                                    std::to_string(image->height()) + ", expected a square");
  if (image->channels() != 4) return image;
  return without_divisor(*image, *read_stored_image(source, wanted_by));
}

ImagePtr latitude_longitude_map(const CubeFaces& faces) {
  const int side = faces[0]->width();
  const int height = std::clamp(side > kMaxHeight ? kMaxHeight : 2 * side, kMinHeight, kMaxHeight);
  const int width = 2 * height;
  const int samples = std::max(2, 2 * side / height);
  const SphereMap map(width, height);
  Image::Floats values(static_cast<size_t>(width) * height * 3);
  parallel_chunks(height, 8, [&](int64_t, int64_t begin, int64_t end) {
    for (int y = static_cast<int>(begin); y < end; ++y)
      for (int x = 0; x < width; ++x) {
        const Rgb c = mean_of_pixel(faces, map, x, y, samples);
        float* to = &values[(static_cast<size_t>(y) * width + x) * 3];
        to[0] = c.r;
        to[1] = c.g;
        to[2] = c.b;
      }
  });
  return std::make_shared<Image>(width, height, 3, std::move(values), faces[0]->color_space());
}

}  // namespace nephroid
