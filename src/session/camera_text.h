// A scene's camera as text of pbrt-v4: for the clipboard, and as a scene that includes the old one.
// It must not know built scenes.
#pragma once

#include <string>

#include "input/scene_description.h"

namespace nephroid {

/// LookAt and Camera directives, with what stands before a LookAt: a Scale or a Transform if the
/// camera's own space is mirrored or scaled, and ActiveTransform if the camera moves. Numbers have
/// the nine digits of single precision.
std::string camera_text(const SceneDescription& description);

/// A scene that includes `included`, a pbrt scene, with the description's camera and film in place
/// of its own. All bits of the camera are kept. It has to lie in the directory of the included
/// scene, because file names are relative to the scene that is opened. Moving instances turn about
/// the new camera, as the format says. Scenes of other formats cannot be included: write_pbrt
/// (input/convert) writes their description whole.
std::string scene_text_with_camera(const SceneDescription& description,
                                   const std::string& included);

}  // namespace nephroid
