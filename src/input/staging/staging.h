// Camera, light, floor, sky and exposure for scenes that lack them or whose user asks for others.
// It must not know formats.
#pragma once

#include "input/import_options.h"
#include "input/scene_description.h"

namespace nephroid {

/// Properties of a format that decide what the program adds to a scene.
struct FormatTraits {
  bool is_complete = false;   ///< a scene without camera or light is meant to be so
  bool has_exposure = false;  ///< the film's exposure is the author's
  double glow = 0;            ///< luminance up to which a surface is no lamp, cd/m^2
};

/// Applies --floor, --sun, --environment and --exposure to a scene of any format. A scene that is
/// not complete by its author's will also gets a camera and light if it has none, with a warning.
/// Without exposures in the format, one is chosen for the file's lights unless the user gives one.
/// - The view is framed around all shapes, from the front right and above. The front is the south
///   (surroundings.h).
/// - The light is a grey sky and a soft lamp. A white surface that faces the lamp has the value 1.
/// Throws SceneError if shapes are needed and there are none.
void stage_scene(SceneDescription* scene, const FormatTraits& format, const ImportOptions& options,
                 Diagnostics& diagnostics);

}  // namespace nephroid
