// Light found per sampling technique, for reports. It must not know walks or scenes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace nephroid {

enum class Technique : uint8_t {
  kMeetLight,     ///< BSDF sampling: a camera path hit a light
  kSampleLight,   ///< next-event estimation
  kConnect,       ///< connection with a vertex of a light path
  kMerge,         ///< merging with photons
  kMeetCamera,    ///< light tracing: a light path connected to the camera
  kMeetByMirrors  ///< delta paths: both ways at each smooth boundary, up to a light
};
inline constexpr size_t kTechniqueCount = 6;

/// The technique's name in reports.
constexpr const char* technique_name(Technique technique) {
  switch (technique) {
    case Technique::kMeetLight:
      return "BSDF sampling";
    case Technique::kSampleLight:
      return "next-event estimation";
    case Technique::kConnect:
      return "vertex connection";
    case Technique::kMerge:
      return "photon merging";
    case Technique::kMeetCamera:
      return "light tracing";
    case Technique::kMeetByMirrors:
      return "specular chains";
  }
  return "";
}

/// [technique]: weighted light, in the same units for all.
using TechniqueLight = std::array<double, kTechniqueCount>;

/// The light of a route's paths by technique.
struct RouteTechniques {
  std::string route;
  TechniqueLight light{};
};

}  // namespace nephroid
