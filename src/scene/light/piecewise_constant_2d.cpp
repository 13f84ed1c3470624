// Sampling of a grid of densities, see piecewise_constant_2d.h.
#include "scene/light/piecewise_constant_2d.h"

#include <algorithm>
#include <limits>

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

/// For each of n equal steps of [0,1): the first interval that overlaps it, where a search starts.
void make_guide(const float* upper, int n, uint32_t* guide) {
  int i = 0;
  for (int k = 0; k < n; ++k) {
    const float begin = static_cast<float>(k) / static_cast<float>(n);
    while (i < n - 1 && upper[i] <= begin) ++i;
    guide[k] = i;
  }
}

/// The non-empty interval of a cumulative distribution that holds u. u becomes the position in it.
/// The guide leaves one search step on average.
int find_interval(const float* upper, const uint32_t* guide, int n, float& u) {
  const int k = std::min(static_cast<int>(u * static_cast<float>(n)), n - 1);
  int i = guide[k];
  while (i < n - 1 && upper[i] <= u) ++i;
  const float lower = i > 0 ? upper[i - 1] : 0.0f;
  u = std::clamp((u - lower) / (upper[i] - lower), 0.0f, kOneMinusEpsilon);
  return i;
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
  row_guide_.resize(height_);
  make_guide(rows_.data(), height_, row_guide_.data());
  cell_guide_.resize(cells_.size());
  for (int y = 0; y < height_; ++y) {
    const size_t first = static_cast<size_t>(y) * width_;
    make_guide(&cells_[first], width_, &cell_guide_[first]);
  }
  mean_ = total / (static_cast<double>(width_) * height_);
  // The inverse of a smaller mean overflows a float.
  if (mean_ < std::numeric_limits<float>::min()) mean_ = 0.0;
  inverse_mean_ = mean_ > 0.0 ? static_cast<float>(1.0 / mean_) : 0.0f;
}

std::optional<PiecewiseConstant2D::Sample> PiecewiseConstant2D::sample(const Vec2f& u) const {
  if (!(mean_ > 0.0)) return std::nullopt;
  Sample s;
  Vec2f r = u;
  s.y = find_interval(rows_.data(), row_guide_.data(), height_, r.y);
  const size_t first = static_cast<size_t>(s.y) * width_;
  s.x = find_interval(&cells_[first], &cell_guide_[first], width_, r.x);
  s.point = {(static_cast<float>(s.x) + r.x) / static_cast<float>(width_),
             (static_cast<float>(s.y) + r.y) / static_cast<float>(height_)};
  s.pdf = pdf(s.x, s.y);
  if (!(s.pdf > 0.0f)) return std::nullopt;
  return s;
}

}  // namespace nephroid
