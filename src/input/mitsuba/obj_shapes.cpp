// Meshes of OBJ files. Their parts may have BSDFs of their own and, in Mitsuba 0.6, MTL materials.
#include <algorithm>
#include <filesystem>
#include <map>
#include <utility>

#include "input/mitsuba/bsdf_plugins.h"
#include "input/mitsuba/mesh_shapes.h"
#include "input/mitsuba/shape_geometry.h"
#include "input/mitsuba/value_text.h"
#include "input/obj/mtl_library.h"
#include "input/obj/mtl_material.h"

namespace nephroid::mitsuba {
namespace {

/// Gives the textures names that are free in the scene, where they are used, too.
void rename(ImportContext& context, std::vector<TextureDescription>& textures,
            std::vector<Parameter*> users) {
  std::map<std::string, std::string> names;
  for (TextureDescription& t : textures) {
    const std::string old = t.name;
    t.name = names[old] = context.unique_name(old);
    for (Parameter& parameter : t.parameters.list) users.push_back(&parameter);
  }
  for (Parameter* user : users)
    for (std::string& text : user->strings)
      if (user->type == "texture" && names.contains(text)) text = names[text];
}

Surface mtl_surface(ImportContext& context, const MtlMaterial& mtl) {
  std::vector<TextureDescription> textures;
  ConvertedMaterial c = convert_mtl(mtl, false, &textures, context.diagnostics);
  std::vector<Parameter*> users;
  for (Parameter& parameter : c.material.parameters.list) users.push_back(&parameter);
  if (c.alpha) users.push_back(&*c.alpha);
  rename(context, textures, users);
  context.scene.textures.insert(context.scene.textures.end(), textures.begin(), textures.end());
  c.material.name = context.unique_name(mtl.name.empty() ? "mtl" : mtl.name);
  Surface surface{c.material.name, c.alpha, true};
  context.scene.materials.push_back(std::move(c.material));
  return surface;
}

bool has_part_of(const ObjFile& file, const std::string& material) {
  return std::any_of(file.parts.begin(), file.parts.end(),
                     [&](const ObjPart& part) { return snake_case(part.material) == material; });
}

/// The surfaces of parts by their materials, whose names are compared in the style of Mitsuba 3.
using PartSurfaces = std::map<std::string, Surface>;

/// BSDFs that have the name of a material in the file.
PartSurfaces named_surfaces(PluginProperties& p, const ObjFile& file, Geometry& geometry) {
  PartSurfaces surfaces;
  for (const Child* child : p.children("bsdf")) {
    if (child->name.empty() || !has_part_of(file, child->name)) continue;
    surfaces[child->name] = write_bsdf(p.context(), *child->object);
    geometry.of_parts.push_back(child);
  }
  return surfaces;
}

/// The materials of the MTL files; none, with a warning, if one of these is wrong.
std::map<std::string, MtlMaterial> mtl_materials(PluginProperties& p, const ObjFile& file) {
  ImportContext& context = p.context();
  const std::string folder = std::filesystem::path(p.file()).parent_path().string();
  try {
    return read_mtl_libraries(*context.scene.files, file,
                              {folder, context.file_names.allow_outside()}, context.diagnostics);
  } catch (const SceneError& error) {
    warn_approximated(p, std::string("its MTL materials are ignored (") + error.what() + ")");
    return {};
  }
}

/// MTL materials, which Mitsuba 0.6 uses where a scene gives no BSDF.
PartSurfaces mtl_surfaces(PluginProperties& p, const ObjFile& file) {
  PartSurfaces surfaces;
  const bool loads = p.boolean("load_materials", true);
  if (!loads || !p.context().is_before_version_2() || !p.children("bsdf").empty()) return surfaces;
  for (const auto& entry : mtl_materials(p, file)) {
    const std::string name = snake_case(entry.first);
    if (has_part_of(file, name) && !surfaces.contains(name))
      surfaces[name] = mtl_surface(p.context(), entry.second);
  }
  return surfaces;
}

MeshData with_uvs_of_mitsuba(PluginProperties& p, MeshData mesh) {
  // The reader has v = 0 at the lower edge; so has Mitsuba's with "flip_tex_coords".
  if (!p.boolean("flip_tex_coords", true)) turn_v_over(mesh);
  return mesh;
}

}  // namespace

Geometry obj_geometry(PluginProperties& p) {
  SceneFiles& files = *p.context().scene.files;
  const std::string path = files.path_of(p.file());
  const ObjFile file = read_obj(files, path, p.find("filename")->where, p.context().diagnostics);
  if (p.has("shape_index"))
    warn_approximated(p, "\"shape_index\" is ignored, all meshes of the file are loaded");
  const bool collapse = p.boolean("collapse", false);
  Geometry all;
  PartSurfaces surfaces = named_surfaces(p, file, all);
  if (surfaces.empty()) surfaces = mtl_surfaces(p, file);
  Geometry joined = mesh_geometry(p, with_uvs_of_mitsuba(p, joined_mesh(file)), false);
  if (surfaces.empty() || collapse) return joined;
  all.is_open = joined.is_open;
  for (const ObjPart& part : file.parts) {
    Geometry one = mesh_geometry(p, with_uvs_of_mitsuba(p, part.mesh), false);
    all.shapes.push_back(std::move(one.shapes[0]));
    const auto found = surfaces.find(snake_case(part.material));
    all.surfaces.push_back(found == surfaces.end() ? std::nullopt : std::optional(found->second));
  }
  return all;
}

}  // namespace nephroid::mitsuba
