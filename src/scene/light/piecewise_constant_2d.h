// A density on the unit square that is constant in each cell of a grid, sampled row first. It must
// not know images.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/math.h"

namespace nephroid {

class PiecewiseConstant2D {
 public:
  struct Sample {
    Vec2f point;  ///< in [0,1]^2, inside the cell
    int x = 0, y = 0;
    float pdf = 0;  ///< per unit area of the square
  };

  PiecewiseConstant2D() = default;
  /// `weights` are non-negative, row by row. If their mean is below the smallest normal float, they
  /// count as zero.
  PiecewiseConstant2D(std::vector<float> weights, int width, int height);

  /// Empty if all weights are zero.
  std::optional<Sample> sample(const Vec2f& u) const;
  /// Density in a cell.
  float pdf(int x, int y) const {
    return weights_[static_cast<size_t>(y) * width_ + x] * inverse_mean_;
  }
  /// Mean of the weights.
  double mean() const { return mean_; }

 private:
  int width_ = 0, height_ = 0;
  std::vector<float> weights_;
  std::vector<float> rows_;   ///< cumulative distribution of the rows, upper ends
  std::vector<float> cells_;  ///< cumulative distributions within the rows, upper ends
  std::vector<uint32_t> row_guide_, cell_guide_;  ///< start of the search for each u
  double mean_ = 0.0;
  float inverse_mean_ = 0.0f;
};

}  // namespace nephroid
