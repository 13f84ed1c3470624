#include "integrator/metropolis/film_importance.h"

#include <algorithm>
#include <cmath>

namespace nephroid {

namespace {

constexpr int kMaxCells = 16;        ///< largest number of cells along the longer side
constexpr float kPixelsPerCell = 4;  ///< smallest side of a cell in pixels
/// Offset in [Z6], as a share of the mean brightness; limits the importance of dark cells.
constexpr double kDarkest = 0.05;

}  // namespace

FilmArea::FilmArea(const PixelBounds& crop, const PixelFilter& filter)
    : low_(Vec2f(static_cast<float>(crop.x0), static_cast<float>(crop.y0)) - filter.radius()),
      size_(Vec2f(static_cast<float>(crop.width()), static_cast<float>(crop.height())) +
            filter.radius() * 2.0f) {}

bool FilmArea::is_sound() const {
  return std::isfinite(low_.x) && std::isfinite(low_.y) && size_.x >= 1 && size_.y >= 1 &&
         std::isfinite(size_.x) && std::isfinite(size_.y);
}

FilmImportance::FilmImportance(const FilmArea& area) : area_(area) {
  const Vec2f size = area.size();
  const float side = std::max(std::max(size.x, size.y) / kMaxCells, kPixelsPerCell);
  width_ = std::max(1, static_cast<int>(size.x / side));
  height_ = std::max(1, static_cast<int>(size.y / side));
  found_.assign(static_cast<size_t>(width_) * height_, 0.0);
  importance_.assign(found_.size(), 1.0);
}

void FilmImportance::record(const Vec2f& film, double brightness) {
  const Vec2f u = area_.unit(film);
  const auto index = [](float at, int cells) {
    return std::clamp(static_cast<int>(at * static_cast<float>(cells)), 0, cells - 1);
  };
  cell(found_, index(u.x, width_), index(u.y, height_)) += brightness;
}

void FilmImportance::learn() {
  double mean = 0;
  for (const double b : found_) mean += b / static_cast<double>(found_.size());
  if (!(mean > 0) || !std::isfinite(mean)) return;
  // Smooth each cell with its neighbours, since few paths were recorded.
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x) {
      double sum = 0, weights = 0;
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
          if (x + dx < 0 || x + dx >= width_ || y + dy < 0 || y + dy >= height_) continue;
          const double weight = (dx == 0 ? 2 : 1) * (dy == 0 ? 2 : 1);
          sum += weight * cell(found_, x + dx, y + dy);
          weights += weight;
        }
      cell(importance_, x, y) = 1 / (sum / weights / mean + kDarkest);
    }
}

bool FilmImportance::is_sound() const {
  const FilmImportance empty(area_);
  return width_ == empty.width_ && height_ == empty.height_ &&
         found_.size() == empty.found_.size() && importance_.size() == found_.size() &&
         std::ranges::all_of(found_, [](double x) { return std::isfinite(x); }) &&
         std::ranges::all_of(importance_, [](double x) { return x > 0 && x <= 1 / kDarkest; });
}

float FilmImportance::at(const Vec2f& film) const {
  const Vec2f u = area_.unit(film);
  const auto around = [](float at, int cells, int& low, int& high) {
    const float x =
        std::clamp(at * static_cast<float>(cells) - 0.5f, 0.0f, static_cast<float>(cells - 1));
    low = static_cast<int>(x);
    high = std::min(low + 1, cells - 1);
    return double{x} - low;
  };
  int x0, x1, y0, y1;
  const double fx = around(u.x, width_, x0, x1), fy = around(u.y, height_, y0, y1);
  const auto value = [&](int x, int y) { return importance_[static_cast<size_t>(y) * width_ + x]; };
  return static_cast<float>((1 - fy) * ((1 - fx) * value(x0, y0) + fx * value(x1, y0)) +
                            fy * ((1 - fx) * value(x0, y1) + fx * value(x1, y1)));
}

}  // namespace nephroid
