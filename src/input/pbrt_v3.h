// Upgrades pbrt-v3's names in a scene to pbrt-v4, like `pbrt --upgrade`, where the meaning is the
// same. A name without an equal is a SceneError with the replacement. The table is in pbrt_v3.cpp;
// materials are in pbrt_v3_materials.cpp.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "input/scene_description.h"

namespace nephroid {

class V3Upgrade {
 public:
  /// Changes parameters of type "color" to "rgb".
  void upgrade_colours(std::vector<Parameter>& list);
  /// Upgrades a directive in place; `name` is its name, such as "Shape". A MakeNamedMaterial has
  /// its type in the parameter "string type". Throws SceneError.
  void upgrade(std::string_view name, DirectiveDescription& directive);
  /// Upgrades parts that depend on the value type of a texture, "float" or "spectrum".
  void upgrade_texture(const std::string& values, DirectiveDescription& directive);
  /// The upgraded value type of a texture: "color" becomes "spectrum".
  std::string texture_values(const std::string& type, const SourceLocation& where);
  /// The upgraded name of a directive: SurfaceIntegrator becomes Integrator.
  std::string_view directive_name(std::string_view name, const SourceLocation& where);
  /// Notes one upgrade; `what` is a text such as "Film \"image\" is \"rgb\"".
  void note(const SourceLocation& where, const std::string& what);

  /// Gives one warning at the first upgrade with a list of all; none without upgrades.
  void report(Diagnostics& diagnostics) const;

 private:
  void upgrade_types(std::string_view name, DirectiveDescription& directive);
  void upgrade_material(DirectiveDescription& directive);

  std::optional<SourceLocation> first_;
  std::vector<std::string> upgrades_;  ///< upgrades, each once, in the order of the file
};

/// Functions that edit a list of parameters; shared by the two files of the upgrade.
namespace v3 {

using Parameters = std::vector<Parameter>;

Parameter* find(Parameters& list, std::string_view name);
/// Removes a parameter from the list and returns it.
std::optional<Parameter> take(Parameters& list, std::string_view name);
/// Adds a parameter with a location, unless the name exists already.
Parameter& add(Parameters& list, const std::string& type, const std::string& name,
               const SourceLocation& where);
void add_float(Parameters& list, const std::string& name, double value,
               const SourceLocation& where);
/// The single value of a float, of an rgb with equal components or of a flat spectrum.
std::optional<double> grey_value(const Parameter& parameter);
/// Makes a parameter with a grey value a float; other parameters stay as they are.
void make_float(Parameter& parameter);

}  // namespace v3

}  // namespace nephroid
