// Sampling of windows of a grid, see windowed_distribution.h.
#include "scene/light/windowed_distribution.h"

#include <algorithm>

namespace nephroid {

namespace {

struct Position {
  double x = 0;
  int cell = 0;
};

/// The position in [x0, x1] (in cells) where a distribution that is linear within each cell reaches
/// `target`; `upto(x)` is its integral from x0 to x. Bisection over cell borders.
template <class Integral>
std::optional<Position> invert(const Integral& upto, double target, double x0, double x1,
                               int cells) {
  int low = std::min(static_cast<int>(x0), cells - 1);
  int high = std::min(static_cast<int>(x1), cells - 1);
  // The cell lies in low..high.
  while (low < high) {
    const int middle = (low + high + 1) / 2;
    if (upto(middle) <= target)
      low = middle;
    else
      high = middle - 1;
  }
  const double begin = std::max(x0, static_cast<double>(low));
  const double end = std::min(x1, static_cast<double>(low + 1));
  const double below = upto(begin), width = upto(end) - below;
  if (!(width > 0.0)) return std::nullopt;
  const double t = std::clamp((target - below) / width, 0.0, 1.0);
  return Position{begin + t * (end - begin), low};
}

}  // namespace

WindowedDistribution::WindowedDistribution(std::vector<float> weights, int width, int height)
    : width_(width), height_(height), weights_(std::move(weights)) {
  sums_.assign((static_cast<size_t>(width) + 1) * (height + 1), 0.0);
  for (int y = 0; y < height_; ++y) {
    double row = 0.0;
    for (int x = 0; x < width_; ++x) {
      row += weights_[static_cast<size_t>(y) * width_ + x];
      sums_[(static_cast<size_t>(y) + 1) * (width_ + 1) + x + 1] = corner(x + 1, y) + row;
    }
  }
}

double WindowedDistribution::cumulated(double x, double y) const {
  const int cx = std::min(static_cast<int>(x), width_ - 1);
  const int cy = std::min(static_cast<int>(y), height_ - 1);
  const double fx = x - cx, fy = y - cy;
  return (1.0 - fy) * ((1.0 - fx) * corner(cx, cy) + fx * corner(cx + 1, cy)) +
         fy * ((1.0 - fx) * corner(cx, cy + 1) + fx * corner(cx + 1, cy + 1));
}

double WindowedDistribution::mass(double x0, double y0, double x1, double y1) const {
  return std::max(
      0.0, (cumulated(x1, y1) - cumulated(x0, y1)) - (cumulated(x1, y0) - cumulated(x0, y0)));
}

double WindowedDistribution::integral(const Window& w) const {
  return mass(w.x0 * width_, w.y0 * height_, w.x1 * width_, w.y1 * height_) /
         (static_cast<double>(width_) * height_);
}

double WindowedDistribution::pdf(int column, int row, const Window& window) const {
  const double total = integral(window);
  return total > 0.0 ? weights_[static_cast<size_t>(row) * width_ + column] / total : 0.0;
}

std::optional<WindowedDistribution::Sample> WindowedDistribution::sample(
    const Vec2f& u, const Window& window) const {
  const double x0 = window.x0 * width_, x1 = window.x1 * width_;
  const double y0 = window.y0 * height_, y1 = window.y1 * height_;
  const double total = mass(x0, y0, x1, y1);
  if (!(total > 0.0)) return std::nullopt;
  const auto up_to_x = [&](double x) { return mass(x0, y0, x, y1); };
  const auto x = invert(up_to_x, u.x * total, x0, x1, width_);
  if (!x) return std::nullopt;
  // Within a column of cells the distribution over y is the same everywhere.
  const auto up_to_y = [&](double y) { return mass(x->cell, y0, x->cell + 1.0, y); };
  const auto y = invert(up_to_y, u.y * up_to_y(y1), y0, y1, height_);
  if (!y) return std::nullopt;
  Sample s;
  s.x = x->x / width_;
  s.y = y->x / height_;
  s.column = x->cell;
  s.row = y->cell;
  s.pdf = pdf(s.column, s.row, window);
  if (!(s.pdf > 0.0)) return std::nullopt;
  return s;
}

}  // namespace nephroid
