// Light that arrives anywhere on the film during a pass, as light tracing finds it: each splat
// exposes all pixels whose filter reaches it, and what a pixel received in a pass is one estimate.
// Sums are exact, so that neither threads nor the split of a pass into batches can be seen.
// Who calls it: estimators that connect light to the camera. It must not know cameras or routes.
// Equation [F4] of docs/estimators.md.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "film/film.h"
#include "film/lamp_light.h"
#include "scene/pixel_filter.h"

namespace nephroid {

/// One contribution. `film` is in pixels, y down, from the corner of the full resolution, and may
/// lie outside of it.
struct Splat {
  Vec2f film{0, 0};
  uint8_t part = 0;  ///< index into parts_of(group), not a part of the film's layout
  Rgb value;
  Lamp lamp = 0;
};

/// What one group's splats of one pass add up to.
class SplatBuffer {
 public:
  /// Keeps references to film and filter. Memory: bytes_per_pixel for each pixel of the crop.
  SplatBuffer(Film& film, int group, const PixelFilter& filter);

  /// Adds every splat to the pixels around it, times the filter normalised by its integral: over
  /// all pixels the weights add up to 1 on average. Any number of calls, in any order, add up to
  /// the same bits. A splat with a value that is not finite, or at NaN, is left out and, when the
  /// pass ends, counted as one of the film's bad values; one outside of every pixel's filter is not
  /// of this film.
  void add(std::span<const Splat> splats);

  /// Ends the pass: adds to the film, for each pixel, one estimate of the group: the sums times
  /// `scale` (1 over the number of light paths), plus what another technique found in the pass
  /// (`also`: [pixel of the crop * parts + part], or empty), scaled down so that their total over
  /// the parts has no component above the film's max_component. The buffer is then empty, for the
  /// next pass. The caller adds 1 to the film's number of estimates.
  void finish(double scale, std::span<const Rgb> also = {});

  static constexpr size_t bytes_per_pixel(size_t parts) { return parts * sizeof(Sum); }

 private:
  struct Sum {
    FixedSum rgb[3];
  };
  /// Half-open ranges of pixels, inside the crop, whose filter reaches a splat; may be empty.
  PixelBounds reached_by(const Vec2f& film) const;
  /// Numbers of the splats that reach each strip of rows, in order.
  std::vector<std::vector<uint32_t>> splats_by_strip(std::span<const Splat> splats);
  void add_batch(std::span<const Splat> splats);
  /// Adds a splat to the rows [y0, y1) of the film. Returns the number of sums that were held.
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
  std::vector<BadSplat> bad_;  ///< the film knows nothing of a pass that is not whole
  uint64_t saturated_ = 0;
};

}  // namespace nephroid
