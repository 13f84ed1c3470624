// Names of pbrt-v3 in a scene, upgraded to pbrt-v4 as `pbrt --upgrade` does where the meaning is
// the same. A name without an equal in pbrt-v4 is a SceneError, which says what to write instead.
// The table is in pbrt_v3.cpp; materials, which need arithmetic, are in pbrt_v3_materials.cpp.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "input/scene_description.h"

namespace nephroid {

class V3Upgrade {
 public:
  /// Parameters of type "color" are "rgb".
  void upgrade_colours(std::vector<Parameter>& list);
  /// Upgrades a directive in place: `name` is the directive's, "Shape" for example. A
  /// MakeNamedMaterial has its type in the parameter "string type". Throws SceneError.
  void upgrade(std::string_view name, DirectiveDescription& directive);
  /// The same for what depends on the values of a texture, "float" or "spectrum".
  void upgrade_texture(const std::string& values, DirectiveDescription& directive);
  /// The value type of a texture: "color" is "spectrum".
  std::string texture_values(const std::string& type, const SourceLocation& where);
  /// The name of a directive: SurfaceIntegrator is Integrator.
  std::string_view directive_name(std::string_view name, const SourceLocation& where);
  /// Notes one upgrade: `what` reads "Film \"image\" is \"rgb\"".
  void note(const SourceLocation& where, const std::string& what);

  /// One warning at the first place, with all that was upgraded; none if nothing was.
  void report(Diagnostics& diagnostics) const;

 private:
  void upgrade_types(std::string_view name, DirectiveDescription& directive);
  void upgrade_material(DirectiveDescription& directive);

  std::optional<SourceLocation> first_;
  std::vector<std::string> upgrades_;  ///< each once, in the order of the file
};

/// Editing a list of parameters; shared by the two files of the upgrade.
namespace v3 {

using Parameters = std::vector<Parameter>;

Parameter* find(Parameters& list, std::string_view name);
/// Takes a parameter out of the list.
std::optional<Parameter> take(Parameters& list, std::string_view name);
/// Adds a parameter at a place, unless one of that name is there.
Parameter& add(Parameters& list, const std::string& type, const std::string& name,
               const SourceLocation& where);
void add_float(Parameters& list, const std::string& name, double value,
               const SourceLocation& where);
/// The one value of a float, of an rgb of equal components or of a flat spectrum.
std::optional<double> grey_value(const Parameter& parameter);
/// The same value as a float; other parameters stay as they are.
void make_float(Parameter& parameter);

}  // namespace v3

}  // namespace nephroid
