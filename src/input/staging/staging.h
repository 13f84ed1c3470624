// Camera, light, floor, sky and exposure for scenes that lack them or whose user asks for others.
// It must not know formats.
#pragma once

#include "input/import_options.h"
#include "input/scene_description.h"

namespace nephroid {

/// Applies --floor, --sun, --environment and --exposure to a scene of any format. Unless
/// `is_complete`, a scene without camera or light gets one, with a warning.
/// - The view is framed around all shapes, from the front right and above. The front is the south
///   (surroundings.h).
/// - The light is a grey sky and a soft lamp. A white surface that faces the lamp has the value 1.
/// Throws SceneError if shapes are needed and there are none.
void stage_scene(SceneDescription* scene, bool is_complete, const ImportOptions& options,
                 Diagnostics& diagnostics);

}  // namespace nephroid
