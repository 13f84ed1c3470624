// The materials used by a scene's shapes, and their names in messages. It must not know how
// materials scatter.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"

namespace nephroid {

/// The scattering materials by the kind of shape that uses them. A mix counts as its choices.
struct MaterialsOfShapes {
  std::vector<bool> on_surfaces;  ///< [material]: used by a shape on which photons can be merged
  std::vector<bool> on_curves;    ///< [material]: used by another shape
};
MaterialsOfShapes materials_of_shapes(const Scene& scene);

/// "glass (FILE:LINE:COLUMN)": the label, and the location if it is known.
std::string name_of_material(const Scene& scene, size_t index);
/// The same for a light.
std::string name_of_light(const Scene& scene, size_t index);

}  // namespace nephroid
