// Small scenes on which all integrators must agree: a floor, a wall, a light out of view, and one
// thing to test. The camera sees no edge of a surface on which photons are merged, so that the
// merge bias falls with the squared radius.
#pragma once

#include <string>
#include <vector>

namespace nephroid {

/// Routes that a scene is not rendered with.
struct LeftOut {
  const char* routes;
  const char* reason;
};

/// Passes of the routes that only some scenes are compared with.
constexpr uint32_t kFewPasses = 3;

struct AgreementScene {
  const char* name;
  const char* world;
  const char* camera = nullptr;  ///< null: a pinhole camera that looks down
  const char* light = nullptr;   ///< null: a disk lamp
  int max_depth = 10;
  const char* film = "";  ///< Film parameters and the pixel filter
  const char* reference = "path";
  uint32_t reference_passes = 16;       ///< passes of path tracing per pass compared
  float radius = 0.8f;                  ///< pixel footprints
  int64_t photons = 6144;               ///< photons per pass
  uint32_t passes = 4;                  ///< passes of all integrators compared
  uint32_t passes_of_ppm = kFewPasses;  ///< passes of `ppm`, whose paths share wavelengths
  std::vector<LeftOut> left_out = {};
};

extern const std::vector<AgreementScene> kAgreementScenes;

/// The text of a whole scene. `directory` holds waves.pfm (bump heights), picture.pfm (a small
/// image) and brushed.bsdf (a measured BSDF).
std::string agreement_scene_text(const AgreementScene& scene, const std::string& directory);

}  // namespace nephroid
