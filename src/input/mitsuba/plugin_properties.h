// Typed access to the properties and children of one plug-in. It remembers what was asked for, and
// warns of the rest. It must not know plug-ins.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "input/mitsuba/import_context.h"

namespace nephroid::mitsuba {

/// Getters throw a located SceneError if a value has the wrong type.
class PluginProperties {
 public:
  PluginProperties(const Object& object, ImportContext& context)
      : object_(object), context_(context) {}

  const Object& object() const { return object_; }
  ImportContext& context() const { return context_; }
  const SourceLocation& where() const { return object_.where; }
  /// `bsdf "diffuse"`
  std::string title() const { return object_.tag + " \"" + object_.type + "\""; }

  /// nullptr if absent.
  const Property* find(const std::string& name);
  bool has(const std::string& name) { return find(name) != nullptr; }
  double number(const std::string& name, double fallback);
  int integer(const std::string& name, int fallback);
  bool boolean(const std::string& name, bool fallback);
  std::string text(const std::string& name, const std::string& fallback);
  std::optional<Vec3d> point(const std::string& name);
  /// Identity if absent.
  TransformDescription transform(const std::string& name = "to_world");
  /// The name of a file in the scene's folder. Throws SceneError if it is absent.
  std::string file(const std::string& name = "filename");

  /// The nested object with that tag and property name; nullptr if absent.
  const Object* child(const std::string& tag, const std::string& name);
  /// All nested objects with that tag, in order.
  std::vector<const Child*> children(const std::string& tag);
  /// The first of them; nullptr if there is none.
  const Object* first_child(const std::string& tag);

  /// Warns of properties and children that nobody asked for.
  void report_unused() const;

 private:
  const std::string& value(const Property& property, const char* expected_tag);

  const Object& object_;
  ImportContext& context_;
  std::set<std::string> asked_;  ///< names of properties
  std::set<const Child*> used_children_;
};

/// "value" as a vector, or "x", "y" and "z".
Vec3d vector_value(const Property& property);

}  // namespace nephroid::mitsuba
