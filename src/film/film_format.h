// The format of a film without its sums: size, crop, colours, and the parts of its light. It must
// not know scenes or estimators.
#pragma once

#include <compare>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/color.h"
#include "core/math.h"

namespace nephroid {

/// Half-open pixel rectangle.
struct PixelBounds {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  int width() const { return x1 - x0; }
  int height() const { return y1 - y0; }
  int64_t area() const { return int64_t{width()} * height(); }
  bool operator==(const PixelBounds&) const = default;
};

/// Settings of a film, taken from the scene's Film directive and the command line.
struct FilmSettings {
  int width = 1280, height = 720;   ///< full resolution
  PixelBounds crop;                 ///< rendered part, inside the resolution; empty: all of it
  float imaging_ratio = 1;          ///< exposure time * ISO / 100
  float max_component = kInfinity;  ///< samples are scaled down to this in their largest component
  const RgbColorSpace* color_space = nullptr;
  std::string filename;  ///< the scene's name for its output
  float diagonal_mm = 35;
  std::optional<ColorMatrix> white_balance;  ///< applied to every sample
  bool gbuffer = false;                      ///< with geometric layers, see SurfaceSample
};

/// The parts of a film. Each part of the light belongs to one route and any number of AOVs. The
/// routes that one estimator samples together are a group, with one count of estimates and one
/// variance.
struct FilmLayout {
  struct Part {
    int route = 0;
    std::vector<int> aovs;
  };
  std::vector<std::string> routes, aovs;  ///< names of layers
  std::vector<Part> parts;
  std::vector<int> groups;   ///< [route]: its group, numbered from 0 without a gap
  std::vector<bool> merges;  ///< [group]: true if it estimates its bias; false past the end
  /// False if a group replaces its estimates, so that the picture's variance is unknown.
  bool has_error = true;

  /// One part and one group for each route, no AOVs.
  static FilmLayout of_routes(std::vector<std::string> names);
  int group_count() const;
  int group_of(const Part& part) const { return groups[part.route]; }
  /// The groups that have light in an AOV, ordered by group and AOV, each pair once.
  struct GroupLayer {
    int group = 0, aov = 0;
    auto operator<=>(const GroupLayer&) const = default;
  };
  std::vector<GroupLayer> layers_of_groups() const;
  bool group_merges(int group) const {
    return static_cast<size_t>(group) < merges.size() && merges[group];
  }
};

/// Settings and layout: the part of a film that an estimator needs for learning.
class FilmFormat {
 public:
  /// An empty crop becomes the whole picture.
  FilmFormat(const FilmSettings& settings, FilmLayout layout);

  const FilmSettings& settings() const { return settings_; }
  const PixelBounds& bounds() const { return settings_.crop; }
  /// Pixels of the uncropped picture.
  int64_t picture_pixels() const { return int64_t{settings_.width} * settings_.height; }
  const FilmLayout& layout() const { return layout_; }
  /// Parts of a group's routes, in increasing order.
  const std::vector<int>& parts_of(int group) const { return parts_of_group_[group]; }

 private:
  FilmSettings settings_;
  FilmLayout layout_;
  std::vector<std::vector<int>> parts_of_group_;
};

}  // namespace nephroid
