#include "view/comparisons.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/errors.h"
#include "image/compare.h"
#include "image/flip.h"

namespace nephroid {
namespace {

constexpr unsigned kLetters = 26;
/// As in the PNG: the film's own exposure is in its values.
constexpr float kExposure = 1;

/// FLIP from 0 to 1 on the scale of the heat map, which is logarithmic.
HeatColor flip_color(double flip) {
  return heat_color(kHeatMin * std::pow(kHeatMax / kHeatMin, std::clamp(flip, 0.0, 1.0)));
}

void check_same_part(const Picture& reference, const Picture& test) {
  const auto name = [](const Picture& picture) {
    const PixelBounds& window = picture.window;
    return fmt::format("columns {} to {} and rows {} to {} of {} x {} pixels", window.x0, window.x1,
                       window.y0, window.y1, picture.full_width, picture.full_height);
  };
  const std::string there = name(reference), here = name(test);
  if (there != here)
    throw UsageError(
        fmt::format("the picture to compare with has {}, expected {} as here", there, here));
}

}  // namespace

Picture color_picture(const Film& film) {
  Picture picture;
  picture.full_width = film.settings().width;
  picture.full_height = film.settings().height;
  picture.window = film.bounds();
  picture.color_space = film.settings().color_space;
  picture.channels = {"R", "G", "B"};
  picture.pixels.reserve(static_cast<size_t>(picture.window.area()) * 3);
  for (int y = picture.window.y0; y < picture.window.y1; ++y)
    for (int x = picture.window.x0; x < picture.window.x1; ++x) {
      const Rgb value = film.value(x, y);
      picture.pixels.insert(picture.pixels.end(), {value.r, value.g, value.b});
    }
  return picture;
}

Picture color_picture(const Picture& picture) {
  int channels[3];
  for (int c = 0; c < 3; ++c) {
    channels[c] = picture.find_channel(std::string(1, "RGB"[c]));
    if (channels[c] < 0)
      throw UsageError("the picture has no channels R, G and B, expected a picture in colour");
  }
  Picture colors;
  static_cast<PictureHead&>(colors) = picture;
  colors.channels = {"R", "G", "B"};
  colors.metadata.clear();
  const size_t pixels = static_cast<size_t>(picture.window.area());
  colors.pixels.reserve(pixels * 3);
  for (size_t i = 0; i < pixels; ++i)
    for (const int channel : channels)
      colors.pixels.push_back(
          picture.pixels[i * picture.channels.size() + static_cast<size_t>(channel)]);
  return colors;
}

std::string Comparisons::add_snapshot(Picture picture, const std::string& description) {
  const std::lock_guard lock(mutex_);
  const auto is_snapshot = [](const Entry& entry) { return entry.is_snapshot; };
  if (static_cast<size_t>(std::ranges::count_if(entries_, is_snapshot)) >= kMaxSnapshots)
    entries_.erase(std::ranges::find_if(entries_, is_snapshot));
  const unsigned number = snapshots_++;
  std::string id(1, static_cast<char>('A' + number % kLetters));
  if (number >= kLetters) id += std::to_string(number / kLetters);
  entries_.push_back({id, fmt::format("{}: {}", id, description), true,
                      std::make_shared<const Picture>(std::move(picture))});
  return id;
}

std::string Comparisons::add_file(Picture picture, const std::string& name) {
  const std::lock_guard lock(mutex_);
  if (static_cast<size_t>(std::ranges::count(entries_, false, &Entry::is_snapshot)) >= kMaxFiles)
    throw UsageError(fmt::format("there are {} pictures already, remove one first", kMaxFiles));
  const std::string id = fmt::format("file{}", ++files_);
  entries_.push_back({id, name, false, std::make_shared<const Picture>(std::move(picture))});
  return id;
}

bool Comparisons::remove(const std::string& id) {
  const std::lock_guard lock(mutex_);
  return std::erase_if(entries_, [&](const Entry& entry) { return entry.id == id; }) > 0;
}

std::vector<ListedComparison> Comparisons::list() const {
  const std::lock_guard lock(mutex_);
  std::vector<ListedComparison> list;
  for (const Entry& entry : entries_) list.push_back({entry.id, entry.name});
  return list;
}

std::shared_ptr<const Picture> Comparisons::find(const std::string& id) const {
  const std::lock_guard lock(mutex_);
  const auto found = std::ranges::find(entries_, id, &Entry::id);
  return found == entries_.end() ? nullptr : found->picture;
}

Distance distance(const Picture& reference, const Picture& test) {
  check_same_part(reference, test);
  const Comparison errors = compare_pictures(reference, test, {});
  return {errors.relmse, errors.relmse_trim, flip(reference, test, kExposure)};
}

std::vector<uint8_t> heat_png(const Picture& reference, const Picture& test,
                              const std::string& kind) {
  check_same_part(reference, test);
  const int width = reference.width(), height = reference.height();
  if (kind == "relmse") return encode_png(width, height, heat_map(reference, test));
  if (kind != "flip")
    throw UsageError("kind: '" + kind + "' is not valid, expected relmse or flip");
  std::vector<uint8_t> bytes;
  for (const double flip : flip_errors(width, height, display_colors(reference, kExposure),
                                       display_colors(test, kExposure))) {
    const HeatColor color = flip_color(flip);
    bytes.insert(bytes.end(), {color.r, color.g, color.b});
  }
  return encode_png(width, height, bytes);
}

}  // namespace nephroid
