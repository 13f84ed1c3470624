// One material under construction: its JSON, its "principled" parameters, and how a factor and a
// texture become one parameter. It must not know which extensions exist.
#pragma once

#include <algorithm>
#include <optional>
#include <string>

#include "input/gltf/materials.h"

namespace nephroid::gltf {

inline constexpr Color kWhite = {1, 1, 1}, kBlack = {0, 0, 0};

inline double largest(const Color& c) {
  return std::max({c[0], c[1], c[2]});
}

/// A number of a material: a factor times the channel of an optional texture.
struct NumberInput {
  std::optional<JsonValue> texture;
  char channel = 'r';
  double factor = 1;
};

/// A colour of a material: a factor times an optional texture.
struct ColorInput {
  std::optional<JsonValue> texture;
  Color factor{1, 1, 1};
  bool times_vertex_color = false;

  bool is_constant() const { return !texture && !times_vertex_color; }
};

struct SurfaceInputs {
  Document& document;
  SceneDescription& scene;
  Textures& textures;
  std::optional<JsonValue> json;  ///< empty for the default material
  bool has_vertex_colors;
  ParameterList list;  ///< parameters of the material
  SurfaceDescription surface;
  ColorInput base;  ///< base colour, also the tint of transmission

  std::optional<JsonValue> extension(const std::string& name) const {
    return json ? json->extension(name) : std::nullopt;
  }
  const SourceLocation& where() const { return list.where(); }
  void warn(const SourceLocation& place, const std::string& message) const {
    document.diagnostics().warn(place, message);
  }

  /// The inputs of an object, by the names of its members.
  static NumberInput number(const JsonValue& owner, const std::string& factor, double fallback,
                            const std::string& texture, char channel);
  static ColorInput color(const JsonValue& owner, const std::string& factor, const Color& fallback,
                          const std::string& texture);

  /// Writes an input as the parameter `name`.
  void add(const std::string& name, const NumberInput& input);
  void add(const std::string& name, const ColorInput& input);
};

// Extensions of materials (material_extensions.cpp), one function each. They write nothing if the
// material has no such extension.
void add_transmission(SurfaceInputs& inputs);
void add_diffuse_transmission(SurfaceInputs& inputs);
void add_specular(SurfaceInputs& inputs);
/// Writes the index and the weight of a dielectric with this reflectance along the normal.
void add_reflectance(SurfaceInputs& inputs, double reflectance, NumberInput weight);
void add_clearcoat(SurfaceInputs& inputs);
void add_sheen(SurfaceInputs& inputs);
void add_anisotropy(SurfaceInputs& inputs, const NumberInput& roughness);
void add_iridescence(SurfaceInputs& inputs);

}  // namespace nephroid::gltf
