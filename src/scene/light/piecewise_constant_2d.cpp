// Sampling of a grid of densities, see piecewise_constant_2d.h.
#include "scene/light/piecewise_constant_2d.h"

#include <algorithm>

namespace nephroid {

namespace {

/// Normalised running sums of `values`; returns the total.
template <class In>
double cumulate(const In* values, int n, float* out) {
  double total = 0.0;
  for (int i = 0; i < n; ++i) total += values[i];
  double sum = 0.0;
  for (int i = 0; i < n; ++i) {
    sum += values[i];
    out[i] = total > 0.0 ? static_cast<float>(sum / total) : 0.0f;
  }
  return total;
}

/// The interval of a cumulative distribution that holds u, never an empty one; u becomes the
/// position in it.
int find_interval(const float* upper, int n, float& u) {
  const int i = static_cast<int>(std::upper_bound(upper, upper + n, u) - upper);
  // u is below 1, and the last upper end is 1: only rounding could lead out.
  const int k = std::min(i, n - 1);
  const float lower = k > 0 ? upper[k - 1] : 0.0f;
  u = std::clamp((u - lower) / (upper[k] - lower), 0.0f, kOneMinusEpsilon);
  return k;
}

}  // namespace

PiecewiseConstant2D::PiecewiseConstant2D(std::vector<float> weights, int width, int height)
    : width_(width), height_(height), weights_(std::move(weights)) {
  rows_.resize(height_);
  cells_.resize(weights_.size());
  std::vector<double> row_sums(height_);
  for (int y = 0; y < height_; ++y) {
    const size_t first = static_cast<size_t>(y) * width_;
    row_sums[y] = cumulate(&weights_[first], width_, &cells_[first]);
  }
  const double total = cumulate(row_sums.data(), height_, rows_.data());
  mean_ = total / (static_cast<double>(width_) * height_);
  inverse_mean_ = mean_ > 0.0 ? static_cast<float>(1.0 / mean_) : 0.0f;
}

std::optional<PiecewiseConstant2D::Sample> PiecewiseConstant2D::sample(const Vec2f& u) const {
  if (!(mean_ > 0.0)) return std::nullopt;
  Sample s;
  Vec2f r = u;
  s.y = find_interval(rows_.data(), height_, r.y);
  s.x = find_interval(&cells_[static_cast<size_t>(s.y) * width_], width_, r.x);
  s.point = {(static_cast<float>(s.x) + r.x) / static_cast<float>(width_),
             (static_cast<float>(s.y) + r.y) / static_cast<float>(height_)};
  s.pdf = pdf(s.x, s.y);
  if (!(s.pdf > 0.0f)) return std::nullopt;
  return s;
}

}  // namespace nephroid
