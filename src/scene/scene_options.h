// The Option directives of a scene that change images, and the Accelerator line. It must not know
// the effects of the options.
#pragma once

#include "input/format_rows.h"

namespace nephroid {

struct SceneOptions {
  bool pixel_jitter = true;           ///< false: all samples of a pixel go through its centre
  bool wavelength_jitter = true;      ///< false: all paths have the same wavelengths
  bool force_diffuse = false;         ///< every surface is Lambertian, with its own reflectance
  int seed = 0;                       ///< seed if the Sampler line gives none
  bool turn_about_camera = true;      ///< moving instances turn about the camera, not the origin
  float displacement_edge_scale = 1;  ///< factor of the "edgelength" of displaced meshes
};

/// Warns of options without effect here. Throws SceneError for values that the format does not
/// allow.
SceneOptions read_scene_options(const SceneDescription& description, Diagnostics& diagnostics);

/// All types of accelerators of the format.
std::vector<FormatType> accelerator_types();

/// There is only one accelerator, whatever the scene says. Warns of types that the format does not
/// have.
void check_accelerator(const SceneDescription& description, Diagnostics& diagnostics);

}  // namespace nephroid
