// Objects by id, and the resolution of <ref>. It must not know XML or the meaning of plug-ins.
#pragma once

#include <map>
#include <string>

#include "input/mitsuba/object.h"

namespace nephroid::mitsuba {

/// The named objects of a scene. A name may be used before it is defined.
class Ids {
 public:
  /// Throws SceneError if the id is taken.
  void add(const std::string& id, Object* object);
  /// `as` becomes another name of the object `id`.
  void add_alias(const std::string& id, const std::string& as, const SourceLocation& where);
  /// The object of that name. Throws SceneError at `where` if there is none.
  Object* find(const std::string& id, const SourceLocation& where) const;

 private:
  struct Alias {
    std::string id;
    SourceLocation where;
  };
  std::map<std::string, Object*> objects_;
  std::map<std::string, Alias> aliases_;
};

/// Gives each reference below `root` its object. Throws SceneError if an object is missing, refers
/// to itself, or if references are nested too deeply.
void resolve_references(Object& root, const Ids& ids);

}  // namespace nephroid::mitsuba
