// Lights as reports tell them apart. Who counts their light: integrators, by SceneSymbols::lamp. It
// must not know scenes.
#pragma once

#include <cstddef>
#include <cstdint>

namespace nephroid {

/// Number of a lamp: a light directive, or all of one name. The last of kMaxLamps stands for all
/// that do not fit.
using Lamp = uint16_t;
inline constexpr size_t kMaxLamps = 4096;

}  // namespace nephroid
