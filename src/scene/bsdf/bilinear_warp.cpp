// Interpolation, inversion of distribution functions and its reverse; see bilinear_warp.h.
#include "scene/bsdf/bilinear_warp.h"

namespace nephroid {
namespace {

/// Share s of [0,1] over which a linear function from a to b (at 1) integrates to `area`. Written
/// without the cancellation of the textbook's root.
float invert_linear(float a, float b, float area) {
  const float root = a + safe_sqrt(a * a + 2.0f * area * (b - a));
  return root > 0.0f ? std::clamp(2.0f * area / root, 0.0f, 1.0f) : 0.0f;
}
float integral_of_linear(float a, float b, float s) {
  return s * (a + 0.5f * s * (b - a));
}

/// The last index in [0, size - 2] whose value is below `target`. Values are non-decreasing.
template <class Value>
size_t last_below(size_t size, float target, const Value& value) {
  size_t low = 0, high = size - 1;
  while (high - low > 1) {
    const size_t middle = low + (high - low) / 2;
    (value(middle) < target ? low : high) = middle;
  }
  return low;
}

float axis_place(float p, size_t nodes, size_t* cell) {
  const float at = std::clamp(p, 0.0f, 1.0f) * static_cast<float>(nodes - 1);
  *cell = std::min(static_cast<size_t>(at), nodes - 2);
  return at - static_cast<float>(*cell);
}

}  // namespace

GridCell::GridCell(const GridFamily& family, const Vec2f& p) {
  s = axis_place(p.x, family.width, &x);
  t = axis_place(p.y, family.height, &y);
}

ParameterAxis::Place ParameterAxis::find(float value) const {
  if (!(value > values_.front())) return {};
  if (value >= values_.back()) return {values_.size() - 1, values_.size() - 1, 0.0f};
  const auto above = std::upper_bound(values_.begin(), values_.end(), value);
  const size_t upper = above - values_.begin();
  const float from = values_[upper - 1];
  return {upper - 1, upper, (value - from) / (values_[upper] - from)};
}

float BilinearFunction::operator()(const Vec2f& p) const {
  const GridCell c(grid_, p);
  const float* v = &grid_.values[c.y * grid_.width + c.x];
  return lerp(c.t, lerp(c.s, v[0], v[1]), lerp(c.s, v[grid_.width], v[grid_.width + 1]));
}

BilinearWarp::BilinearWarp(GridFamily family) : density_(std::move(family)) {
  const std::vector<float> given = std::move(density_.values);
  const size_t size = density_.grid_size(), grids = given.size() / size;
  density_.values.clear();
  density_.values.reserve(given.size());
  row_integral_.reserve(given.size());
  marginal_.reserve(grids * density_.height);
  for (size_t g = 0; g < grids; ++g) add_grid(&given[g * size]);
}

void BilinearWarp::add_grid(const float* values) {
  const size_t width = density_.width, height = density_.height;
  // The integral of a bilinear cell is the mean of its corners.
  double total = 0.0;
  for (size_t y = 0; y < height; ++y) {
    const double of_row = y == 0 || y == height - 1 ? 0.5 : 1.0;
    for (size_t x = 0; x < width; ++x)
      total += of_row * (x == 0 || x == width - 1 ? 0.5 : 1.0) *
               std::max(0.0, static_cast<double>(values[y * width + x]));
  }
  const double dx = 1.0 / static_cast<double>(width - 1);
  const double dy = 1.0 / static_cast<double>(height - 1);
  const double scale = total > 0.0 ? 1.0 / (total * dx * dy) : 0.0;
  const auto scaled = [&](size_t i) {
    return total > 0.0 ? std::max(0.0, static_cast<double>(values[i])) * scale : 1.0;
  };

  double below = 0.0, row_before = 0.0;
  for (size_t y = 0; y < height; ++y) {
    double row = 0.0;
    for (size_t x = 0; x < width; ++x) {
      const double d = scaled(y * width + x);
      if (x > 0) row += 0.5 * dx * (scaled(y * width + x - 1) + d);
      density_.values.push_back(static_cast<float>(d));
      row_integral_.push_back(static_cast<float>(row));
    }
    if (y > 0) below += 0.5 * dy * (row_before + row);
    marginal_.push_back(static_cast<float>(below));
    row_before = row;
  }
}

float BilinearWarp::mixed(const std::vector<float>& table, size_t stride, size_t index,
                          const GridMix& mix) {
  float sum = 0.0f;
  for (int k = 0; k < mix.count; ++k) sum += mix.weight[k] * table[mix.grid[k] * stride + index];
  return sum;
}

BilinearWarp::Point BilinearWarp::sample(const Vec2f& u, const GridMix& mix) const {
  const size_t width = density_.width, height = density_.height, size = density_.grid_size();
  const float columns = static_cast<float>(width - 1), rows = static_cast<float>(height - 1);

  // The row, and the position between it and the next.
  const auto marginal = [&](size_t y) { return mixed(marginal_, height, y, mix); };
  const size_t row = last_below(height, u.y, marginal);
  const auto whole_row = [&](size_t y) {
    return mixed(row_integral_, size, (y + 1) * width - 1, mix);
  };
  const float r0 = whole_row(row), r1 = whole_row(row + 1);
  const float t = invert_linear(r0, r1, std::max(0.0f, u.y - marginal(row)) * rows);

  // The column in the interpolation of both rows.
  const auto between_rows = [&](const std::vector<float>& table, size_t x) {
    return lerp(t, mixed(table, size, row * width + x, mix),
                mixed(table, size, (row + 1) * width + x, mix));
  };
  const auto conditional = [&](size_t x) { return between_rows(row_integral_, x); };
  const float target = u.x * lerp(t, r0, r1);
  const size_t column = last_below(width, target, conditional);
  const float c0 = between_rows(density_.values, column);
  const float c1 = between_rows(density_.values, column + 1);
  const float s = invert_linear(c0, c1, std::max(0.0f, target - conditional(column)) * columns);

  Point point;
  point.p = {(static_cast<float>(column) + s) / columns, (static_cast<float>(row) + t) / rows};
  point.density = lerp(s, c0, c1);
  return point;
}

BilinearWarp::Point BilinearWarp::invert(const Vec2f& p, const GridMix& mix) const {
  const size_t width = density_.width, height = density_.height, size = density_.grid_size();
  const float columns = static_cast<float>(width - 1), rows = static_cast<float>(height - 1);
  const GridCell cell(density_, p);
  const size_t row = cell.y * width;
  const auto between_rows = [&](const std::vector<float>& table, size_t x) {
    return lerp(cell.t, mixed(table, size, row + x, mix), mixed(table, size, row + width + x, mix));
  };
  const float c0 = between_rows(density_.values, cell.x);
  const float c1 = between_rows(density_.values, cell.x + 1);
  const float r0 = mixed(row_integral_, size, row + width - 1, mix);
  const float r1 = mixed(row_integral_, size, row + 2 * width - 1, mix);
  const float whole = lerp(cell.t, r0, r1);

  Point point;
  point.density = lerp(cell.s, c0, c1);
  const float x =
      between_rows(row_integral_, cell.x) + integral_of_linear(c0, c1, cell.s) / columns;
  point.p.x = whole > 0.0f ? std::clamp(x / whole, 0.0f, 1.0f) : 0.0f;
  point.p.y =
      std::clamp(mixed(marginal_, height, cell.y, mix) + integral_of_linear(r0, r1, cell.t) / rows,
                 0.0f, 1.0f);
  return point;
}

float BilinearWarp::density(const Vec2f& p, const GridMix& mix) const {
  const GridCell c(density_, p);
  const size_t i = c.y * density_.width + c.x, size = density_.grid_size();
  const auto at = [&](size_t index) { return mixed(density_.values, size, index, mix); };
  return lerp(c.t, lerp(c.s, at(i), at(i + 1)),
              lerp(c.s, at(i + density_.width), at(i + density_.width + 1)));
}

}  // namespace nephroid
