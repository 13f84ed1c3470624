// How much light each technique found, for reports: which of the ways to make a path carried a
// route. Who calls it: integrators that combine several. It must not know walks or scenes.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace nephroid {

enum class Technique : uint8_t {
  kMeetLight,     ///< a camera path met a light
  kSampleLight,   ///< next-event estimation
  kConnect,       ///< a vertex of a light path
  kMerge,         ///< photons
  kMeetCamera,    ///< a light path was connected to the camera
  kMeetByMirrors  ///< walks for lights behind nothing but smooth glass and mirrors
};
inline constexpr size_t kTechniqueCount = 6;

/// Weighed light, in units that are the same for all.
using TechniqueLight = std::array<double, kTechniqueCount>;

/// Of the paths of a route.
struct RouteTechniques {
  std::string route;
  TechniqueLight light{};
};

}  // namespace nephroid
