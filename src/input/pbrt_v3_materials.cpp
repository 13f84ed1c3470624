// Upgrades pbrt-v3's materials to those of pbrt-v4 that look the same. Highlights "Ks", which
// pbrt-v3 adds to a diffuse part, have no equal: pbrt-v4's coats lie over it and take its light.
#include <algorithm>
#include <cmath>

#include "input/pbrt_v3.h"

namespace nephroid {
namespace {

using v3::Parameters;

struct MaterialRow {
  const char* v3;
  const char* v4;   ///< nullptr: none looks the same
  const char* way;  ///< replacement if the meaning differs
};
constexpr MaterialRow kMaterials[] = {
    {"matte", "diffuse", "Material \"diffuse\", which has no \"sigma\""},
    {"plastic", "diffuse",
     "Material \"coateddiffuse\" with \"reflectance\" and \"roughness\", or \"Ks\" 0"},
    {"uber", "diffuse",
     "Material \"coateddiffuse\", \"dielectric\" or a \"mix\" of them, or \"Ks\", \"Kr\" and "
     "\"Kt\" 0 and \"opacity\" 1"},
    {"translucent", "diffusetransmission",
     "Material \"diffusetransmission\" with \"reflectance\" and \"transmittance\", or \"Ks\" 0"},
    {"glass", "dielectric",
     "Material \"dielectric\", whose reflection and transmission follow from \"eta\""},
    {"kdsubsurface", "subsurface",
     "Material \"subsurface\", whose reflection and transmission follow from \"eta\""},
    {"metal", "conductor", "Material \"conductor\""},
    {"mirror", "conductor", "Material \"conductor\""},
    {"substrate", nullptr,
     "Material \"coateddiffuse\" with \"reflectance\", \"uroughness\" and \"vroughness\""},
    {"disney", nullptr, "Material \"principled\""},
    {"fourier", nullptr, "Material \"measured\""},
};

/// Parameters that must have a certain value for the meaning to be the same; they are dropped then.
struct FixedRow {
  const char* material;
  const char* parameter;
  double value;
  bool is_default;  ///< true if it is pbrt-v3's default
};
constexpr FixedRow kFixed[] = {
    {"matte", "sigma", 0, true},     {"plastic", "Ks", 0, false},   {"uber", "Ks", 0, false},
    {"uber", "Kr", 0, true},         {"uber", "Kt", 0, true},       {"uber", "opacity", 1, true},
    {"glass", "Kr", 1, true},        {"glass", "Kt", 1, true},      {"translucent", "Ks", 0, false},
    {"subsurface", "Kr", 1, true},   {"subsurface", "Kt", 1, true}, {"kdsubsurface", "Kr", 1, true},
    {"kdsubsurface", "Kt", 1, true},
};

/// Parameters of a highlight: unused if "Ks" is 0.
constexpr const char* kOfHighlights[] = {"roughness",      "uroughness", "vroughness",
                                         "remaproughness", "index",      "eta"};

const MaterialRow* find_row(const std::string& type) {
  const auto* const found = std::find_if(std::begin(kMaterials), std::end(kMaterials),
                                         [&](const MaterialRow& row) { return type == row.v3; });
  return found == std::end(kMaterials) ? nullptr : found;
}

/// `because` follows "cannot be upgraded: ".
[[noreturn]] void no_equal(const SourceLocation& where, const std::string& type,
                           const std::string& because) {
  const MaterialRow* const row = find_row(type);
  throw SceneError(where, "pbrt-v3 material \"" + type + "\" cannot be upgraded: " + because +
                              ", expected " + (row ? row->way : find_row("kdsubsurface")->way));
}

/// Removes fixed parameters; true if any was there.
bool drop_fixed(const std::string& type, Parameters& list, const SourceLocation& where) {
  bool dropped = false;
  for (const FixedRow& row : kFixed) {
    if (type != row.material) continue;
    const auto found = v3::take(list, row.parameter);
    dropped |= found.has_value();
    if (found ? v3::grey_value(*found) == row.value : row.is_default) continue;
    no_equal(found ? found->where : where, type,
             "pbrt-v4 has no counterpart to its \"" + std::string(row.parameter) + "\"" +
                 (found ? "" : " (set by default)"));
  }
  return dropped;
}

/// Microfacet alpha of a pbrt-v3 roughness, by its polynomial in the logarithm.
double v3_alpha(double roughness) {
  const double x = std::log(std::max(roughness, 1e-3));
  return 1.62142 + x * (0.819955 + x * (0.1734 + x * (0.0171201 + x * 0.000640711)));
}

/// Converts roughness: pbrt-v4's alpha is the square root of its roughness. Textures stay as they
/// are. Returns a note, or an empty text.
std::string remap_roughness(Parameters& list, bool zero_is_smooth) {
  const Parameter* const remaps = v3::find(list, "remaproughness");
  if (remaps && !remaps->bools.empty() && !remaps->bools[0]) return {};
  std::string note;
  for (const char* const name : {"roughness", "uroughness", "vroughness"}) {
    Parameter* const roughness = v3::find(list, name);
    if (roughness && roughness->type == "texture")
      note = "\"texture " + std::string(name) + "\" is remapped as in pbrt-v4";
    if (!roughness || roughness->type != "float" || roughness->numbers.size() != 1) continue;
    double& value = roughness->numbers[0];
    if (value < 0 || (value == 0 && zero_is_smooth)) continue;
    const double alpha = v3_alpha(value);
    value = alpha * alpha;
    if (note.empty()) note = "\"roughness\" is converted";
  }
  return note;
}

void rename(Parameters& list, const char* from, const char* to) {
  Parameter* const found = v3::find(list, from);
  if (found && !v3::find(list, to)) found->name = to;
}

/// Renames "Kd" to "reflectance", or adds the grey default.
void rename_colour(Parameters& list, double fallback, const SourceLocation& where) {
  rename(list, "Kd", "reflectance");
  if (!v3::find(list, "reflectance"))
    v3::add(list, "rgb", "reflectance", where).numbers = {fallback, fallback, fallback};
}

/// reflectance = Kd reflect, transmittance = Kd transmit.
void upgrade_translucent(Parameters& list, const SourceLocation& where) {
  const auto colour = v3::take(list, "Kd");
  const auto reflect = v3::take(list, "reflect"), transmit = v3::take(list, "transmit");
  const auto factor = [](const std::optional<Parameter>& p) {
    return p ? v3::grey_value(*p) : std::optional<double>(0.5);
  };
  const std::optional<double> r = factor(reflect), t = factor(transmit);
  const bool is_number = !colour || colour->type == "rgb";
  if (!r || !t || (!is_number && *r != *t))
    no_equal(where, "translucent",
             "its \"reflect\" and \"transmit\" are not grey, or differ while \"Kd\" is not an rgb");
  for (const char* const name : {"reflectance", "transmittance"}) {
    Parameter part = colour ? *colour : Parameter();
    if (!colour) {
      part.type = "rgb";
      part.numbers = {0.25, 0.25, 0.25};
      part.where = where;
    }
    part.name = name;
    if (is_number)
      for (double& n : part.numbers) n *= name[0] == 'r' ? *r : *t;
    list.push_back(std::move(part));
  }
  if (!is_number) v3::add_float(list, "scale", *r, where);
}

/// pbrt-v4 names the second of the two first.
void upgrade_mix(Parameters& list, const SourceLocation& where) {
  const auto first = v3::take(list, "namedmaterial1"), second = v3::take(list, "namedmaterial2");
  if (!first || !second || first->strings.size() != 1 || second->strings.size() != 1)
    throw SceneError(where,
                     "material \"mix\" lacks one of pbrt-v3's \"namedmaterial1\" and "
                     "\"namedmaterial2\", expected \"string materials\" with two names");
  v3::add(list, "string", "materials", first->where).strings = {second->strings[0],
                                                                first->strings[0]};
  Parameter* const amount = v3::find(list, "amount");
  if (!amount || amount->type == "texture" || amount->type == "float") return;
  if (!v3::grey_value(*amount))
    throw SceneError(amount->where,
                     "\"amount\" of material \"mix\" has a colour, expected \"float amount\"");
  v3::make_float(*amount);
}

void upgrade_parameters(const std::string& type, Parameters& list, const SourceLocation& where) {
  if (type == "plastic" || type == "uber")
    rename_colour(list, 0.25, where);
  else if (type == "matte" || type == "kdsubsurface")
    rename_colour(list, 0.5, where);
  if (type == "plastic" || type == "uber" || type == "translucent")
    for (const char* const name : kOfHighlights) v3::take(list, name);
  if (type == "translucent") upgrade_translucent(list, where);
  if (type == "glass") rename(list, "index", "eta");
  if (type == "kdsubsurface") v3::add_float(list, "eta", 1.3, where);
  if (type == "metal") {
    const bool two = v3::find(list, "uroughness") && v3::find(list, "vroughness");
    if (!two) v3::add_float(list, "roughness", 0.01, where);
  }
  if (type != "mirror") return;
  if (Parameter* const colour = v3::find(list, "Kr")) {
    colour->name = "reflectance";
  } else {
    v3::add(list, "spectrum", "eta", where).strings = {"metal-Ag-eta"};
    v3::add(list, "spectrum", "k", where).strings = {"metal-Ag-k"};
  }
}

}  // namespace

void V3Upgrade::upgrade_material(DirectiveDescription& directive) {
  Parameters& list = directive.parameters.list;
  const SourceLocation& where = directive.where;
  Parameter* const parameter = directive.type.empty() ? v3::find(list, "type") : nullptr;
  const bool is_named = parameter && parameter->strings.size() == 1;
  const std::string type = is_named ? parameter->strings[0] : directive.type;
  if (type == "mix" && (v3::find(list, "namedmaterial1") || v3::find(list, "namedmaterial2"))) {
    note(where, "\"namedmaterial1\" and \"namedmaterial2\" are \"materials\"");
    upgrade_mix(list, where);
  }
  const MaterialRow* const row = find_row(type);
  if (row && !row->v4) no_equal(where, type, "pbrt-v4 has no counterpart");
  const bool dropped = drop_fixed(type, list, where);
  if (dropped && !row) note(where, "\"Kr\" and \"Kt\" of material \"" + type + "\" are 1");
  if (!row) return;
  upgrade_parameters(type, list, where);
  note(where, "Material \"" + type + "\" is \"" + row->v4 + "\"");
  if (type == "metal" || type == "glass" || type == "kdsubsurface") {
    const std::string remapped = remap_roughness(list, type != "metal");
    if (!remapped.empty()) note(where, remapped);
  }
  (is_named ? v3::find(list, "type")->strings[0] : directive.type) = row->v4;
}

}  // namespace nephroid
