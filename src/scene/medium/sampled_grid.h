// Samples on a regular grid over the unit cube, with trilinear interpolation: sample (x, y, z) of n
// lies at ((x, y, z) + 1/2) / n. Beyond the outermost samples values fall to 0, as in pbrt-v4's
// SampledGrid. Also the majorant grid for MajorantIterator. It must not know what the samples mean.
#pragma once

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/math.h"

namespace nephroid {

template <class T>
class SampledGrid {
 public:
  /// `values` holds resolution[0] * resolution[1] * resolution[2] samples, x running fastest.
  SampledGrid(std::vector<T> values, const std::array<int, 3>& resolution)
      : values_(std::move(values)), n_(resolution) {}

  const std::vector<T>& values() const { return values_; }

  /// The interpolated value at a point of the cube. `convert` maps a sample to the interpolated
  /// type, which needs + and * float and a default of zero.
  template <class F>
  auto lookup(const Vec3f& p, F&& convert) const {
    using Value = decltype(convert(values_[0]));
    Value sum{};
    int first[3];
    float t[3];
    for (int i = 0; i < 3; ++i) {
      // Also fails for NaN, and before values leave the range of int.
      if (!(p[i] > -1.0f && p[i] < 2.0f)) return sum;
      const float s = p[i] * static_cast<float>(n_[i]) - 0.5f;
      const float floor = std::floor(s);
      first[i] = static_cast<int>(floor);
      t[i] = s - floor;
    }
    for (int corner = 0; corner < 8; ++corner) {
      const int bit[3] = {corner & 1, (corner >> 1) & 1, corner >> 2};
      float weight = 1.0f;
      bool inside = true;
      for (int i = 0; i < 3; ++i) {
        weight *= bit[i] ? t[i] : 1.0f - t[i];
        inside &= first[i] + bit[i] >= 0 && first[i] + bit[i] < n_[i];
      }
      if (inside && weight > 0.0f)
        sum =
            sum + convert(value(first[0] + bit[0], first[1] + bit[1], first[2] + bit[2])) * weight;
    }
    return sum;
  }

  /// An upper bound of the interpolated values over the box [lo, hi] of the cube. `measure` maps
  /// samples to non-negative numbers.
  template <class F>
  float max_value(const Vec3f& lo, const Vec3f& hi, F&& measure) const {
    int a[3], b[3];
    for (int i = 0; i < 3; ++i) {
      const float n = static_cast<float>(n_[i]);
      a[i] = std::max(static_cast<int>(std::floor(lo[i] * n - 0.5f)), 0);
      b[i] = std::min(static_cast<int>(std::floor(hi[i] * n - 0.5f)) + 1, n_[i] - 1);
    }
    float most = 0.0f;
    for (int z = a[2]; z <= b[2]; ++z)
      for (int y = a[1]; y <= b[1]; ++y)
        for (int x = a[0]; x <= b[0]; ++x) most = std::max(most, float(measure(value(x, y, z))));
    return most;
  }

 private:
  const T& value(int x, int y, int z) const {
    return values_[x + static_cast<size_t>(n_[0]) * (y + static_cast<size_t>(n_[1]) * z)];
  }

  std::vector<T> values_;
  std::array<int, 3> n_;
};

/// Upper bounds of a quantity in the cells of a grid over the unit cube.
struct MajorantGrid {
  std::array<int, 3> resolution{};
  std::vector<float> scales;  ///< cell (x, y, z) at x + nx (y + ny z)

  /// `bound(lo, hi)` returns the maximum of the quantity over a box of the cube. Boxes are slightly
  /// larger than the cells, so that the rounded points of a ray lie inside.
  template <class F>
  static MajorantGrid over_cells(const std::array<int, 3>& resolution, F&& bound) {
    // Enough for rays from a few hundred box widths away.
    constexpr float kMargin = 1e-4f;
    // By rounding, interpolation and colour polynomials can exceed the largest sample.
    constexpr float kRounding = 1.00001f;
    MajorantGrid grid{resolution, {}};
    for (int z = 0; z < resolution[2]; ++z)
      for (int y = 0; y < resolution[1]; ++y)
        for (int x = 0; x < resolution[0]; ++x) {
          const Vec3f n(static_cast<float>(resolution[0]), static_cast<float>(resolution[1]),
                        static_cast<float>(resolution[2]));
          const Vec3f cell(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z));
          const Vec3f margin(kMargin, kMargin, kMargin);
          grid.scales.push_back(bound(cell / n - margin, (cell + Vec3f(1, 1, 1)) / n + margin) *
                                kRounding);
        }
    return grid;
  }
};

}  // namespace nephroid
