// Labels of materials, media and lights in light path expressions: the file's name, else type and
// number. Unnamed things are numbered per type, from 1, in file order; numbers whose label is
// another thing's name are skipped. It must not know expressions.
#pragma once

#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "input/scene_description.h"

namespace nephroid {

/// Labels of description.materials in their order, used or not. The default material is also
/// labelled by its type. The type "" counts as "interface".
std::vector<std::string> material_labels(const SceneDescription& description);

/// Labels of description.media in their order: their names.
std::vector<std::string> medium_labels(const SceneDescription& description);

/// Labels of lights. The "string name" of a light need not be unique: expressions treat lights with
/// the same name as one. Throws SceneError if a "name" is no string.
class LightLabels {
 public:
  explicit LightLabels(const SceneDescription& description);

  /// Label of description.lights[index].
  const std::string& light(size_t index) const { return lights_[index]; }
  /// Label of an AreaLightSource used by a shape of the description. An unnamed one is numbered at
  /// its first such shape.
  const std::string& area_light(const DirectiveDescription& directive) const {
    return area_lights_.at(place(directive));
  }

 private:
  /// Key of a directive that many shapes can share. Each inclusion of a file has its own `file`
  /// object.
  using Place = std::tuple<const std::string*, int, int>;
  static Place place(const DirectiveDescription& directive) {
    return {directive.where.file.get(), directive.where.line, directive.where.column};
  }

  std::vector<std::string> lights_;
  std::map<Place, std::string> area_lights_;
};

}  // namespace nephroid
