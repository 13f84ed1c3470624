// Materials: metallic-roughness and its extensions become Material "principled", with the opacity,
// emission and interior that shapes of the material get. It must not know meshes.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>

#include "input/gltf/textures.h"

namespace nephroid::gltf {

/// Everything that a shape of a material needs besides its geometry.
struct SurfaceDescription {
  MaterialReference material;
  ParameterList shape_parameters{SourceLocation{}};  ///< "alpha", if the surface is not opaque
  std::optional<DirectiveDescription> area_light;    ///< empty if it does not emit
  std::string interior;                              ///< medium inside; empty for none
  UvSets uv_sets;
  bool uses_vertex_colors = false;
  bool emits_vertex_colors = false;  ///< their mean over the shape is a factor of the emission
  bool needs_tangents = false;
  double tangent_rotation = 0;  ///< angle from the tangents to the direction of anisotropy, rad
};

class Materials {
 public:
  Materials(Document& document, SceneDescription& scene)
      : document_(document), scene_(scene), textures_(document, scene) {}

  /// The surface of a primitive: of its "material" (or that of the chosen variant), for meshes with
  /// or without vertex colours. `primitive` is where an index out of range is reported.
  const SurfaceDescription& surface_of(const JsonValue& primitive, bool has_vertex_colors);

 private:
  std::optional<size_t> material_index(const JsonValue& primitive);
  std::optional<size_t> chosen_variant();
  SurfaceDescription make(const std::optional<JsonValue>& material, bool has_vertex_colors);
  std::string unique_name(const std::optional<JsonValue>& material);

  Document& document_;
  SceneDescription& scene_;
  Textures textures_;
  /// By material (-1: the default one) and whether there are vertex colours.
  std::map<std::pair<int64_t, bool>, SurfaceDescription> known_;
  std::map<std::string, int> names_;
};

}  // namespace nephroid::gltf
