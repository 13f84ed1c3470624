// State of one import: the description that is written and what was written already. It must not
// know plug-ins.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "input/mitsuba/object.h"
#include "input/scene_description.h"

namespace nephroid::mitsuba {

/// A BSDF as shapes use it.
struct Surface {
  std::string material;            ///< name of a material
  std::optional<Parameter> alpha;  ///< opacity, from "mask"
  bool is_one_sided = false;       ///< in Mitsuba its back is black
};

struct ImportContext {
  SceneDescription& scene;
  const FileNames& file_names;
  Diagnostics& diagnostics;
  int version = 0;                      ///< major version of the scene, 0 for 0.5 and 0.6
  bool moves = false;                   ///< true if a transform is animated
  int one_sided_shapes = 0;             ///< open shapes whose backs are black in Mitsuba
  SourceLocation first_one_sided = {};  ///< the first of them

  // What was written, so that a shared object is written once.
  std::map<const Object*, Surface> surfaces = {};
  std::map<std::pair<const Object*, std::string>, Surface> subsurfaces =
      {};  ///< keys: an object, and the material of the boundary
  std::map<std::pair<const Object*, std::string>, std::string> textures =
      {};  ///< by object and use
  std::map<const Object*, std::string> media = {};
  std::map<const Object*, std::string> groups = {};

  std::set<std::string> names = {};  ///< taken names of materials, textures, media and objects
  std::map<std::string, int> last_numbers = {};  ///< behind taken names, by the wanted name

  std::set<const Object*> written_shapes = {};
  size_t copied = 0;  ///< numbers in the shapes that were written again

  bool is_before_version_2() const { return version < 2; }
  /// The object's id, or a name of its plug-in, made unique.
  std::string unique_name(const Object& object) {
    return unique_name(object.id.empty() ? object.type : object.id);
  }
  std::string unique_name(const std::string& wanted) {
    std::string name = wanted;
    int& number = last_numbers.try_emplace(wanted, 1).first->second;
    while (!names.insert(name).second) name = wanted + "-" + std::to_string(++number);
    return name;
  }
};

}  // namespace nephroid::mitsuba
