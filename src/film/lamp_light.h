// Light found per lamp, for reports. It must not know walks or scenes.
#pragma once

#include <cstdint>
#include <string>

#include "route/lamp.h"

namespace nephroid {

struct LampLight {
  std::string name;
  double light = 0;   ///< summed luminance; only ratios between lamps are meaningful
  uint64_t rays = 0;  ///< shadow rays to it, blocked or not
};

}  // namespace nephroid
