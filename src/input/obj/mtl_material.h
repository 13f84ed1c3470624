// MTL materials as "principled", area lights and opacity. It must not know files and meshes.
#pragma once

#include <optional>
#include <string>

#include "input/obj/mtl_file.h"
#include "input/scene_description.h"

namespace nephroid {

/// The parts of a scene that an MTL material becomes. The values of keywords stand in the table of
/// mtl_keywords.cpp.
struct ConvertedMaterial {
  MaterialDescription material;
  std::optional<DirectiveDescription> area_light;
  std::optional<Parameter> alpha;  ///< the shapes' opacity, if they are not opaque
};

/// Converts a material, and appends its textures to `textures`. The names of its images are
/// those in the scene already. `solid_glass`: see ImportOptions.
ConvertedMaterial convert_mtl(const MtlMaterial& mtl, bool solid_glass,
                              std::vector<TextureDescription>* textures, Diagnostics& diagnostics);

}  // namespace nephroid
