// The small scenes on which all integrators must agree: a floor and a wall, a light that the camera
// does not see, and one thing to test. Used by integrators_test.cpp. The camera sees no edge of
// what photons are merged on, so that the error of a merge radius falls with its square.
#pragma once

#include <string>
#include <vector>

namespace nephroid {

/// Routes with which a scene is not rendered.
struct LeftOut {
  const char* routes;
  const char* reason;
};

/// Passes of what only some scenes are compared with.
constexpr uint32_t kFewPasses = 3;

struct AgreementScene {
  const char* name;
  const char* world;
  const char* camera = nullptr;  ///< null: a pinhole that looks down
  const char* light = nullptr;   ///< null: a disk
  int max_depth = 10;
  const char* film = "";  ///< parameters of the Film, and the pixel filter
  const char* reference = "path";
  uint32_t reference_passes = 16;       ///< of path tracing for each of theirs
  float radius = 0.8f;                  ///< pixel footprints
  int64_t photons = 6144;               ///< a pass
  uint32_t passes = 4;                  ///< of all that is compared with path tracing
  uint32_t passes_of_ppm = kFewPasses;  ///< all whose light has the wavelengths of the pass
  std::vector<LeftOut> left_out = {};
};

extern const std::vector<AgreementScene> kAgreementScenes;

/// The text of a whole scene. `directory` holds a height field for bumps, waves.pfm, a small
/// image, picture.pfm, and a measured reflection, brushed.bsdf.
std::string agreement_scene_text(const AgreementScene& scene, const std::string& directory);

}  // namespace nephroid
