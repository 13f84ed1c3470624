#include "input/obj/obj_scene.h"

#include <map>
#include <utility>

#include "input/mesh_directive.h"
#include "input/obj/mtl_library.h"
#include "input/obj/mtl_material.h"
#include "input/obj/obj_file.h"
#include "input/parameter_list.h"
#include "input/spelling.h"

namespace nephroid {
namespace {

constexpr double kClay = 0.6;  ///< reflectance of faces without a material

/// Undefined materials for which a name of the library is suggested.
constexpr int kMaxSuggestions = 20;

class ObjScene {
 public:
  ObjScene(const std::string& path, const ImportOptions& options, Diagnostics& diagnostics,
           std::shared_ptr<SceneFiles> files)
      : options_(options), diagnostics_(diagnostics) {
    scene_.file = path;
    scene_.files = files ? std::move(files) : files_of_scene(path);
  }

  SceneDescription read() {
    const ObjFile file = read_obj(*scene_.files, scene_.file, {}, diagnostics_);
    if (file.parts.empty())
      throw SceneError({std::make_shared<const std::string>(scene_.file), 0, 0},
                       "the file has no faces, expected lines such as \"f 1 2 3\"");
    library_ = read_mtl_libraries(*scene_.files, file, {"", options_.allow_outside}, diagnostics_);
    for (const ObjPart& part : file.parts) add_shape(part);
    return std::move(scene_);
  }

 private:
  /// What a material of the file gives to its shapes.
  struct OfShapes {
    MaterialReference material;
    std::optional<DirectiveDescription> area_light;
    std::optional<Parameter> alpha;
  };

  const OfShapes& material_of(const ObjPart& part);
  OfShapes convert(const MtlMaterial& mtl);
  OfShapes clay(const SourceLocation& where);
  void add_shape(const ObjPart& part);

  const ImportOptions& options_;
  Diagnostics& diagnostics_;
  SceneDescription scene_;
  std::map<std::string, MtlMaterial> library_;  ///< all materials of all MTL files
  std::map<std::string, OfShapes> used_;        ///< by their names in the file
  int undefined_ = 0;                           ///< materials that no MTL file has
};

ObjScene::OfShapes ObjScene::convert(const MtlMaterial& mtl) {
  ConvertedMaterial converted =
      convert_mtl(mtl, options_.solid_glass, &scene_.textures, diagnostics_);
  OfShapes of_shapes;
  of_shapes.material = {static_cast<int>(scene_.materials.size()), "", mtl.where};
  of_shapes.area_light = std::move(converted.area_light);
  of_shapes.alpha = std::move(converted.alpha);
  scene_.materials.push_back(std::move(converted.material));
  return of_shapes;
}

ObjScene::OfShapes ObjScene::clay(const SourceLocation& where) {
  ParameterList list(where);
  list.add_color("reflectance", {kClay, kClay, kClay});
  MaterialDescription material;
  static_cast<DirectiveDescription&>(material) = std::move(list).directive("diffuse");
  OfShapes of_shapes;
  of_shapes.material = {static_cast<int>(scene_.materials.size()), "", where};
  scene_.materials.push_back(std::move(material));
  return of_shapes;
}

const ObjScene::OfShapes& ObjScene::material_of(const ObjPart& part) {
  const auto used = used_.find(part.material);
  if (used != used_.end()) return used->second;
  const auto known = library_.find(part.material);
  if (known != library_.end())
    return used_.emplace(part.material, convert(known->second)).first->second;
  if (!part.material.empty()) {
    // If the library is the wrong one, suggestions do not help, and each takes a search of it.
    std::vector<std::string> names;
    if (++undefined_ <= kMaxSuggestions)
      for (const auto& entry : library_) names.push_back(entry.first);
    diagnostics_.warn(part.where, "material \"" + part.material + "\" is not defined" +
                                      did_you_mean(part.material, names) + "; its faces are grey");
  }
  return used_.emplace(part.material, clay(part.where)).first->second;
}

void ObjScene::add_shape(const ObjPart& part) {
  const OfShapes& of_shapes = material_of(part);
  ShapeDescription& shape = scene_.shapes.emplace_back();
  static_cast<DirectiveDescription&>(shape) = mesh_directive(part.mesh, part.where);
  if (of_shapes.alpha) shape.parameters.list.push_back(*of_shapes.alpha);
  shape.material = of_shapes.material;
  shape.area_light = of_shapes.area_light;
}

}  // namespace

SceneDescription read_obj_scene(const std::string& path, const ImportOptions& options,
                                Diagnostics& diagnostics, std::shared_ptr<SceneFiles> files) {
  return ObjScene(path, options, diagnostics, std::move(files)).read();
}

}  // namespace nephroid
