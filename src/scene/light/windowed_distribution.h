// A density on the unit square that is constant in each cell of a grid, sampled within any window
// of the square by a summed-area table. It must not know images or directions. Papers: Crow 1984;
// Bitterli, Novak & Jarosz 2015, Portal-Masked Environment Map Sampling.
#pragma once

#include <optional>
#include <vector>

#include "core/math.h"

namespace nephroid {

class WindowedDistribution {
 public:
  /// A part of the unit square, x0 <= x1 and y0 <= y1, all in [0,1].
  struct Window {
    double x0 = 0, y0 = 0, x1 = 1, y1 = 1;
  };
  struct Sample {
    double x = 0, y = 0;      ///< position in the window
    int column = 0, row = 0;  ///< cell that holds the position
    double pdf = 0;           ///< per unit area of the square
  };

  WindowedDistribution() = default;
  /// `weights` are finite and non-negative, row by row.
  WindowedDistribution(std::vector<float> weights, int width, int height);

  /// Samples a point of the window in proportion to the weights. Empty if all of them are zero.
  std::optional<Sample> sample(const Vec2f& u, const Window& window) const;
  /// Density of sample() at a point of the window in this cell; zero if it cannot be sampled.
  double pdf(int column, int row, const Window& window) const;
  /// Integral of the weights over a window.
  double integral(const Window& window) const;

 private:
  /// Sum of the weights of all cells above and to the left of a corner of the grid.
  double corner(int x, int y) const { return sums_[static_cast<size_t>(y) * (width_ + 1) + x]; }
  /// Integral over [0,x] x [0,y], in cells.
  double cumulated(double x, double y) const;
  /// Integral over a window in cells.
  double mass(double x0, double y0, double x1, double y1) const;

  int width_ = 0, height_ = 0;
  std::vector<float> weights_;
  std::vector<double> sums_;
};

}  // namespace nephroid
