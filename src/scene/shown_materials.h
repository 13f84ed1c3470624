// Which materials of a scene its shapes have, and what messages call them. It must not know what
// materials scatter.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"

namespace nephroid {

/// The materials that scatter, by what they are on. A mix shows those that it chooses among.
struct MaterialsOfShapes {
  std::vector<bool> on_surfaces;  ///< [material]: some shape where photons can be merged has it
  std::vector<bool> on_curves;    ///< [material]: some other shape has it
};
MaterialsOfShapes materials_of_shapes(const Scene& scene);

/// "glass (FILE:LINE:COLUMN)": its label, and its place if that is known.
std::string name_of_material(const Scene& scene, size_t index);
/// The same of a light.
std::string name_of_light(const Scene& scene, size_t index);

}  // namespace nephroid
