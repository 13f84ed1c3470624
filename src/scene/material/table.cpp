// The table of material types, and the one loop that makes all materials of a scene; see table.h.
#include "scene/material/table.h"

#include "scene/material/forced_diffuse.h"
#include "scene/material/measured_file.h"

namespace nephroid {
namespace {

constexpr MaterialRow kTable[] = {
    {"diffuse", make_diffuse},
    {"diffusetransmission", make_diffuse_transmission},
    {"dielectric", make_dielectric},
    {"thindielectric", make_thin_dielectric},
    {"conductor", make_conductor},
    {"coateddiffuse", make_coated_diffuse},
    {"coatedconductor", make_coated_conductor},
    {"subsurface", make_subsurface},
    {"hair", make_hair},
    {"measured", make_measured},
    {"mix", make_mix},
    {"interface", make_interface},
    {"none", make_interface},
    {"", make_interface},
};

/// Makes materials in any order: a mix asks for others that may stand later in the file.
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
        description_.directory,
        index,
        [this](const std::string& name, const SourceLocation& where) { return find(name, where); },
        &coat_tables_,
        &bssrdf_tables_,
        &measured_files_};
    d.parameters.find("type");  // the type of a named material is written as a parameter
    materials_[index] = row(d).make(d, context);
    if (settings_.force_diffuse && d.type != "mix" && !materials_[index]->is_interface())
      materials_[index] = force_diffuse(materials_[index]);
    d.parameters.report_unused("material \"" + d.type + "\"", diagnostics_);
    state_[index] = State::kDone;
    return materials_[index];
  }

  MaterialPtr find(const std::string& name, const SourceLocation& where) {
    const auto found = by_name_.find(name);
    if (found == by_name_.end())
      throw SceneError(where, "there is no material named \"" + name +
                                  "\", expected the name of a MakeNamedMaterial");
    return make(found->second);
  }

  static const MaterialRow& row(const MaterialDescription& d) {
    std::string known;
    for (const MaterialRow& r : kTable) {
      if (d.type == r.name) return r;
      if (*r.name) known += (known.empty() ? "" : ", ") + std::string(r.name);
    }
    throw SceneError(d.where, "unknown material \"" + d.type + "\", expected one of " + known);
  }

  const SceneDescription& description_;
  const TextureLibrary& textures_;
  MaterialSettings settings_;
  Diagnostics& diagnostics_;
  std::vector<MaterialPtr> materials_;
  std::vector<State> state_;
  std::map<std::string, size_t> by_name_;
  CoatTableCache coat_tables_;
  BssrdfTableCache bssrdf_tables_;
  MeasuredCache measured_files_;
};

}  // namespace

std::span<const MaterialRow> material_table() {
  return kTable;
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
