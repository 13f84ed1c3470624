// Held estimates of one pixel and octave are judged together after the pass, when all counts are
// final. So no decision depends on threads.
#include "film/outlier_rejection.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <numeric>
#include <utility>

#include "core/errors.h"
#include "core/parallel.h"

namespace nephroid {
namespace {

constexpr int kRejectionRowsPerChunk = 4;
constexpr int kLevelOfOne = 32;
constexpr uint64_t kMaxCounted = 255;
/// Brighter estimates are not held: the film's sums report when they saturate.
constexpr float kMaxBrightness = 0x1p56f;
/// [O3] An estimate is no outlier if it changes its pixel by at most kSmallShare of the mean around
/// it, or if it is at most kModerate times as bright as that mean.
constexpr double kSmallShare = 0.25;
constexpr double kModerate = 6;
/// [O2] Factor of the neighbours that confirm an estimate in the wide window. It confirms light
/// that is sampled rarely over a whole region, as of a lamp that is rarely chosen.
constexpr double kWideNeighbours = 2;

void put(std::vector<uint32_t>& words, const void* data, size_t bytes) {
  if (bytes == 0) return;
  const size_t at = words.size();
  words.resize(at + bytes / 4);
  std::memcpy(words.data() + at, data, bytes);
}

int level_of(float brightness, int levels) {
  return std::clamp(std::ilogb(brightness) + kLevelOfOne, 0, levels - 1);
}

}  // namespace

OutlierRejection::OutlierRejection(int width, int height, std::vector<size_t> parts,
                                   OutlierSettings settings)
    : width_(width), height_(height), parts_(std::move(parts)), settings_(std::move(settings)) {
  assert(settings_.exposed_pixels.size() == parts_.size());
  pixels_.resize(parts_.size());
  for (std::vector<Pixel>& group : pixels_) group.resize(static_cast<size_t>(width) * height);
}

float OutlierRejection::brightness(const Rgb& color) {
  return std::max({std::abs(color.r), std::abs(color.g), std::abs(color.b)});
}

/// Moves the last slot into the removed one.
void OutlierRejection::Pixel::remove(size_t slot, size_t parts) {
  const size_t last = --size;
  levels[slot] = levels[last];
  estimates[slot] = estimates[last];
  if (slot != last) std::copy_n(sums.begin() + last * parts, parts, sums.begin() + slot * parts);
  sums.resize(last * parts);
}

bool OutlierRejection::hold(int group, size_t pixel, std::span<const Rgb> values,
                            const Release& release) {
  Rgb total;
  for (const Rgb& value : values) total = total + value;
  const float bright = brightness(total);
  if (!(bright > 0.0f) || !(bright < kMaxBrightness)) return false;
  const int level = level_of(bright, kLevels);
  Pixel& p = pixels_[group][pixel];
  uint8_t& count = p.counts[level];
  if (count < kMaxCounted) ++count;
  if ((p.confirmed >> level & 1) != 0) return false;

  const size_t parts = parts_[group];
  const auto begin = p.levels.begin(), end = begin + p.size;
  size_t slot = std::find(begin, end, level) - begin;
  if (slot == p.size) {
    if (p.size == kMaxHeld) {
      const size_t darkest = std::min_element(begin, end) - begin;
      if (level < p.levels[darkest]) return false;
      release(group, pixel, p.parts_of(darkest, parts));
      p.remove(darkest, parts);
    }
    slot = p.size++;
    p.levels[slot] = static_cast<uint8_t>(level);
    p.estimates[slot] = 0;
    p.sums.resize(p.size * parts);
  }
  ++p.estimates[slot];
  const std::span<RgbSum> sums = p.parts_of(slot, parts);
  for (size_t i = 0; i < parts; ++i)
    for (int c = 0; c < 3; ++c) sums[i].rgb[c].add(values[i][c]);
  return true;
}

OutlierRejection::Window OutlierRejection::window_around(size_t pixel, int radius) const {
  const int x = static_cast<int>(pixel % width_);
  const int y = static_cast<int>(pixel / width_);
  return {std::max(0, x - radius), std::max(0, y - radius), std::min(width_, x + radius + 1),
          std::min(height_, y + radius + 1)};
}

uint64_t OutlierRejection::similar_in(const Window& w, int group, int level) const {
  const size_t first = std::max(0, level - 1);
  const size_t last = std::min(kLevels - 1, level + 1);
  uint64_t similar = 0;
  for (int y = w.y0; y < w.y1; ++y)
    for (int x = w.x0; x < w.x1; ++x)
      for (size_t l = first; l <= last; ++l)
        similar += pixels_[group][static_cast<size_t>(y) * width_ + x].counts[l];
  return similar;
}

uint64_t OutlierRejection::as_bright_in(int group, size_t pixel, int level) const {
  const std::array<uint8_t, kLevels>& counts = pixels_[group][pixel].counts;
  return std::accumulate(counts.begin() + std::max(0, level - 1), counts.end(), uint64_t{0});
}

bool OutlierRejection::is_confirmed(int group, size_t pixel, int level, uint64_t estimates,
                                    std::span<const float> shown) const {
  // [O3]
  const Window w = window_around(pixel, kWindowRadius);
  double surroundings = 0;
  for (int y = w.y0; y < w.y1; ++y)
    for (int x = w.x0; x < w.x1; ++x)
      surroundings += double{shown[static_cast<size_t>(y) * width_ + x]};
  surroundings /= w.area();
  const double limit = std::max(kModerate, kSmallShare * static_cast<double>(estimates));
  if (std::ldexp(1.0, level + 1 - kLevelOfOne) <= limit * surroundings) return true;
  // [O2]
  const double light_paths =
      settings_.neighbours * std::max(1.0, double{settings_.exposed_pixels[group]});
  const auto counted = static_cast<double>(std::min(estimates, kMaxCounted));
  const auto confirms = [&](const Window& window, double enough) {
    return static_cast<double>(similar_in(window, group, level)) >=
           std::min(enough, counted * window.area() / 2);
  };
  return static_cast<double>(as_bright_in(group, pixel, level)) >=
             std::max<double>(settings_.neighbours, counted / 2) ||
         confirms(w, light_paths) ||
         confirms(window_around(pixel, kWideWindowRadius), kWideNeighbours * light_paths);
}

void OutlierRejection::finish_pass(int group, uint64_t estimates, std::span<const float> shown,
                                   const Release& release) {
  std::vector<Pixel>& pixels = pixels_[group];
  const size_t parts = parts_[group];
  const size_t width = width_;
  parallel_chunks(height_, kRejectionRowsPerChunk, [&](int64_t, int64_t begin, int64_t end) {
    for (size_t i = begin * width; i < end * width; ++i) {
      Pixel& p = pixels[i];
      for (size_t slot = 0; slot < p.size;) {
        const int level = p.levels[slot];
        if (!is_confirmed(group, i, level, estimates, shown)) {
          ++slot;
          continue;
        }
        p.confirmed |= uint64_t{1} << level;
        release(group, i, p.parts_of(slot, parts));
        p.remove(slot, parts);
      }
    }
  });
}

RgbSum OutlierRejection::held(int group, size_t pixel) const {
  RgbSum sum;
  for (const RgbSum& part : pixels_[group][pixel].sums) sum.add(part);
  return sum;
}

uint64_t OutlierRejection::held_estimates() const {
  uint64_t count = 0;
  for (const std::vector<Pixel>& group : pixels_)
    for (const Pixel& p : group)
      for (size_t slot = 0; slot < p.size; ++slot) count += p.estimates[slot];
  return count;
}

// For each pixel of each group: group and pixel index, PixelHead, held sums.
size_t OutlierRejection::most_words() const {
  size_t words = 0;
  for (size_t g = 0; g < pixels_.size(); ++g)
    words +=
        pixels_[g].size() * (2 + (sizeof(PixelHead) + kMaxHeld * parts_[g] * sizeof(RgbSum)) / 4);
  return words;
}

std::vector<uint32_t> OutlierRejection::save() const {
  std::vector<uint32_t> words;
  for (size_t g = 0; g < pixels_.size(); ++g)
    for (size_t i = 0; i < pixels_[g].size(); ++i) {
      const Pixel& p = pixels_[g][i];
      const uint32_t place[2] = {static_cast<uint32_t>(g), static_cast<uint32_t>(i)};
      put(words, place, sizeof place);
      put(words, static_cast<const PixelHead*>(&p), sizeof(PixelHead));
      put(words, p.sums.data(), p.sums.size() * sizeof(RgbSum));
    }
  return words;
}

void OutlierRejection::load(std::span<const uint32_t> words) {
  const auto take = [&](void* data, size_t bytes) {
    if (words.size() * 4 < bytes) throw IoError("outlier data are damaged: they end too early");
    if (bytes > 0) std::memcpy(data, words.data(), bytes);
    words = words.subspan(bytes / 4);
  };
  while (!words.empty()) {
    uint32_t place[2];
    take(place, sizeof place);
    if (place[0] >= pixels_.size() || place[1] >= pixels_[place[0]].size())
      throw IoError("outlier data are damaged: pixel index out of range");
    Pixel& p = pixels_[place[0]][place[1]];
    take(static_cast<PixelHead*>(&p), sizeof(PixelHead));
    if (p.size > kMaxHeld || std::any_of(p.levels.begin(), p.levels.end(),
                                         [](uint8_t level) { return level >= kLevels; }))
      throw IoError("outlier data are damaged: values of a pixel out of range");
    p.sums.resize(p.size * parts_[place[0]]);
    take(p.sums.data(), p.sums.size() * sizeof(RgbSum));
  }
}

}  // namespace nephroid
