#include "film/pixel_slices.h"

#include <algorithm>
#include <bit>

namespace nephroid {

PixelSlices::PixelSlices(const PixelBounds& crop) : crop_(crop) {
  const int width = crop.width(), height = crop.height();
  const auto points = [](int length, int spacing) { return (length + spacing - 1) / spacing; };
  while (int64_t{points(width, 1 << (levels_ - 1))} * points(height, 1 << (levels_ - 1)) >
         kMaxFirstPixels)
    ++levels_;
  size_t slices = 0;
  for (int level = 0; level < levels_; ++level) {
    const int spacing = 1 << (levels_ - 1 - level);
    first_row_.push_back(rows_.size());
    for (int y = 0; y < height; y += spacing) {
      // Rows of the previous lattice already have every other pixel.
      const bool is_old = level > 0 && y % (2 * spacing) == 0;
      Row row{.y = y, .x = is_old ? spacing : 0, .log2_step = levels_ - 1 - level + is_old};
      row.pixels = std::max(0, points(width - row.x, row.step()));
      row.begin = slices;
      slices += points(row.pixels, kMaxPixelsOfSlice);
      row.end = slices;
      rows_.push_back(row);
    }
  }
}

PixelSlices::Run PixelSlices::at(size_t slice) const {
  const auto row = std::upper_bound(rows_.begin(), rows_.end(), slice,
                                    [](size_t s, const Row& r) { return s < r.end; });
  const int first = static_cast<int>(slice - row->begin) * kMaxPixelsOfSlice;
  return {.x = crop_.x0 + row->x + first * row->step(),
          .y = crop_.y0 + row->y,
          .step = row->step(),
          .count = std::min(kMaxPixelsOfSlice, row->pixels - first)};
}

size_t PixelSlices::slice_of(int x, int y) const {
  x -= crop_.x0;
  y -= crop_.y0;
  // The first lattice with the pixel is the widest one whose spacing divides both coordinates.
  const int zeros = std::countr_zero(static_cast<unsigned>(x | y | 1 << (levels_ - 1)));
  const int level = levels_ - 1 - zeros;
  const Row& row = rows_[row_of(level, y)];
  return row.begin + ((x - row.x) >> row.log2_step) / kMaxPixelsOfSlice;
}

int64_t PixelSlices::first_pixels() const {
  int64_t pixels = 0;
  for (const Row& row : rows_) {
    if (row.end > count_of_levels(1)) break;
    pixels += row.pixels;
  }
  return pixels;
}

size_t PixelSlices::count_of_levels(int levels) const {
  return levels < levels_ ? rows_[first_row_[levels]].begin : count();
}

}  // namespace nephroid
