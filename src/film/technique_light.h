// How much light each technique found, for reports: which of the ways to make a path carried a
// route. Who calls it: integrators that combine several. It must not know walks or scenes.
#pragma once

#include <array>
#include <cstddef>
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
  kMeetByMirrors  ///< both ways at each smooth boundary, to lights behind nothing but these
};
inline constexpr size_t kTechniqueCount = 6;

/// As a report names what it found.
constexpr const char* technique_name(Technique technique) {
  switch (technique) {
    case Technique::kMeetLight:
      return "lights met";
    case Technique::kSampleLight:
      return "lights sampled";
    case Technique::kConnect:
      return "light paths connected";
    case Technique::kMerge:
      return "photons merged";
    case Technique::kMeetCamera:
      return "light paths seen";
    case Technique::kMeetByMirrors:
      return "lights behind mirrors and glass";
  }
  return "";
}

/// Weighed light, in units that are the same for all.
using TechniqueLight = std::array<double, kTechniqueCount>;

/// Of the paths of a route.
struct RouteTechniques {
  std::string route;
  TechniqueLight light{};
};

}  // namespace nephroid
