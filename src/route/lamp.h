// Lamps: lights as reports distinguish them. It must not know scenes.
#pragma once

#include <cstddef>
#include <cstdint>

namespace nephroid {

/// Index of a lamp: one light directive, or all with one label. The last of kMaxLamps stands for
/// all that do not fit.
using Lamp = uint16_t;
inline constexpr size_t kMaxLamps = 4096;

}  // namespace nephroid
