// Names in a scene that pbrt-v4 does not have. It must not know their meaning.
#pragma once

#include <span>
#include <string>

#include "input/scene_description.h"

namespace nephroid {

/// A name of this program's dialect. The tables of the format say "not in pbrt-v4" of the same
/// names, which a test compares.
struct DialectName {
  const char* directive;       ///< "Texture", "Shape" ...
  const char* type;            ///< "imagemap" ...; empty: all types
  const char* parameter = "";  ///< empty: the type itself
  const char* value = "";      ///< empty: all values
};
std::span<const DialectName> dialect_names();

/// A comment line that lists the names of this program's dialect in the scene; empty if there are
/// none.
std::string dialect_note(const SceneDescription& scene);

}  // namespace nephroid
