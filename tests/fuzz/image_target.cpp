// Texture images, read whole and tile by tile; see targets.h.
#include <cstdlib>

#include "fuzz/disk_file.h"
#include "fuzz/targets.h"
#include "scene/texture/image_file.h"

namespace nephroid::fuzz {
namespace {

void look_at(const Image& image) {
  if (image.width() < 1 || image.height() < 1) __builtin_trap();
  float sum = 0;
  for (const WrapMode wrap :
       {WrapMode::kRepeat, WrapMode::kBlack, WrapMode::kClamp, WrapMode::kOctahedralSphere})
    for (const Vec2f& st : {Vec2f(0, 0), Vec2f(0.3f, 0.8f), Vec2f(1, 1), Vec2f(-3.7f, 1e9f)}) {
      sum += image.nearest(st, wrap).r + image.bilinear(st, wrap).g;
      sum += image.nearest_float(st, wrap) + image.bilinear_float(st, wrap);
    }
  for (int y = 0; y < image.height(); y += 1 + image.height() / 8)
    for (int x = 0; x < image.width(); x += 1 + image.width() / 8)
      sum += image.value(x, y, image.channels() - 1);
  if (sum == 12345.678f) std::abort();  // keeps the compiler from dropping the sum
}

}  // namespace

void image(const std::string& bytes) {
  const DiskFile file(bytes, image_suffix(bytes));
  try {
    look_at(*read_image(file.path(), std::nullopt, {}));
  } catch (const Error&) {
  }
  try {
    look_at(*read_stored_image(file.path(), {}));
  } catch (const Error&) {
  }
  try {
    // A cache too small to read any image whole.
    ImageCache cache(1 << 16);
    for (const auto& encoding : {ColorEncoding::srgb(), ColorEncoding::linear()})
      look_at(*cache.get(file.path(), encoding, {}));
  } catch (const Error&) {
  }
}

}  // namespace nephroid::fuzz
