#include "input/convert/dialect.h"

#include <map>
#include <set>

namespace nephroid {
namespace {

constexpr DialectName kDialects[] = {
    {"Material", "principled"},
    {"Material", "coatedconductor", "interface.thickness"},
    {"Material", "", "normalmap.scale"},
    {"Material", "", "normalmap.handedness"},
    {"Material", "", "normalmap.uwrap"},
    {"Material", "", "normalmap.vwrap"},
    {"Material", "", "normalmap.uvset"},
    {"Material", "", "normalmap.uvtransform"},
    {"Texture", "vertexcolor"},
    {"Texture", "imagemap", "forceencoding"},
    {"Texture", "imagemap", "vertexcolor"},
    {"Texture", "imagemap", "wrap", "mirror"},
    {"Texture", "imagemap", "uwrap"},
    {"Texture", "imagemap", "vwrap"},
    {"Texture", "imagemap", "uvset"},
    {"Texture", "imagemap", "uvtransform"},
    {"Texture", "imagemap", "channel"},
    {"Texture", "imagemap", "cutoff"},
    {"Texture", "imagemap", "factor"},
    {"Shape", "trianglemesh", "uv2"},
    {"Shape", "trianglemesh", "vertexcolors"},
    {"LightSource", "", "name"},
    {"LightSource", "distant", "angle"},
    {"LightSource", "infinite", "faces"},
    {"AreaLightSource", "", "name"},
    {"AreaLightSource", "", "factor"},
    {"AreaLightSource", "", "uwrap"},
    {"AreaLightSource", "", "vwrap"},
    {"AreaLightSource", "", "uvtransform"},
};

/// The word for a directive of any type.
std::string noun(const std::string& directive) {
  static const std::map<std::string, std::string> kNouns = {{"Material", "material"},
                                                            {"Texture", "texture"},
                                                            {"Shape", "shape"},
                                                            {"LightSource", "light"},
                                                            {"AreaLightSource", "area light"}};
  return kNouns.at(directive);
}

/// `"float angle" of distant lights`
std::string phrase(const DialectName& name, const std::string& parameter_type) {
  const std::string type = name.type, kind = noun(name.directive);
  if (!*name.parameter) return kind + " \"" + type + "\"";
  const std::string value = *name.value ? " \"" + std::string(name.value) + "\"" : "";
  return "\"" + parameter_type + " " + name.parameter + "\"" + value + " of " +
         (type.empty() ? "" : type + " ") + kind + "s";
}

/// Collects the names of the dialect from directives.
class Collector {
 public:
  void add(const std::string& directive, const DirectiveDescription& d) {
    for (const DialectName& name : kDialects)
      if (directive == name.directive && (!*name.type || d.type == name.type)) add(name, d);
  }
  void add(const ShapeDescription& shape) {
    add("Shape", shape);
    if (shape.area_light) add("AreaLightSource", *shape.area_light);
  }
  const std::set<std::string>& phrases() const { return phrases_; }

 private:
  void add(const DialectName& name, const DirectiveDescription& d) {
    if (!*name.parameter) phrases_.insert(phrase(name, ""));
    for (const Parameter& p : d.parameters.list)
      if (p.name == name.parameter &&
          (!*name.value || (!p.strings.empty() && p.strings[0] == name.value)))
        phrases_.insert(phrase(name, p.type));
  }

  std::set<std::string> phrases_;
};

}  // namespace

std::span<const DialectName> dialect_names() {
  return kDialects;
}

std::string dialect_note(const SceneDescription& scene) {
  Collector collector;
  for (const MaterialDescription& material : scene.materials) collector.add("Material", material);
  for (const TextureDescription& texture : scene.textures) collector.add("Texture", texture);
  for (const LightDescription& light : scene.lights) collector.add("LightSource", light);
  for (const ShapeDescription& shape : scene.shapes) collector.add(shape);
  for (const auto& entry : scene.objects)
    for (const ShapeDescription& shape : entry.second.shapes) collector.add(shape);
  std::string list;
  for (const std::string& phrase : collector.phrases()) list += (list.empty() ? "" : ", ") + phrase;
  return list.empty() ? "" : "# Of Nephroid, not of pbrt-v4: " + list + ".\n";
}

}  // namespace nephroid
