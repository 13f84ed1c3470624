// Bilinear functions on the unit square, given at the nodes of a regular grid: their values, and
// warps that sample points in proportion to them (row marginal, then column conditional). Grids of
// a family are interpolated: values, densities and distribution functions alike are weighted means.
// It must not know what the square stands for. Paper: Dupuy & Jakob 2018.
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

/// A point of the square as a grid cell and a position in the cell.
struct GridCell {
  size_t x = 0, y = 0;  ///< grid indices of the cell's lower corner
  float s = 0, t = 0;   ///< position in the cell along x and y, in [0,1]

  GridCell(const GridFamily& family, const Vec2f& p);
};

/// Sorted nodes between which a parameter is interpolated, clamped to the first and the last.
class ParameterAxis {
 public:
  struct Place {
    size_t lower = 0, upper = 0;  ///< neighbouring nodes, equal if clamped
    float t = 0;                  ///< weight of the upper node, in [0,1)
  };

  ParameterAxis() = default;
  /// `values`: at least one, strictly increasing.
  explicit ParameterAxis(std::vector<float> values) : values_(std::move(values)) {}
  size_t size() const { return values_.size(); }
  float front() const { return values_.front(); }
  float back() const { return values_.back(); }
  Place find(float value) const;

 private:
  std::vector<float> values_;
};

/// The bilinear function of a single grid.
class BilinearFunction {
 public:
  BilinearFunction() = default;
  explicit BilinearFunction(GridFamily grid) : grid_(std::move(grid)) {}
  /// Value at a point of the unit square.
  float operator()(const Vec2f& p) const;

 private:
  GridFamily grid_;
};

/// Densities on the unit square, one per grid, and the warps from uniform points to them.
class BilinearWarp {
 public:
  struct Point {
    Vec2f p{0, 0};
    float density = 0;  ///< at the warped point, per area of the unit square
  };

  BilinearWarp() = default;
  /// Each grid is normalised to integrate to 1. Negative values count as 0. A grid of zeros becomes
  /// the uniform density.
  explicit BilinearWarp(GridFamily family);

  /// Warps the uniform point u in [0,1]^2 to the density.
  Point sample(const Vec2f& u, const GridMix& mix) const;
  /// Inverse of sample(): the uniform point that it warps to p, with the density at p.
  Point invert(const Vec2f& p, const GridMix& mix) const;
  /// The density at p.
  float density(const Vec2f& p, const GridMix& mix) const;

 private:
  /// Weighted mean over the grids of entry `index` in tables with `stride` entries per grid.
  static float mixed(const std::vector<float>& table, size_t stride, size_t index,
                     const GridMix& mix);
  void add_grid(const float* values);

  GridFamily density_;
  std::vector<float> row_integral_;  ///< running integral along a row, up to each node
  std::vector<float> marginal_;      ///< running integral of whole rows over y, up to each row
};

}  // namespace nephroid
