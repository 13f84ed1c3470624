#include "input/convert/dialect.h"

#include <set>

namespace nephroid {
namespace {

bool has(const ParameterSet& parameters, const char* name) {
  for (const Parameter& parameter : parameters.list)
    if (parameter.name == name) return true;
  return false;
}

void add_light(const DirectiveDescription& light, std::set<std::string>* names) {
  if (has(light.parameters, "name")) names->insert("\"string name\" of lights");
  if (light.type == "distant" && has(light.parameters, "angle"))
    names->insert("\"float angle\" of distant lights");
  if (light.type == "infinite" && has(light.parameters, "faces"))
    names->insert("\"string faces\" of infinite lights");
}

}  // namespace

std::string dialect_note(const SceneDescription& scene) {
  std::set<std::string> names;
  for (const MaterialDescription& material : scene.materials)
    if (material.type == "principled") names.insert("material \"principled\"");
  for (const LightDescription& light : scene.lights) add_light(light, &names);
  for (const ShapeDescription& shape : scene.shapes)
    if (shape.area_light) add_light(*shape.area_light, &names);
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return list.empty() ? "" : "# Of Nephroid, not of pbrt-v4: " + list + ".\n";
}

}  // namespace nephroid
