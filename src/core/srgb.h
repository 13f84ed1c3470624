// The sRGB curve of IEC 61966-2-1. It must not know colours.
#pragma once

#include <cmath>

namespace nephroid {

/// A code value over its maximum, [0,1], to linear.
template <class Float>
Float decode_srgb(Float encoded) {
  return encoded <= Float(0.04045) ? encoded / Float(12.92)
                                   : std::pow((encoded + Float(0.055)) / Float(1.055), Float(2.4));
}

}  // namespace nephroid
