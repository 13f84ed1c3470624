// The objects of the world: materials, textures, media, lights, shapes and instances, and the check
// that every used name is defined.
#include <algorithm>
#include <utility>

#include "input/description_builder.h"
#include "input/spelling.h"

namespace nephroid {
namespace {

using Names = std::map<std::string, SourceLocation>;

/// Remembers where `name` was defined; a second definition is an error.
void define(Names& names, const char* what, const std::string& name, const SourceLocation& where) {
  const auto [entry, is_new] = names.try_emplace(name, where);
  if (!is_new) {
    throw SceneError(where, std::string(what) + " \"" + name + "\" is already defined at " +
                                entry->second.to_string());
  }
}

template <class Map>
void expect_defined(const Map& map, const char* what, const std::string& name,
                    const SourceLocation& where) {
  if (name.empty() || map.find(name) != map.end()) return;
  std::vector<std::string> known;
  for (const auto& entry : map) known.push_back(entry.first);
  throw SceneError(
      where, std::string(what) + " \"" + name + "\" is not defined" + did_you_mean(name, known));
}

/// Takes the type of a named material or medium from its parameter "string type".
void take_type_parameter(DirectiveDescription& directive, const std::string& of_what) {
  directive.type = directive.parameters.get_string("type", "");
  if (directive.type.empty())
    throw SceneError(
        directive.where,
        of_what +
            " has no parameter \"string type\", expected one as in \"string type\" \"diffuse\"");
}

template <class Description>
Description& append(std::vector<Description>& list, DirectiveDescription&& directive) {
  Description& added = list.emplace_back();
  static_cast<DirectiveDescription&>(added) = std::move(directive);
  return added;
}

}  // namespace

void DescriptionBuilder::add_material(DirectiveDescription directive) {
  add_defaults(AttributeTarget::kMaterial, directive.parameters);
  state_.material = {static_cast<int>(scene_.materials.size()), std::string(), directive.where};
  append(scene_.materials, std::move(directive));
}

void DescriptionBuilder::use_named_material(const std::string& name, const SourceLocation& where) {
  state_.material = {-1, name, where};
}

void DescriptionBuilder::add_named_material(const std::string& name,
                                            DirectiveDescription directive) {
  define(material_names_, "named material", name, directive.where);
  add_defaults(AttributeTarget::kMaterial, directive.parameters);
  take_type_parameter(directive, "named material \"" + name + "\"");
  append(scene_.materials, std::move(directive)).name = name;
}

void DescriptionBuilder::add_medium(const std::string& name, DirectiveDescription directive) {
  define(medium_names_, "medium", name, directive.where);
  add_defaults(AttributeTarget::kMedium, directive.parameters);
  take_type_parameter(directive, "medium \"" + name + "\"");
  MediumDescription& medium = append(scene_.media, std::move(directive));
  medium.name = name;
  medium.transform = state_.ctm;
}

void DescriptionBuilder::add_texture(const std::string& name, const std::string& value_type,
                                     DirectiveDescription directive) {
  define(value_type == "float" ? float_texture_names_ : spectrum_texture_names_,
         value_type == "float" ? "float texture" : "spectrum texture", name, directive.where);
  add_defaults(AttributeTarget::kTexture, directive.parameters);
  TextureDescription& texture = append(scene_.textures, std::move(directive));
  texture.name = name;
  texture.value_type = value_type;
  texture.transform = state_.ctm;
}

void DescriptionBuilder::add_light(DirectiveDescription directive) {
  add_defaults(AttributeTarget::kLight, directive.parameters);
  LightDescription& light = append(scene_.lights, std::move(directive));
  light.transform = state_.ctm;
  light.medium = state_.outside_medium;
}

void DescriptionBuilder::set_area_light(DirectiveDescription directive) {
  add_defaults(AttributeTarget::kLight, directive.parameters);
  state_.area_light.reset();
  if (!directive.type.empty()) state_.area_light = std::move(directive);
}

MaterialReference DescriptionBuilder::material_of(const SourceLocation& shape_where) {
  if (state_.material.index >= 0 || !state_.material.name.empty()) return state_.material;
  if (default_material_ < 0) {
    default_material_ = static_cast<int>(scene_.materials.size());
    MaterialDescription& material = scene_.materials.emplace_back();
    material.type = "diffuse";
    material.where = material.parameters.where = shape_where;
  }
  return {default_material_, std::string(), shape_where};
}

void DescriptionBuilder::add_shape(DirectiveDescription directive) {
  add_defaults(AttributeTarget::kShape, directive.parameters);
  MaterialReference material = material_of(directive.where);
  ShapeDescription& shape = append(object_ ? object_->shapes : scene_.shapes, std::move(directive));
  shape.transform = state_.ctm;
  shape.reverse_orientation = state_.reverse_orientation;
  shape.material = std::move(material);
  shape.inside_medium = state_.inside_medium;
  shape.outside_medium = state_.outside_medium;
  if (!object_) {
    shape.area_light = state_.area_light;
  } else if (state_.area_light && !warned_of_area_light_) {
    warned_of_area_light_ = true;  // once for each object
    diagnostics_.warn(shape.where,
                      "area lights are not supported on instances: the surface does "
                      "not emit (object \"" +
                          object_->name + "\")");
  }
}

void DescriptionBuilder::object_instance(const std::string& name, const SourceLocation& where) {
  if (object_) {
    throw SceneError(where, "ObjectInstance inside of the object \"" + object_->name +
                                "\", objects cannot contain instances");
  }
  scene_.instances.push_back({name, state_.ctm, where});
}

void DescriptionBuilder::finish(const SourceLocation& end_of_file) const {
  if (!in_world_) throw SceneError(end_of_file, "the scene ends before WorldBegin");
  check_nothing_open(0);

  const auto check_shapes = [this](const std::vector<ShapeDescription>& shapes) {
    for (const ShapeDescription& shape : shapes) {
      expect_defined(material_names_, "named material", shape.material.name, shape.material.where);
      expect_defined(medium_names_, "medium", shape.inside_medium, shape.where);
      expect_defined(medium_names_, "medium", shape.outside_medium, shape.where);
    }
  };
  check_shapes(scene_.shapes);
  for (const auto& object : scene_.objects) check_shapes(object.second.shapes);
  for (const LightDescription& light : scene_.lights)
    expect_defined(medium_names_, "medium", light.medium, light.where);
  if (scene_.camera)
    expect_defined(medium_names_, "medium", scene_.camera->medium, scene_.camera->where);
  for (const InstanceDescription& instance : scene_.instances)
    expect_defined(scene_.objects, "object", instance.object, instance.where);
}

}  // namespace nephroid
