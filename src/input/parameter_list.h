// Writes and replaces parameters of a directive, as the pbrt parser would fill them. It must not
// know directives.
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "input/scene_description.h"

namespace nephroid {

/// The parameters of one directive, all at the same place of the file.
class ParameterList {
 public:
  using Color = std::array<double, 3>;

  explicit ParameterList(SourceLocation where) { set_.where = std::move(where); }

  void add_numbers(const char* type, const std::string& name, std::vector<double> numbers) {
    add(type, name).numbers = std::move(numbers);
  }
  void add_float(const std::string& name, double value) { add_numbers("float", name, {value}); }
  void add_integer(const std::string& name, int value) {
    add_numbers("integer", name, {static_cast<double>(value)});
  }
  void add_color(const std::string& name, const Color& c) {
    add_numbers("rgb", name, {c[0], c[1], c[2]});
  }
  void add_point(const std::string& name, const Vec3d& p) {
    add_numbers("point3", name, {p.x, p.y, p.z});
  }
  void add_string(const std::string& name, std::string text) {
    add("string", name).strings.push_back(std::move(text));
  }
  void add_strings(const std::string& name, std::vector<std::string> texts) {
    add("string", name).strings = std::move(texts);
  }
  /// A reference to a texture by its name.
  void add_texture(const std::string& name, std::string texture) {
    add("texture", name).strings.push_back(std::move(texture));
  }
  void add_bool(const std::string& name, bool value) { add("bool", name).bools.push_back(value); }

  /// The parameters of another list; their places stay.
  void add_all(const ParameterList& other) {
    set_.list.insert(set_.list.end(), other.set_.list.begin(), other.set_.list.end());
  }

  const SourceLocation& where() const { return set_.where; }
  const ParameterSet& set() const { return set_; }
  /// A directive of that type with these parameters.
  DirectiveDescription directive(const std::string& type) && {
    DirectiveDescription d;
    d.type = type;
    d.where = set_.where;
    d.parameters = std::move(set_);
    return d;
  }
  ParameterSet take() { return std::move(set_); }

 private:
  Parameter& add(const char* type, const std::string& name) {
    Parameter& parameter = set_.list.emplace_back();
    parameter.type = type;
    parameter.name = name;
    parameter.where = set_.where;
    return parameter;
  }

  ParameterSet set_;
};

/// Adds a parameter in place of those of the same name.
inline void replace_parameter(ParameterSet* set, Parameter parameter) {
  std::erase_if(set->list, [&](const Parameter& old) { return old.name == parameter.name; });
  set->list.push_back(std::move(parameter));
}

}  // namespace nephroid
