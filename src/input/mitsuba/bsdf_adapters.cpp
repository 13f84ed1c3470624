// BSDFs that change or mix others.
#include <map>

#include "core/counted.h"
#include "input/mitsuba/bsdf_writers.h"
#include "input/mitsuba/texture_plugins.h"
#include "input/mitsuba/value_text.h"

namespace nephroid::mitsuba {
namespace {

/// The BSDFs in this one. Throws SceneError unless there are at least `count`.
std::vector<Surface> nested_surfaces(PluginProperties& p, size_t count) {
  std::vector<Surface> all;
  for (const Child* child : p.children("bsdf"))
    all.push_back(write_bsdf(p.context(), *child->object));
  if (all.size() < count)
    throw SceneError(p.where(), p.title() + " has " + counted(all.size(), "BSDF") +
                                    " in it, expected at least " + std::to_string(count));
  return all;
}

Surface nested_surface(PluginProperties& p) {
  return nested_surfaces(p, 1)[0];
}

/// The material with its opacity, as a mixture with nothing: shapes have one opacity only.
std::string with_opacity(PluginProperties& p, const Surface& surface) {
  if (!surface.alpha) return surface.material;
  return mixture(p, null_material(p.context(), p.where()), surface.material, *surface.alpha);
}

/// Copies of materials with more parameters; both parts of mixtures get them.
class ParameterAdder {
 public:
  ParameterAdder(PluginProperties& properties, std::vector<Parameter> parameters)
      : p_(properties), parameters_(std::move(parameters)) {}

  std::string copy(const std::string& name) {
    const auto known = copies_.find(name);
    if (known != copies_.end()) return known->second;
    MaterialDescription m = written_material(p_.context(), name);
    if (m.type == "mix") {
      for (Parameter& parameter : m.parameters.list)
        if (parameter.name == "materials")
          for (std::string& part : parameter.strings) part = copy(part);
    } else if (m.type != "interface") {
      for (const Parameter& parameter : parameters_) {
        std::erase_if(m.parameters.list,
                      [&](const Parameter& other) { return other.name == parameter.name; });
        m.parameters.list.push_back(parameter);
      }
    }
    return copies_[name] = add_material(p_, std::move(m));
  }

 private:
  PluginProperties& p_;
  std::vector<Parameter> parameters_;
  std::map<std::string, std::string> copies_;
};

Surface with_parameters(PluginProperties& p, std::vector<Parameter> parameters) {
  Surface surface = nested_surface(p);
  surface.material = ParameterAdder(p, std::move(parameters)).copy(surface.material);
  return surface;
}

}  // namespace

Surface write_two_sided(PluginProperties& p) {
  const std::vector<Surface> all = nested_surfaces(p, 1);
  p.boolean("allow_transmission", false);
  if (all.size() > 1)
    warn_approximated(p, "the sides differ in Mitsuba, here the first BSDF is on both");
  Surface surface = all[0];
  surface.is_one_sided = false;
  return surface;
}

Surface write_mask(PluginProperties& p) {
  Surface surface = nested_surface(p);
  std::optional<Parameter> opacity = read_float(p, "opacity");
  if (!opacity) opacity = numbers_parameter("float", "", {0.5}, p.where());
  surface.material = with_opacity(p, surface);
  opacity->name = "alpha";
  surface.alpha = opacity;
  return surface;
}

Surface write_blend(PluginProperties& p) {
  const std::vector<Surface> all = nested_surfaces(p, 2);
  const auto weight = read_float(p, "weight");
  Surface surface;
  surface.material = mixture(p, with_opacity(p, all[0]), with_opacity(p, all[1]),
                             weight.value_or(numbers_parameter("float", "", {0.5}, p.where())));
  surface.is_one_sided = all[0].is_one_sided && all[1].is_one_sided;
  return surface;
}

Surface write_mixture(PluginProperties& p) {
  const std::vector<double> weights =
      finite_numbers(p.text("weights", ""), "\"weights\"", p.where());
  std::vector<Surface> all = nested_surfaces(p, 1);
  if (weights.size() != all.size())
    throw SceneError(p.where(), p.title() + " has " + counted(weights.size(), "weight") + " for " +
                                    counted(all.size(), "BSDF") + ", expected one for each");
  Surface surface;
  surface.is_one_sided = true;
  double sum = 0;
  for (size_t i = 0; i < all.size(); ++i) {
    if (!(weights[i] >= 0)) throw SceneError(p.where(), "a weight is negative, expected 0 or more");
    surface.is_one_sided = surface.is_one_sided && all[i].is_one_sided;
    sum += weights[i];
    const std::string part = with_opacity(p, all[i]);
    const double share = sum > 0 ? weights[i] / sum : 1;
    surface.material = i == 0 ? part
                              : mixture(p, surface.material, part,
                                        numbers_parameter("float", "", {share}, p.where()));
  }
  if (sum > 1.0001) warn_approximated(p, "the weights have a sum above 1, they are divided by it");
  if (sum < 0.9999)
    surface.material = mixture(p, surface.material, black_material(p.context(), p.where()),
                               numbers_parameter("float", "", {1 - sum}, p.where()));
  return surface;
}

Surface write_bump_map(PluginProperties& p) {
  const Object* texture = p.first_child("texture");
  if (!texture) throw SceneError(p.where(), p.title() + " has no texture, expected one of heights");
  const std::string name = write_texture(p.context(), *texture, TextureUse::kNumber);
  Parameter height = text_parameter("texture", "", {name}, texture->where);
  height = scaled(p, std::move(height), p.number("scale", 1));
  height.name = "displacement";
  return with_parameters(p, {std::move(height)});
}

Surface write_normal_map(PluginProperties& p) {
  const Object* texture = p.first_child("texture");
  if (!texture) throw SceneError(p.where(), p.title() + " has no texture, expected one of normals");
  return with_parameters(p, normal_map(p.context(), *texture));
}

}  // namespace nephroid::mitsuba
