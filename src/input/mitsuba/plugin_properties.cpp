#include "input/mitsuba/plugin_properties.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <limits>

#include "core/counted.h"
#include "input/mitsuba/value_text.h"
#include "input/number_text.h"
#include "input/spelling.h"

namespace nephroid::mitsuba {
namespace {

/// Properties on which the picture does not depend.
constexpr std::array kNotNeeded = {"sampling_weight",
                                   "near_clip",
                                   "far_clip",
                                   "attach_log",
                                   "banner",
                                   "file_format",
                                   "pixel_format",
                                   "component_format",
                                   "channel_names",
                                   "high_quality_edges",
                                   "sample_border",
                                   "cache",
                                   "accel",
                                   "format",
                                   "strategy",
                                   "sample_visible",
                                   "sample_emitters",
                                   "has_spectral_extinction",
                                   "mis_compensation",
                                   "silhouette_sampling_weight",
                                   "max_anisotropy",
                                   "send_data",
                                   "step_size",
                                   "method",
                                   "flip_invalid_normals",
                                   "use_shadowing_function",
                                   "use_path_guiding",
                                   "main_specular_sampling_rate",
                                   "clearcoat_sampling_rate",
                                   "diffuse_reflectance_sampling_rate",
                                   "specular_reflectance_sampling_rate",
                                   "specular_transmittance_sampling_rate",
                                   "diffuse_transmittance_sampling_rate",
                                   "medium_sampling_weight",
                                   "use_fast_approx",
                                   "gamma_correct",
                                   "compensate",
                                   "digits",
                                   "variable",
                                   "monochromatic",
                                   "sampling_density"};

bool is_not_needed(const std::string& name) {
  return std::find(kNotNeeded.begin(), kNotNeeded.end(), name) != kNotNeeded.end();
}

std::string quoted(const Property& property) {
  return "property \"" + property.name + "\"";
}

[[noreturn]] void refuse_type(const Property& property, const std::string& expected) {
  throw SceneError(property.where,
                   quoted(property) + " is a <" + property.tag + ">, expected <" + expected + ">");
}

}  // namespace

const Property* PluginProperties::find(const std::string& name) {
  asked_.insert(name);
  for (const Property& property : object_.properties)
    if (property.name == name) return &property;
  return nullptr;
}

const std::string& PluginProperties::value(const Property& property, const char* expected_tag) {
  const auto it = property.attributes.find("value");
  if (it == property.attributes.end())
    throw SceneError(property.where, quoted(property) + " has no \"value\", expected a <" +
                                         expected_tag + "> with one");
  return it->second;
}

double PluginProperties::number(const std::string& name, double fallback) {
  const Property* p = find(name);
  if (!p) return fallback;
  if (p->tag != "float" && p->tag != "integer") refuse_type(*p, "float");
  const double found = finite_number(value(*p, "float"), quoted(*p), p->where);
  if (std::abs(found) > std::numeric_limits<float>::max())
    throw SceneError(p->where, quoted(*p) + " is too large for a float");
  return found;
}

int PluginProperties::integer(const std::string& name, int fallback) {
  const Property* p = find(name);
  if (!p) return fallback;
  if (p->tag != "integer" && p->tag != "long") refuse_type(*p, "integer");
  const std::optional<long long> found = parse_integer(trimmed(value(*p, "integer")));
  if (!found || *found < std::numeric_limits<int>::min() ||
      *found > std::numeric_limits<int>::max())
    throw SceneError(p->where, quoted(*p) + " is not an integer, expected one that fits 32 bits");
  return static_cast<int>(*found);
}

bool PluginProperties::boolean(const std::string& name, bool fallback) {
  const Property* p = find(name);
  if (!p) return fallback;
  if (p->tag != "boolean") refuse_type(*p, "boolean");
  const std::string text = snake_case(trimmed(value(*p, "boolean")));
  if (text != "true" && text != "false")
    throw SceneError(p->where, quoted(*p) + " is not a boolean, expected true or false");
  return text == "true";
}

std::string PluginProperties::text(const std::string& name, const std::string& fallback) {
  const Property* p = find(name);
  if (!p) return fallback;
  if (p->tag != "string") refuse_type(*p, "string");
  return value(*p, "string");
}

std::optional<Vec3d> PluginProperties::point(const std::string& name) {
  const Property* p = find(name);
  if (!p) return std::nullopt;
  if (p->tag != "point" && p->tag != "vector") refuse_type(*p, "point");
  return vector_value(*p);
}

TransformDescription PluginProperties::transform(const std::string& name) {
  const Property* p = find(name);
  if (!p) return {};
  if (p->tag != "transform" && p->tag != "animation") refuse_type(*p, "transform");
  context_.moves |= p->transform.is_animated();
  return p->transform;
}

std::string PluginProperties::file(const std::string& name) {
  const std::string found = text(name, "");
  const Property* p = find(name);
  if (found.empty())
    throw SceneError(p ? p->where : where(), title() + " has no \"" + name + "\", expected a file");
  return context_.file_names.find(*context_.scene.files, found, p->where);
}

const Object* PluginProperties::child(const std::string& tag, const std::string& name) {
  asked_.insert(name);
  for (const Child& c : object_.children)
    if (c.object->tag == tag && c.name == name) {
      used_children_.insert(&c);
      return c.object;
    }
  return nullptr;
}

std::vector<const Child*> PluginProperties::children(const std::string& tag) {
  std::vector<const Child*> found;
  for (const Child& c : object_.children)
    if (c.object->tag == tag) {
      used_children_.insert(&c);
      found.push_back(&c);
    }
  return found;
}

const Object* PluginProperties::first_child(const std::string& tag) {
  const std::vector<const Child*> all = children(tag);
  return all.empty() ? nullptr : all.front()->object;
}

void PluginProperties::report_unused() const {
  const std::vector<std::string> known(asked_.begin(), asked_.end());
  for (const Property& p : object_.properties)
    if (!asked_.contains(p.name) && !is_not_needed(p.name))
      context_.diagnostics.warn_of_unknown_name(p.where, quoted(p) + " of " + title() +
                                                             " is unknown, it is ignored" +
                                                             did_you_mean(p.name, known));
  for (const Child& c : object_.children)
    if (!used_children_.contains(&c))
      context_.diagnostics.warn_of_unknown_name(c.where, c.object->tag + " \"" + c.object->type +
                                                             "\" in " + title() +
                                                             " has no effect there and is ignored");
}

Vec3d vector_value(const Property& p) {
  if (p.attributes.contains("value")) {
    const std::vector<double> v = finite_numbers(p.attribute("value"), quoted(p), p.where);
    if (v.size() == 3) return {v[0], v[1], v[2]};
    throw SceneError(p.where,
                     quoted(p) + " has " + counted(v.size(), "number") + ", expected three");
  }
  Vec3d v(0.0);
  for (int i = 0; i < 3; ++i) {
    const std::string axis(1, "xyz"[i]);
    if (p.attributes.contains(axis)) v[i] = finite_number(p.attribute(axis), quoted(p), p.where);
  }
  return v;
}

}  // namespace nephroid::mitsuba
