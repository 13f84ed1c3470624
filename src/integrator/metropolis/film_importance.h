// The importance of film places for Markov chains, from a coarse picture of the film's brightness:
// chains visit dark places as often as bright ones. Any importance gives the same mean with another
// noise. It must not know paths. Paper: Hoberock & Hart 2010; [Z6] in docs/estimators.md.
#pragma once

#include <span>
#include <vector>

#include "core/math.h"
#include "film/film.h"
#include "scene/pixel_filter.h"

namespace nephroid {

/// The film places that contribute to the crop: the crop, extended by the filter's radius.
class FilmArea {
 public:
  FilmArea(const PixelBounds& crop, const PixelFilter& filter);
  /// Maps [0,1)^2 evenly to the area.
  Vec2f place(const Vec2f& u) const { return low_ + Vec2f(u.x * size_.x, u.y * size_.y); }
  /// The inverse of place(); outside of [0,1)^2 beyond the area.
  Vec2f unit(const Vec2f& place) const {
    return {(place.x - low_.x) / size_.x, (place.y - low_.y) / size_.y};
  }
  /// Width and height in pixels.
  Vec2f size() const { return size_; }
  /// Area in pixels.
  float area() const { return size_.x * size_.y; }
  static void members(auto& self, auto& archive) { archive(self.low_, self.size_); }
  /// True if the place is finite and the size at least one pixel.
  bool is_sound() const;

 private:
  friend class FilmImportance;
  FilmArea() = default;
  Vec2f low_{0, 0}, size_{0, 0};
};

class FilmImportance {
 public:
  /// A value to be read into.
  FilmImportance() = default;
  /// Importance 1 everywhere.
  explicit FilmImportance(const FilmArea& area);

  /// Adds brightness that a path found at a place.
  void record(const Vec2f& film, double brightness);
  /// [Z6] Computes the importance from the records: about 1 over the brightness around a place.
  void learn();
  /// The importance of a place; positive.
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
  int width_ = 1, height_ = 1;  ///< size in cells
  std::vector<double> found_, importance_;
};

}  // namespace nephroid
