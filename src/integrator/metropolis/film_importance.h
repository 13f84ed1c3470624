// Where on the film chains should spend their time: a coarse picture of how bright the film is, so
// that they visit what is dark as often as what is bright. Any importance gives the same picture on
// average, with another noise. It must not know paths. Paper: Hoberock & Hart 2010; equation [Z6]
// of docs/estimators.md.
#pragma once

#include <span>
#include <vector>

#include "core/math.h"
#include "film/film.h"
#include "scene/pixel_filter.h"

namespace nephroid {

/// The places from which something of the crop can be seen: the crop, and around it the filter's
/// radius.
class FilmArea {
 public:
  FilmArea(const PixelBounds& crop, const PixelFilter& filter);
  /// Evenly distributed over the area.
  Vec2f place(const Vec2f& u) const { return low_ + Vec2f(u.x * size_.x, u.y * size_.y); }
  /// The inverse of place; outside of [0,1)^2 beyond the area.
  Vec2f unit(const Vec2f& place) const {
    return {(place.x - low_.x) / size_.x, (place.y - low_.y) / size_.y};
  }
  /// Width and height in pixels.
  Vec2f size() const { return size_; }
  /// In pixels.
  float area() const { return size_.x * size_.y; }
  static void members(auto& self, auto& archive) { archive(self.low_, self.size_); }
  /// Has a size to divide by.
  bool is_sound() const;

 private:
  friend class FilmImportance;
  FilmArea() = default;
  Vec2f low_{0, 0}, size_{0, 0};
};

class FilmImportance {
 public:
  /// To be read into.
  FilmImportance() = default;
  /// 1 everywhere.
  explicit FilmImportance(const FilmArea& area);

  /// What a few paths found: adds brightness at a place.
  void record(const Vec2f& film, double brightness);
  /// Makes the importance of what was recorded: about 1 over the brightness around a place.
  void learn();
  /// Positive.
  float at(const Vec2f& film) const;
  static void members(auto& self, auto& archive) {
    archive(self.area_, self.width_, self.height_, self.found_, self.importance_);
  }
  bool is_sound() const;

 private:
  double& cell(std::vector<double>& cells, int x, int y) const {
    return cells[static_cast<size_t>(y) * width_ + x];
  }

  FilmArea area_;
  int width_ = 1, height_ = 1;  ///< cells
  std::vector<double> found_, importance_;
};

}  // namespace nephroid
