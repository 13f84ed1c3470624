// The order of a crop's pixels in a pass, coarse to fine: first a wide lattice, then lattices of
// half the spacing, until all pixels are reached. A slice is a run of pixels in one row, rendered
// by one thread. It must not know what is rendered.
#pragma once

#include <cstddef>
#include <vector>

#include "film/film_format.h"

namespace nephroid {

class PixelSlices {
 public:
  /// Largest number of pixels in the first lattice.
  static constexpr int kMaxFirstPixels = 16384;
  static constexpr int kMaxPixelsOfSlice = 256;

  explicit PixelSlices(const PixelBounds& crop);

  size_t count() const { return rows_.empty() ? 0 : rows_.back().end; }

  /// Pixels x, x + step, ... of row y, `count` of them; full-resolution coordinates.
  struct Run {
    int x = 0, y = 0, step = 1, count = 0;
  };
  Run at(size_t slice) const;
  /// The slice of a pixel of the crop.
  size_t slice_of(int x, int y) const;
  /// Number of slices in the first `levels` lattices; `levels` is at least 1.
  size_t count_of_levels(int levels) const;
  int levels() const { return levels_; }
  /// Number of pixels in the first lattice.
  int64_t first_pixels() const;
  /// Spacing of the lattice after the first `levels` are done.
  int spacing(int levels) const { return 1 << (levels_ - levels); }

 private:
  /// The slices of a row that belong to one level.
  struct Row {
    int y = 0, x = 0;  ///< offset from the crop's corner
    int log2_step = 0, pixels = 0;
    size_t begin = 0, end = 0;  ///< range of slices
    int step() const { return 1 << log2_step; }
  };
  size_t row_of(int level, int y) const { return first_row_[level] + (y >> (levels_ - 1 - level)); }

  PixelBounds crop_;
  int levels_ = 1;
  std::vector<Row> rows_;
  std::vector<size_t> first_row_;  ///< [level]: index into rows_
};

}  // namespace nephroid
