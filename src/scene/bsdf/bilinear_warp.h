// Bilinear functions on the unit square, given at the nodes of a regular grid: their values, and
// maps that distribute uniform points in proportion to them (a marginal over rows, then a
// conditional over columns). A family of grids stands for a function of further parameters: what
// lies between them is a weighted mean, of values, densities and distribution functions alike.
// Who calls it: measured.cpp. It must not know what the square stands for.
// Paper: Dupuy & Jakob 2018.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/math.h"

namespace nephroid {

/// Grids of one size: values[(grid * height + y) * width + x] belongs to the point
/// (x / (width - 1), y / (height - 1)). Width and height are at least 2.
struct GridFamily {
  size_t width = 0, height = 0;
  std::vector<float> values;

  size_t grid_size() const { return width * height; }
  size_t grids() const { return values.size() / grid_size(); }
};

/// A weighted mean of up to four grids of a family; the weights sum to 1.
struct GridMix {
  std::array<size_t, 4> grid{};
  std::array<float, 4> weight{};
  int count = 0;

  void add(size_t index, float w) {
    if (!(w > 0.0f)) return;
    grid[count] = index;
    weight[count] = w;
    ++count;
  }
};

/// A point of the square as a cell of the grid and a place in it.
struct GridCell {
  size_t x = 0, y = 0;  ///< of the lower corner
  float s = 0, t = 0;   ///< in [0,1] along x and y

  GridCell(const GridFamily& family, const Vec2f& p);
};

/// Sorted numbers between which a parameter is interpolated; beyond both ends the end counts.
class ParameterAxis {
 public:
  struct Place {
    size_t lower = 0, upper = 0;  ///< the same at an end
    float t = 0;                  ///< share of the upper one, in [0,1)
  };

  ParameterAxis() = default;
  /// At least one value, strictly increasing.
  explicit ParameterAxis(std::vector<float> values) : values_(std::move(values)) {}
  size_t size() const { return values_.size(); }
  float front() const { return values_.front(); }
  float back() const { return values_.back(); }
  Place find(float value) const;

 private:
  std::vector<float> values_;
};

/// Values of a single grid.
class BilinearFunction {
 public:
  BilinearFunction() = default;
  explicit BilinearFunction(GridFamily grid) : grid_(std::move(grid)) {}
  /// Value at a point of the unit square.
  float operator()(const Vec2f& p) const;

 private:
  GridFamily grid_;
};

/// Densities on the unit square, one a grid, and the maps from uniform points to them.
class BilinearWarp {
 public:
  struct Point {
    Vec2f p{0, 0};
    float density = 0;  ///< at the warped point, per area of the unit square
  };

  BilinearWarp() = default;
  /// Each grid is scaled to the integral 1. Negative values count as 0; a grid of zeros stands for
  /// the uniform density.
  explicit BilinearWarp(GridFamily family);

  /// The point of the density that belongs to the uniform point u in [0,1]^2.
  Point sample(const Vec2f& u, const GridMix& mix) const;
  /// The inverse: the uniform point that sample() takes to p, with the density at p.
  Point invert(const Vec2f& p, const GridMix& mix) const;
  /// The density at p alone.
  float density(const Vec2f& p, const GridMix& mix) const;

 private:
  /// Weighted mean over the grids of entry `index` of tables that have `stride` entries a grid.
  static float mixed(const std::vector<float>& table, size_t stride, size_t index,
                     const GridMix& mix);
  void add_grid(const float* values);

  GridFamily density_;
  std::vector<float> row_integral_;  ///< of the density along a row, up to each node
  std::vector<float> marginal_;      ///< integral of whole rows over y, up to each row
};

}  // namespace nephroid
