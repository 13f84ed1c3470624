// What light path expressions call the materials, media and lights of a scene: the name that the
// file gives, else the type and a number. Numbers count what has no name, per type, from 1, in file
// order; a number whose label is somebody's name is left out. Who calls it: the scene builder. It
// must not know expressions.
#pragma once

#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "input/scene_description.h"

namespace nephroid {

/// In the order of description.materials, used or not. The material of shapes that have none is
/// called after its type as well; the type "" counts as "interface".
std::vector<std::string> material_labels(const SceneDescription& description);

/// In the order of description.media: their names.
std::vector<std::string> medium_labels(const SceneDescription& description);

/// Labels of lights. The `"string name"` of a light need not be its own: lights of the same name
/// are one to an expression. Throws SceneError if a "name" is no string.
class LightLabels {
 public:
  explicit LightLabels(const SceneDescription& description);

  /// Of description.lights[index].
  const std::string& light(size_t index) const { return lights_[index]; }
  /// Of an AreaLightSource that some shape of the description has. One without a name is counted
  /// where the first such shape stands.
  const std::string& area_light(const DirectiveDescription& directive) const {
    return area_lights_.at(place(directive));
  }

 private:
  /// The same directive may belong to many shapes. A file that is included twice has two texts.
  using Place = std::tuple<const std::string*, int, int>;
  static Place place(const DirectiveDescription& directive) {
    return {directive.where.file.get(), directive.where.line, directive.where.column};
  }

  std::vector<std::string> lights_;
  std::map<Place, std::string> area_lights_;
};

}  // namespace nephroid
