// The Option directives of a scene, as far as they change pictures, and the Accelerator line.
// Who calls it: the scene builder; transport and integrators read the values. It must not know what
// follows from them.
#pragma once

#include "input/format_rows.h"

namespace nephroid {

struct SceneOptions {
  bool pixel_jitter = true;           ///< false: all samples of a pixel go through its centre
  bool wavelength_jitter = true;      ///< false: all paths have the same wavelengths
  bool force_diffuse = false;         ///< every surface is Lambertian and keeps its reflectance
  int seed = 0;                       ///< where the Sampler line gives none
  bool turn_about_camera = true;      ///< moving instances, else about the world's origin
  float displacement_edge_scale = 1;  ///< factor of the "edgelength" of displaced meshes
};

/// Warns of options that have no effect here; throws SceneError for values that the format does not
/// have.
SceneOptions read_scene_options(const SceneDescription& description, Diagnostics& diagnostics);

/// All types of accelerators of the format.
std::vector<FormatType> accelerator_types();

/// There is one accelerator here, whatever the scene says: warns of types that the format does not
/// have.
void check_accelerator(const SceneDescription& description, Diagnostics& diagnostics);

}  // namespace nephroid
