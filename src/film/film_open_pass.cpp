// Bookkeeping of an unfinished pass: the finished slices, and the pixels that stand in for others.
#include <algorithm>
#include <atomic>

#include "film/film.h"

namespace nephroid {

void Film::finish_slice(int group, size_t slice, uint64_t count) {
  OpenPass& open = open_[group];
  open.done[slice] = 1;
  std::atomic_ref(open.estimates).store(count, std::memory_order_relaxed);
  std::atomic_ref(open.slices).fetch_add(1, std::memory_order_relaxed);
}
bool Film::has_open_pass() const {
  return std::ranges::any_of(
      open_, [](const OpenPass& open) { return open.slices > 0 || open.is_whole != 0; });
}
bool Film::has_light() const {
  for (const PixelSums& sums : sums_)
    for (size_t i = 0; i < depths_.size(); ++i)
      if (!sums.is_zero(i)) return true;
  return false;
}
bool Film::can_be_shown() const {
  const size_t first = slices_.count_of_levels(1);
  for (int g = 0; g < layout().group_count(); ++g)
    if (estimates(g) == 0 && std::ranges::count(std::span(open_[g].done).first(first), 0u) > 0)
      return false;
  return true;
}
void Film::close_pass() {
  for (OpenPass& open : open_) open.is_whole = 0;
}
uint64_t Film::count_of_slice(size_t group, size_t pixel) const {
  const OpenPass& open = open_[group];
  // Called for every layer of a picture: 32-bit divisions are much faster than 64-bit ones.
  const auto p = static_cast<uint32_t>(pixel), w = static_cast<uint32_t>(bounds().width());
  const size_t slice = slices_.slice_of(bounds().x0 + static_cast<int>(p % w),
                                        bounds().y0 + static_cast<int>(p / w));
  return open.done[slice] != 0 ? open.estimates : 0;
}
size_t Film::nearest_of_lattices(size_t group, size_t pixel) const {
  if (count_of(group, pixel) > 0) return pixel;
  const size_t w = bounds().width(), x = pixel % w, y = pixel / w;
  size_t found = pixel;
  for (int level = slices_.levels(); level > 0 && count_of(group, found) == 0; --level) {
    const size_t mask = ~(static_cast<size_t>(slices_.spacing(level - 1)) - 1);
    found = (y & mask) * w + (x & mask);
  }
  return found;
}

}  // namespace nephroid
