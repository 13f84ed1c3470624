// Camera splats of a pass, as light tracing makes them. Each splat exposes all pixels whose filter
// reaches it; a pixel's sum over a pass is one estimate ([F4] in docs/estimators.md). Sums are
// exact, so threads and batches do not change the result. It must not know cameras or routes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "film/film.h"
#include "film/lamp_light.h"
#include "scene/pixel_filter.h"

namespace nephroid {

/// One contribution. `film` is in pixels, y down, from the corner of the full picture, and may lie
/// outside of it.
struct Splat {
  Vec2f film{0, 0};
  uint8_t part = 0;  ///< index into parts_of(group), not a part of the film's layout
  Rgb value;
  Lamp lamp = 0;
};

/// The sums of one group's splats in one pass.
class SplatBuffer {
 public:
  /// Keeps references to film and filter. Takes bytes_per_pixel for each pixel of the crop.
  SplatBuffer(Film& film, int group, const PixelFilter& filter);

  /// Adds every splat to the pixels around it, times the filter normalised by its integral, so the
  /// weights add up to 1 on average. The order and number of calls do not change the sums. A splat
  /// with a value that is not finite, or at NaN, is left out and counted as invalid at the end of
  /// the pass. A splat outside of every pixel's filter is ignored.
  void add(std::span<const Splat> splats);

  /// Ends the pass: adds one estimate of the group per pixel to the film and empties the buffer. An
  /// estimate is the sum times `scale`, 1 over the number of light paths, plus another technique's
  /// light `also` ([pixel of the crop * parts + part], or empty). Its total over the parts is
  /// clamped to the film's max_component. The caller adds 1 to the film's number of estimates.
  void finish(double scale, std::span<const Rgb> also = {});

  static constexpr size_t bytes_per_pixel(size_t parts) { return parts * sizeof(Sum); }

 private:
  struct Sum {
    FixedSum rgb[3];
  };
  /// Pixels inside the crop whose filter reaches a splat; may be empty.
  PixelBounds reached_by(const Vec2f& film) const;
  /// Indices of the splats that reach each strip of rows, in order.
  std::vector<std::vector<uint32_t>> splats_by_strip(std::span<const Splat> splats);
  void add_batch(std::span<const Splat> splats);
  /// Adds a splat to the rows [y0, y1) of the film. Returns the number of saturated sums.
  uint64_t add_to_rows(const Splat& splat, int y0, int y1);

  Film& film_;
  int group_;
  const PixelFilter& filter_;
  size_t parts_;
  std::vector<Sum> sums_;  ///< [pixel][part]
  struct BadSplat {
    uint8_t part = 0;
    Vec2i pixel;
  };
  std::vector<BadSplat> bad_;  ///< kept back until the pass ends: the film has whole passes only
  uint64_t saturated_ = 0;
};

}  // namespace nephroid
