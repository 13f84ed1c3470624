// Parameters of pbrt-v4 directives by name and value. It must not know plug-ins.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "input/scene_description.h"

namespace nephroid::mitsuba {

inline Parameter numbers_parameter(std::string type, std::string name, std::vector<double> numbers,
                                   const SourceLocation& where) {
  Parameter p;
  p.type = std::move(type);
  p.name = std::move(name);
  p.numbers = std::move(numbers);
  p.where = where;
  return p;
}

inline Parameter text_parameter(std::string type, std::string name, std::vector<std::string> texts,
                                const SourceLocation& where) {
  Parameter p;
  p.type = std::move(type);
  p.name = std::move(name);
  p.strings = std::move(texts);
  p.where = where;
  return p;
}

inline void add_numbers(ParameterSet& set, const char* type, const std::string& name,
                        std::vector<double> numbers) {
  set.list.push_back(numbers_parameter(type, name, std::move(numbers), set.where));
}
inline void add_float(ParameterSet& set, const std::string& name, double value) {
  add_numbers(set, "float", name, {value});
}
inline void add_integer(ParameterSet& set, const std::string& name, int value) {
  add_numbers(set, "integer", name, {static_cast<double>(value)});
}
inline void add_rgb(ParameterSet& set, const std::string& name, const Vec3d& rgb) {
  add_numbers(set, "rgb", name, {rgb.x, rgb.y, rgb.z});
}
inline void add_text(ParameterSet& set, const std::string& name, const std::string& text) {
  set.list.push_back(text_parameter("string", name, {text}, set.where));
}
inline void add_bool(ParameterSet& set, const std::string& name, bool value) {
  Parameter p = numbers_parameter("bool", name, {}, set.where);
  p.bools = {value};
  set.list.push_back(std::move(p));
}
/// Adds a parameter under another name.
inline void add_as(ParameterSet& set, const std::string& name, Parameter parameter) {
  parameter.name = name;
  set.list.push_back(std::move(parameter));
}

/// A directive of that type at that place.
template <class Directive = DirectiveDescription>
Directive directive(std::string type, const SourceLocation& where) {
  Directive d;
  d.type = std::move(type);
  d.where = d.parameters.where = where;
  return d;
}

}  // namespace nephroid::mitsuba
