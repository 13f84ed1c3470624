// The plug-ins of a Mitsuba scene with their properties, as plain structs. Parameters ($name) are
// replaced and references resolved. It must not know the meaning of plug-ins.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "input/mitsuba/file_names.h"
#include "input/scene_description.h"

namespace nephroid::mitsuba {

/// A value of a plug-in, such as <float name="alpha" value="0.1"/>.
struct Property {
  std::string tag;                                ///< element: "float", "rgb", "transform" ...
  std::string name;                               ///< in the style of Mitsuba 3: "int_ior"
  std::map<std::string, std::string> attributes;  ///< all but the name
  TransformDescription transform;                 ///< value of a transform or an animation
  SourceLocation where;

  /// The attribute; empty if it is absent.
  std::string attribute(const std::string& key) const {
    const auto it = attributes.find(key);
    return it == attributes.end() ? std::string() : it->second;
  }
};

struct Object;

struct Child {
  std::string name;                ///< name of the parent's property; may be empty
  std::string reference;           ///< id of a <ref>; empty for an object in place
  const Object* object = nullptr;  ///< never null in a finished document
  SourceLocation where;
};

/// A plug-in: <bsdf type="diffuse" id="red"> ... </bsdf>.
struct Object {
  std::string tag;   ///< "shape", "bsdf" ...
  std::string type;  ///< name of the plug-in
  std::string id;
  std::vector<Property> properties;
  std::vector<Child> children;
  SourceLocation where;
};

/// The contents of a scene file and the files that it includes.
struct Document {
  explicit Document(bool allow_outside) : file_names(allow_outside) {}

  int version = 0;  ///< major version: 0 for Mitsuba 0.5 and 0.6, else 2 or 3
  Object scene;
  FileNames file_names;  ///< with the folders of the scene's <path> elements
  std::map<std::string, std::string> parameters;  ///< values by name
  std::vector<std::unique_ptr<Object>> objects;   ///< owner of all objects below the scene
};

}  // namespace nephroid::mitsuba
