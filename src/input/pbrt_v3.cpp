// The table of pbrt-v3's names that have another name in pbrt-v4, and upgrades that need
// arithmetic. Materials are in pbrt_v3_materials.cpp.
#include "input/pbrt_v3.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace nephroid {
namespace v3 {

Parameter* find(Parameters& list, std::string_view name) {
  const auto found = std::find_if(
      list.begin(), list.end(), [&](const Parameter& parameter) { return parameter.name == name; });
  return found == list.end() ? nullptr : &*found;
}

std::optional<Parameter> take(Parameters& list, std::string_view name) {
  Parameter* const found = find(list, name);
  if (!found) return std::nullopt;
  Parameter taken = std::move(*found);
  list.erase(list.begin() + (found - list.data()));
  return taken;
}

Parameter& add(Parameters& list, const std::string& type, const std::string& name,
               const SourceLocation& where) {
  if (Parameter* const there = find(list, name)) return *there;
  Parameter& added = list.emplace_back();
  added.type = type;
  added.name = name;
  added.where = where;
  return added;
}

void add_float(Parameters& list, const std::string& name, double value,
               const SourceLocation& where) {
  if (!find(list, name)) add(list, "float", name, where).numbers = {value};
}

std::optional<double> grey_value(const Parameter& parameter) {
  const std::vector<double>& n = parameter.numbers;
  if (n.empty()) return std::nullopt;
  const bool pairs = parameter.type == "spectrum";
  if (!pairs && parameter.type != "rgb" && parameter.type != "float") return std::nullopt;
  const double value = n[pairs ? 1 : 0];
  for (size_t i = pairs ? 1 : 0; i < n.size(); i += pairs ? 2 : 1)
    if (n[i] != value) return std::nullopt;
  return value;
}

void make_float(Parameter& parameter) {
  const std::optional<double> value = grey_value(parameter);
  if (!value) return;
  parameter.type = "float";
  parameter.numbers = {*value};
}

}  // namespace v3

namespace {

using v3::Parameters;

struct RenamedType {
  const char* directive;
  const char* v3;
  const char* v4;
};
/// Types with another name, except materials.
constexpr RenamedType kRenamedTypes[] = {
    {"Film", "image", "rgb"},
    {"Camera", "environment", "spherical"},
    {"Sampler", "lowdiscrepancy", "paddedsobol"},
    {"Sampler", "02sequence", "paddedsobol"},
    {"Sampler", "maxmindist", "pmj02bn"},
    {"Sampler", "random", "independent"},
    {"AreaLightSource", "area", "diffuse"},
    {"MakeNamedMedium", "heterogeneous", "uniformgrid"},
};

struct ParameterRow {
  const char* directive;
  const char* type;  ///< empty: all types
  const char* v3;
  const char* v4;  ///< nullptr: dropped, since the picture does not depend on it
};
/// Parameters with another name or without one.
constexpr ParameterRow kParameters[] = {
    {"Film", "", "maxsampleluminance", "maxcomponentvalue"},
    {"PixelFilter", "", "xwidth", "xradius"},
    {"PixelFilter", "", "ywidth", "yradius"},
    {"Material", "", "bumpmap", "displacement"},
    {"Shape", "loopsubdiv", "nlevels", "levels"},
    {"LightSource", "infinite", "mapname", "filename"},
    {"LightSource", "projection", "mapname", "filename"},
    {"LightSource", "goniometric", "mapname", "filename"},
    {"LightSource", "", "samples", nullptr},
    {"LightSource", "", "nsamples", nullptr},
    {"AreaLightSource", "", "samples", nullptr},
    {"AreaLightSource", "", "nsamples", nullptr},
    {"Integrator", "", "rrthreshold", nullptr},
    {"Integrator", "sppm", "imagewritefrequency", nullptr},
    {"Camera", "realistic", "simpleweighting", nullptr},
    {"Sampler", "", "dimensions", nullptr},
    {"Texture", "checkerboard", "aamode", nullptr},
    {"Shape", "trianglemesh", "discarddegenerateUVs", nullptr},
    {"Shape", "plymesh", "discarddegenerateUVs", nullptr},
};

std::string in_quotes(std::string_view text) {
  return "\"" + std::string(text) + "\"";
}

[[noreturn]] void no_equal(const Parameter& parameter, const std::string& of_what,
                           const std::string& expected) {
  throw SceneError(parameter.where, "parameter \"" + parameter.type + " " + parameter.name +
                                        "\" of " + of_what + " is pbrt-v3's, expected " + expected);
}

void upgrade_film(Parameters& list) {
  if (auto scale = v3::take(list, "scale")) {
    const std::optional<double> value = v3::grey_value(*scale);
    if (value) v3::add_float(list, "iso", 100 * *value, scale->where);
  }
}

void upgrade_filter(const std::string& type, Parameters& list) {
  if (type != "gaussian") return;
  const auto alpha = v3::take(list, "alpha");
  const std::optional<double> value = alpha ? v3::grey_value(*alpha) : std::nullopt;
  if (value && !(*value > 0))
    no_equal(*alpha, "PixelFilter \"gaussian\"", "\"float sigma\", 1 / sqrt(2 alpha)");
  if (value) v3::add_float(list, "sigma", 1 / std::sqrt(2 * *value), alpha->where);
}

/// Removes a grey parameter of a light and returns it as a factor for the light's "scale".
double take_grey_factor(Parameters& list, const char* name, const std::string& of_what,
                        const std::string& expected) {
  const Parameter* const found = v3::find(list, name);
  if (!found) return 1;
  const std::optional<double> value = v3::grey_value(*found);
  if (!value) no_equal(*found, of_what, expected);
  v3::take(list, name);
  return *value;
}

/// Removes the second number of a blackbody emission, which was a factor, and returns it.
std::optional<double> take_blackbody_factor(Parameters& list, const char* name) {
  Parameter* const colour = v3::find(list, name);
  if (!colour || colour->type != "blackbody" || colour->numbers.size() != 2) return std::nullopt;
  const double factor = colour->numbers[1];
  colour->numbers.pop_back();
  return factor;
}

/// True if the list changed.
bool upgrade_emission(const std::string& type, Parameters& list, const SourceLocation& where) {
  const std::string of_what = "light " + in_quotes(type);
  const auto of_l = take_blackbody_factor(list, "L"), of_i = take_blackbody_factor(list, "I");
  double factor = of_l.value_or(1) * of_i.value_or(1);
  bool changed = of_l || of_i;
  if (v3::find(list, "mapname") && (type == "infinite" || type == "projection")) {
    const char* const colour = type == "infinite" ? "L" : "I";
    changed |= v3::find(list, colour) != nullptr;
    factor *= take_grey_factor(list, colour, of_what,
                               "\"float scale\" with \"filename\", or an image of that colour");
  }
  const Parameter* const scale = v3::find(list, "scale");
  if (scale && scale->type != "float") {
    changed = true;
    factor *= take_grey_factor(
        list, "scale", of_what,
        "\"float scale\", with the colour in the light's emission (\"rgb L\" or \"rgb I\")");
  }
  if (factor == 1) return changed;
  Parameter& result = v3::add(list, "float", "scale", where);
  result.numbers = {factor * (result.numbers.empty() ? 1 : result.numbers[0])};
  return true;
}

void upgrade_scale_texture(Parameters& list, bool of_floats) {
  Parameter* first = v3::find(list, "tex1");
  Parameter* second = v3::find(list, "tex2");
  // In pbrt-v4 the factor is a number or a float texture.
  const auto is_factor = [&](const Parameter* p) {
    return p && (of_floats || v3::grey_value(*p).has_value());
  };
  if (!is_factor(second) && is_factor(first)) std::swap(first, second);
  if (second && !is_factor(second))
    no_equal(
        *second, "texture \"scale\"",
        "\"tex\" and \"float scale\": one of the two must be a grey number or a float texture");
  if (second) {
    v3::make_float(*second);
    second->name = "scale";
  }
  if (first) first->name = "tex";
}

/// True if the list changed.
bool upgrade_image_texture(Parameters& list) {
  const auto trilinear = v3::take(list, "trilinear");
  if (trilinear && !trilinear->bools.empty() && trilinear->bools[0])
    v3::add(list, "string", "filter", trilinear->where).strings = {"trilinear"};
  const auto gamma = v3::take(list, "gamma");
  if (gamma && !gamma->bools.empty())
    v3::add(list, "string", "encoding", gamma->where).strings = {gamma->bools[0] ? "sRGB"
                                                                                 : "linear"};
  return trilinear || gamma;
}

/// The texture coordinates of a mesh in pbrt-v3's form; nullptr if there are none.
Parameter* old_uv(const std::string& type, Parameters& list) {
  if (type != "trianglemesh") return nullptr;
  Parameter* const uv = v3::find(list, "uv");
  Parameter* const found = uv ? uv : v3::find(list, "st");
  const bool is_old = found && (found->type == "float" || (!uv && found->type == "point2"));
  return is_old && found->numbers.size() % 2 == 0 ? found : nullptr;
}

/// Removes "shadowalpha"; true if it was there.
bool drop_shadow_alpha(const std::string& type, Parameters& list) {
  const bool is_mesh = type == "trianglemesh" || type == "plymesh";
  const Parameter* const shadow = is_mesh ? v3::find(list, "shadowalpha") : nullptr;
  if (!shadow) return false;
  const Parameter* const alpha = v3::find(list, "alpha");
  const bool same = alpha ? alpha->strings == shadow->strings && alpha->numbers == shadow->numbers
                          : v3::grey_value(*shadow) == 1.0;
  if (!same) no_equal(*shadow, "shape " + in_quotes(type), "\"alpha\", which counts for all rays");
  v3::take(list, "shadowalpha");
  return true;
}

}  // namespace

void V3Upgrade::note(const SourceLocation& where, const std::string& what) {
  if (!first_) first_ = where;
  if (std::find(upgrades_.begin(), upgrades_.end(), what) == upgrades_.end())
    upgrades_.push_back(what);
}

std::string_view V3Upgrade::directive_name(std::string_view name, const SourceLocation& where) {
  if (name != "SurfaceIntegrator") return name;
  note(where, "SurfaceIntegrator is Integrator");
  return "Integrator";
}

void V3Upgrade::upgrade_texture(const std::string& values, DirectiveDescription& directive) {
  Parameters& list = directive.parameters.list;
  if (directive.type != "scale" || !(v3::find(list, "tex1") || v3::find(list, "tex2"))) return;
  note(directive.where, "Texture \"scale\" of \"tex1\" and \"tex2\" is of \"tex\" and \"scale\"");
  upgrade_scale_texture(list, values == "float");
}

std::string V3Upgrade::texture_values(const std::string& type, const SourceLocation& where) {
  if (type != "color") return type;
  note(where, "texture type \"color\" is \"spectrum\"");
  return "spectrum";
}

void V3Upgrade::upgrade_types(std::string_view name, DirectiveDescription& directive) {
  for (const RenamedType& row : kRenamedTypes) {
    if (name != row.directive) continue;
    // Media have their type in a parameter.
    Parameter* const parameter =
        directive.type.empty() ? v3::find(directive.parameters.list, "type") : nullptr;
    const bool is_string = parameter && parameter->strings.size() == 1;
    std::string& type = is_string ? parameter->strings[0] : directive.type;
    if (type != row.v3) continue;
    note(directive.where, std::string(name) + " " + in_quotes(row.v3) + " is " + in_quotes(row.v4));
    type = row.v4;
    if (type == "spherical")
      v3::add(directive.parameters.list, "string", "mapping", directive.where).strings = {
          "equirectangular"};
  }
}

void V3Upgrade::upgrade_colours(std::vector<Parameter>& list) {
  for (Parameter& parameter : list) {
    if (parameter.type != "color") continue;
    note(parameter.where, "parameter type \"color\" is \"rgb\"");
    parameter.type = "rgb";
  }
}

void V3Upgrade::upgrade(std::string_view name, DirectiveDescription& directive) {
  Parameters& list = directive.parameters.list;
  const SourceLocation& where = directive.where;
  const std::string& type = directive.type;
  const bool is_light = name == "LightSource" || name == "AreaLightSource";
  if (is_light && upgrade_emission(type, list, where))
    note(where,
         "colours of \"scale\" and of images, and factors of blackbodies, are \"float scale\"");
  if (name == "Film" && v3::find(list, "scale")) {
    note(where, "Film \"scale\" is \"iso\" / 100");
    upgrade_film(list);
  }
  if (name == "PixelFilter" && type == "gaussian" && v3::find(list, "alpha")) {
    note(where, "PixelFilter \"alpha\" is \"sigma\"");
    upgrade_filter(type, list);
  }
  for (const ParameterRow& row : kParameters) {
    if (name != row.directive || (*row.type && type != row.type)) continue;
    Parameter* const found = v3::find(list, row.v3);
    if (!found || (row.v4 && v3::find(list, row.v4))) continue;
    note(found->where, std::string(name) + " " + in_quotes(row.v3) +
                           (row.v4 ? " is " + in_quotes(row.v4) : std::string(" is not needed")));
    if (row.v4)
      found->name = row.v4;
    else
      v3::take(list, row.v3);
  }
  if (Parameter* const uv = name == "Shape" ? old_uv(type, list) : nullptr) {
    note(uv->where, "Shape " + in_quotes(uv->type + " " + uv->name) + " is \"point2 uv\"");
    uv->type = "point2";
    uv->name = "uv";
  }
  if (name == "Shape" && drop_shadow_alpha(type, list))
    note(where, "Shape \"shadowalpha\" is \"alpha\"");
  if (name == "Texture" && type == "imagemap" && upgrade_image_texture(list))
    note(where, "\"trilinear\" is \"filter\", \"gamma\" is \"encoding\"");
  if (name == "Material") upgrade_material(directive);
  upgrade_types(name, directive);
}

void V3Upgrade::report(Diagnostics& diagnostics) const {
  if (!first_) return;
  std::string list;
  for (const std::string& upgrade : upgrades_) list += (list.empty() ? "" : "; ") + upgrade;
  diagnostics.warn(*first_, "the scene has names of pbrt-v3, upgraded to pbrt-v4: " + list);
}

}  // namespace nephroid
