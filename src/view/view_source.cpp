#include "view/view_source.h"

#include <fmt/format.h>

#include "core/errors.h"

namespace nephroid {

void check_pixel(int x, int y, const PixelBounds& window) {
  if (x < window.x0 || x >= window.x1 || y < window.y0 || y >= window.y1)
    throw UsageError(fmt::format("pixel {},{} is outside of the picture, expected {}..{},{}..{}", x,
                                 y, window.x0, window.x1 - 1, window.y0, window.y1 - 1));
}

}  // namespace nephroid
