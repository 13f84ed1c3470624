// The table of material types, and the loop that makes all materials of a scene; see table.h.
#include "scene/material/table.h"

#include "scene/material/forced_diffuse.h"
#include "scene/material/measured_file.h"

namespace nephroid {
namespace {

constexpr FormatParameter kSurface[] = {
    {"float or texture", "displacement", "none", "scene units",
     "bumps; not together with \"normalmap\", which wins with a warning"},
    {"string", "normalmap", "none", "", "an image file"},
    {"float", "normalmap.scale", "1", "", "of the first two components; not in pbrt-v4"},
    {"bool", "normalmap.handedness", "false", "",
     "mirrored texture coordinates mirror the map; not in pbrt-v4"},
    {"string", "normalmap.uwrap", "repeat", "", "not in pbrt-v4"},
    {"string", "normalmap.vwrap", "repeat", "", "not in pbrt-v4"},
    {"integer", "normalmap.uvset", "0", "", "as of textures; not in pbrt-v4"},
    {"float[6]", "normalmap.uvtransform", "1 0 0 0 1 0", "", "as of textures; not in pbrt-v4"},
};
constexpr FormatParameter kRoughness[] = {
    {"float or texture", "roughness", "0"},
    {"float or texture", "uroughness", "roughness"},
    {"float or texture", "vroughness", "roughness"},
    {"bool", "remaproughness", "true", "", "false: roughness is the microfacet alpha itself"},
};
constexpr FormatParameter kIndex[] = {
    {"float or spectrum", "eta", "1.5", "",
     "refractive index; of one that varies with the wavelength only the hero wavelength is kept"},
};
constexpr FormatParameter kThinIndex[] = {{"float or spectrum", "eta", "1.5"}};
constexpr FormatParameter kDiffuse[] = {{"spectrum or texture", "reflectance", "0.5"}};
constexpr FormatParameter kDiffuseTransmission[] = {
    {"spectrum or texture", "reflectance", "0.25"},
    {"spectrum or texture", "transmittance", "0.25"},
    {"float", "scale", "1", "", "of both"},
};
constexpr FormatParameter kConductor[] = {
    {"spectrum or texture", "eta", "metal-Cu-eta"},
    {"spectrum or texture", "k", "metal-Cu-k"},
    {"spectrum or texture", "reflectance", "none", "",
     "instead of eta and k; together with them an error"},
};
constexpr FormatParameter kBetween[] = {
    {"spectrum or texture", "albedo", "0", "", "of the medium between the two boundaries"},
    {"float or texture", "g", "0", "", "mean cosine of scattering in that medium"},
    {"integer", "maxdepth", "10", "", "events of a walk between the boundaries; at least 1"},
    {"integer", "nsamples", "1", "", "walks per evaluation; at least 1"},
};
constexpr FormatParameter kCoatedDiffuse[] = {
    {"spectrum or texture", "reflectance", "0.5"},
    {"float or texture", "thickness", "0.01", "mean free paths of the medium"},
};
constexpr FormatParameter kCoatedConductor[] = {
    {"float or texture", "interface.roughness", "0"},
    {"float or texture", "interface.uroughness", "interface.roughness"},
    {"float or texture", "interface.vroughness", "interface.roughness"},
    {"float or spectrum", "interface.eta", "1.5"},
    {"float or texture", "thickness", "0.01", "mean free paths of the medium"},
    {"float or texture", "interface.thickness", "thickness", "",
     "another name of thickness; not in pbrt-v4"},
    {"float or texture", "conductor.roughness", "0"},
    {"float or texture", "conductor.uroughness", "conductor.roughness"},
    {"float or texture", "conductor.vroughness", "conductor.roughness"},
    {"spectrum or texture", "conductor.eta", "metal-Cu-eta"},
    {"spectrum or texture", "conductor.k", "metal-Cu-k"},
    {"spectrum or texture", "reflectance", "none", "",
     "of the metal, instead of conductor.eta and conductor.k; together with them an error"},
    {"bool", "remaproughness", "true"},
};
constexpr FormatParameter kSubsurface[] = {
    {"string", "name", "none", "",
     "a measured medium (\"Skin1\", \"Whole Milk\" ...); wins over all other ways"},
    {"spectrum or texture", "sigma_a", "0.0011 0.0024 0.014", "1/scene unit",
     "absorption; the defaults are those of milk per mm; one of sigma_a and sigma_s without the "
     "other is an error"},
    {"spectrum or texture", "sigma_s", "2.55 3.21 3.77", "1/scene unit", "scattering"},
    {"spectrum or texture", "reflectance", "none", "", "the colour seen, if there is no sigma_a"},
    {"spectrum or texture", "mfp", "1", "scene units", "mean free path that goes with reflectance"},
    {"float", "scale", "1", "", "of sigma_a and sigma_s, or of mfp"},
    {"float", "g", "0", "",
     "mean cosine, between -1 and 1, else an error; with \"name\" ignored with a warning"},
    {"float", "eta", "1.33", "", "between 0.4 and 2.5, else an error"},
};
constexpr FormatParameter kPrincipledBase[] = {
    {"float or texture", "base_weight", "1"},
    {"spectrum or texture", "base_color", "0.8", "",
     "of the diffuse base, and of metal along the normal"},
    {"float or texture", "base_metalness", "0"},
    {"float or texture", "base_diffuse_roughness", "0", "", "Oren-Nayar; 0 is Lambertian"},
    {"float or texture", "specular_weight", "1", "", "of the reflectance along the normal"},
    {"spectrum or texture", "specular_color", "1", "",
     "of the boundary's reflection outside; of metal at grazing angles (F82)"},
    {"float or texture", "specular_roughness", "0.3", "", "alpha is its square"},
    {"float or texture", "specular_roughness_anisotropy", "0", "", "along dpdu"},
    {"bool", "remaproughness", "true", "",
     "false: specular_roughness and coat_roughness are microfacet alphas themselves"},
    {"float or texture", "specular_ior", "1.5", "", "0.1 to 10"},
    {"bool", "geometry_thin_walled", "false", "",
     "the surface is a wall with air on both sides, which bends no light"},
};
constexpr FormatParameter kPrincipledBelow[] = {
    {"float or texture", "transmission_weight", "0"},
    {"spectrum or texture", "transmission_color", "1", "", "tints light at every crossing"},
    {"float", "transmission_dispersion_abbe_number", "0", "",
     "0: none; else only the hero wavelength is kept where light is bent"},
    {"float or texture", "diffuse_transmission_weight", "0"},
    {"spectrum or texture", "diffuse_transmission_color", "1"},
    {"float or texture", "subsurface_weight", "0"},
    {"spectrum or texture", "subsurface_color", "0.8", "", "the colour seen"},
    {"float or texture", "subsurface_radius", "1", "scene units",
     "mean free path; with 0 light leaves where it enters, as from the diffuse base"},
    {"spectrum or texture", "subsurface_radius_scale", "1 0.5 0.25", "", "of the radius"},
    {"float", "subsurface_scatter_anisotropy", "0", "", "mean cosine"},
};
constexpr FormatParameter kPrincipledAbove[] = {
    {"float or texture", "fuzz_weight", "0"},
    {"spectrum or texture", "fuzz_color", "1"},
    {"float or texture", "fuzz_roughness", "0.5"},
    {"float or texture", "coat_weight", "0"},
    {"spectrum or texture", "coat_color", "1", "", "of light that passes twice along the normal"},
    {"float or texture", "coat_roughness", "0"},
    {"float or texture", "coat_roughness_anisotropy", "0"},
    {"float or texture", "coat_ior", "1.6", "", "1 to 10"},
    {"float or texture", "coat_darkening", "1", "",
     "share of the darkening by reflection between coat and base"},
    {"bool", "coat_affects_specular", "true", "",
     "false: below the coat the base's reflectance and roughness are those in air, as in glTF; not "
     "in OpenPBR"},
    {"float or texture", "thin_film_weight", "0"},
    {"float or texture", "thin_film_thickness", "0.5", "micrometres"},
    {"float or texture", "thin_film_ior", "1.4", "", "0.1 to 10"},
};
constexpr FormatParameter kHair[] = {
    {"spectrum or texture", "sigma_a", "that of eumelanin 1.3", "1/radius",
     "the first of sigma_a, reflectance (color) and the pigments counts, the others are ignored "
     "with a warning"},
    {"spectrum or texture", "reflectance", "none", "", "the colour of a mass of hair"},
    {"spectrum or texture", "color", "none", "", "another name of reflectance"},
    {"float or texture", "eumelanin", "0"},
    {"float or texture", "pheomelanin", "0"},
    {"float or texture", "eta", "1.55"},
    {"float or texture", "beta_m", "0.3", "", "0 to 1, a number outside is an error"},
    {"float or texture", "beta_n", "0.3", "", "0 to 1, a number outside is an error"},
    {"float or texture", "alpha", "2", "degrees", "tilt of the scales"},
};
constexpr FormatParameter kMeasured[] = {
    {"string", "filename", "none: an error", "", "an RGL .bsdf file"},
};
constexpr FormatParameter kMix[] = {
    {"string", "materials", "none: an error", "", "two names"},
    {"float or texture", "amount", "0.5", "", "share of the second"},
};

constexpr const char* kByRoughness =
    "S where alpha is at or below specular-alpha (docs/options.md), else G";

constexpr MaterialRow kTable[] = {
    {{"diffuse", {kDiffuse, kSurface}, "D"}, make_diffuse},
    {{"diffusetransmission", {kDiffuseTransmission, kSurface}, "D"}, make_diffuse_transmission},
    {{"dielectric", {kIndex, kRoughness, kSurface}, kByRoughness}, make_dielectric},
    {{"thindielectric",
      {kThinIndex, kSurface},
      "reflection S; transmission goes straight on and has no letter"},
     make_thin_dielectric},
    {{"conductor", {kConductor, kRoughness, kSurface}, kByRoughness}, make_conductor},
    {{"coateddiffuse",
      {kCoatedDiffuse, kIndex, kRoughness, kBetween, kSurface},
      "reflection by the coat alone: S or G by the coat's roughness; the rest D"},
     make_coated_diffuse},
    {{"coatedconductor",
      {kCoatedConductor, kBetween, kSurface},
      "reflection by the coat alone: S or G by the coat's roughness; the rest S if coat and metal "
      "are both S, else G; D if a medium scatters between them"},
     make_coated_conductor},
    {{"subsurface",
      {kSubsurface, kRoughness, kSurface},
      "boundary S or G by roughness; light that goes below is one D event of transmission, and "
      "photons merge where it comes out. A tabulated profile as in pbrt-v4 (ADR 7); below a mix "
      "light comes out where the mix shows this material"},
     make_subsurface},
    {{"principled",
      {kPrincipledBase, kPrincipledBelow, kPrincipledAbove, kSurface},
      "not of pbrt-v4: the terms of OpenPBR 1.1. Fuzz, diffuse and subsurface lobes D; coat and "
      "base S or G, each by its roughness; smooth thin walls transmit straight on, which has no "
      "letter"},
     make_principled},
    {{"hair", {kHair}, "H; paths that meet hair are left to routes of path (docs/routes.md)"},
     make_hair},
    {{"measured", {kMeasured, kSurface}, "G"}, make_measured},
    {{"mix", {kMix}, "the letter of the material chosen at the point"}, make_mix},
    {{"interface", {}, "nothing but a boundary of media; no letter"}, make_interface},
    {{"none", {}, "the same as interface"}, make_interface},
    {{"", {}, "the same as interface"}, make_interface},
};

/// Makes materials in any order: a mix can name materials that come later in the file.
class Maker {
 public:
  Maker(const SceneDescription& description, const TextureLibrary& textures,
        const MaterialSettings& settings, Diagnostics& diagnostics)
      : description_(description),
        textures_(textures),
        settings_(settings),
        diagnostics_(diagnostics),
        materials_(description.materials.size()),
        state_(description.materials.size(), State::kToDo) {
    for (size_t i = 0; i < description.materials.size(); ++i)
      if (!description.materials[i].name.empty()) by_name_[description.materials[i].name] = i;
  }

  std::vector<MaterialPtr> make_all() {
    for (size_t i = 0; i < materials_.size(); ++i) make(i);
    return std::move(materials_);
  }

 private:
  enum class State { kToDo, kBeingMade, kDone };

  const MaterialPtr& make(size_t index) {
    const MaterialDescription& d = description_.materials[index];
    if (state_[index] == State::kDone) return materials_[index];
    if (state_[index] == State::kBeingMade)
      throw SceneError(d.where, "material \"" + d.name +
                                    "\" is mixed from itself, expected materials that do not "
                                    "lead back to it");
    state_[index] = State::kBeingMade;
    const MaterialContext context{
        textures_,
        settings_,
        diagnostics_,
        *description_.files,
        index,
        [this](const std::string& name, const SourceLocation& where) { return find(name, where); },
        &coat_tables_,
        &bssrdf_tables_,
        &measured_files_,
        &principled_tables_};
    const MaterialRow& row = row_of(kTable, "material", d.type, d.where);
    ++being_made_;
    NewMaterial material = row.make(d, context);
    --being_made_;
    if (settings_.force_diffuse && d.type != "mix" && !material->is_interface())
      material = force_diffuse(material);
    material->set_index(static_cast<int>(index));
    materials_[index] = material;
    d.parameters.report_unused("material \"" + d.type + "\"", row, diagnostics_);
    state_[index] = State::kDone;
    return materials_[index];
  }

  MaterialPtr find(const std::string& name, const SourceLocation& where) {
    const auto found = by_name_.find(name);
    if (found == by_name_.end())
      throw SceneError(where, "there is no material named \"" + name +
                                  "\", expected the name of a MakeNamedMaterial");
    // A mix can name a material that has not been made yet.
    if (being_made_ > kDeepestMixture && state_[found->second] == State::kToDo)
      refuse_deep_mixture(where);
    return make(found->second);
  }

  const SceneDescription& description_;
  const TextureLibrary& textures_;
  MaterialSettings settings_;
  Diagnostics& diagnostics_;
  std::vector<MaterialPtr> materials_;
  std::vector<State> state_;
  int being_made_ = 0;  ///< nesting depth of materials under construction
  std::map<std::string, size_t> by_name_;
  CoatTableCache coat_tables_;
  BssrdfTableCache bssrdf_tables_;
  MeasuredCache measured_files_;
  PrincipledTableCache principled_tables_;
};

}  // namespace

std::span<const MaterialRow> material_table() {
  return kTable;
}

std::vector<FormatType> material_types() {
  return format_types(kTable);
}

std::shared_ptr<const CoatTable> CoatTableCache::find_or_make(const DielectricInterface& boundary,
                                                              float thickness, int max_depth) {
  const float alpha = boundary.smooth() ? 0.0f : boundary.facets.alpha_x();
  auto& table = tables_[{boundary.eta, alpha, thickness, max_depth}];
  if (!table) table = std::make_shared<CoatTable>(boundary, thickness, max_depth);
  return table;
}

std::vector<MaterialPtr> make_materials(const SceneDescription& description,
                                        const TextureLibrary& textures,
                                        const MaterialSettings& settings,
                                        Diagnostics& diagnostics) {
  return Maker(description, textures, settings, diagnostics).make_all();
}

}  // namespace nephroid
