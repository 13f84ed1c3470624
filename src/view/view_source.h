// What a page shows: a live render or a picture. It must not know the server.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "film/image_io.h"
#include "view/frame.h"
#include "view/live_state.h"
#include "view/shown_mix.h"

namespace nephroid {

class LiveRender;

/// A pixel of the picture.
struct ProbedPixel {
  Rgb value{0, 0, 0}, standard_error{0, 0, 0};
  uint64_t samples = 0;
};

/// Called by any thread.
class ViewSource {
 public:
  virtual ~ViewSource() = default;

  virtual LiveState state() const = 0;
  /// Waits until the state has a number other than `seen`, at most for `seconds`. Returns the
  /// number of the present state.
  virtual uint64_t wait_for_news(uint64_t seen, double seconds) const = 0;
  /// A frame (frame.h) with these layers that is newer than version `since` of `generation`.
  virtual std::optional<std::string> frame(const std::vector<std::string>& layers,
                                           uint64_t generation, uint64_t since) = 0;
  /// The newest picture; empty as long as there is none.
  virtual std::optional<PictureFrame> picture() { return std::nullopt; }
  /// Throws UsageError for a pixel outside of the window.
  virtual ProbedPixel probe(int x, int y) = 0;
  /// R, G and B of the present picture, mixed with these gains. Throws UsageError for layers that
  /// it does not have.
  virtual Picture colors(const LayerGains& gains) = 0;
  /// Writes the picture with all layers, and its PNG beside it. Throws IoError.
  virtual void write(const std::string& exr_path) = 0;
  /// Null for a picture.
  virtual LiveRender* live() { return nullptr; }
};

/// Throws UsageError for a pixel outside of a window.
void check_pixel(int x, int y, const PixelBounds& window);

}  // namespace nephroid
