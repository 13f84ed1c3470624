// Turns pbrt-v4 directives, one call each, into a SceneDescription. Keeps the graphics state and
// its stack, and refuses what pbrt-v4 refuses. It must not know the syntax, or the meaning of types
// of shapes, materials or lights.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "input/graphics_state.h"
#include "input/scene_description.h"

namespace nephroid {

/// All functions with a SourceLocation throw SceneError there if the directive is wrong.
class DescriptionBuilder {
 public:
  DescriptionBuilder(SceneDescription& scene, Diagnostics& diagnostics)
      : scene_(scene), diagnostics_(diagnostics) {}

  bool in_world() const { return in_world_; }
  const std::string& color_space() const { return state_.color_space; }

  // Transforms: `m` is applied first, then the current transform (m * ctm).
  void concat_transform(const Mat44d& m, const char* directive, const SourceLocation& where);
  /// The same for the matrix of LookAt, whose up tells that of the world to a camera that follows.
  void look_at(const Mat44d& m, const Vec3d& up, const SourceLocation& where);
  void set_transform(const Mat44d& m, const SourceLocation& where);
  void set_active_transforms(bool start, bool end);
  void set_transform_times(double start, double end, const SourceLocation& where);
  void name_coordinate_system(const std::string& name);
  /// An unknown name is a warning only, as in pbrt-v4.
  void use_coordinate_system(const std::string& name, const SourceLocation& where);

  // The graphics state and its scopes.
  void attribute_begin(const SourceLocation& where);
  void attribute_end(const SourceLocation& where);
  void set_defaults(const std::string& target, std::vector<Parameter> parameters,
                    const SourceLocation& target_where);
  void set_color_space(const std::string& name, const SourceLocation& name_where);
  void reverse_orientation() { state_.reverse_orientation = !state_.reverse_orientation; }
  void set_medium_interface(std::string inside, std::string outside);
  void world_begin();
  void object_begin(const std::string& name, const SourceLocation& where);
  void object_end(const SourceLocation& where);
  void object_instance(const std::string& name, const SourceLocation& where);
  /// Enclose an imported file: its changes to the graphics state and the coordinate systems are
  /// undone, and it must close the scopes it opens.
  void import_begin(const SourceLocation& where);
  void import_end();

  // Objects of the scene. A directive has its explicit parameters; defaults are added here.
  /// "keepcamera" is obeyed here: it says which directives count, and is no option of the scene.
  void add_option(Parameter option);
  void set_camera(DirectiveDescription directive);
  void set_film(DirectiveDescription directive);
  void set_sampler(DirectiveDescription d) { set_once(scene_.sampler, std::move(d), "Sampler"); }
  void set_pixel_filter(DirectiveDescription d) {
    set_once(scene_.pixel_filter, std::move(d), "PixelFilter");
  }
  void set_integrator(DirectiveDescription d) {
    set_once(scene_.integrator, std::move(d), "Integrator");
  }
  void set_accelerator(DirectiveDescription d) {
    set_once(scene_.accelerator, std::move(d), "Accelerator");
  }
  void add_material(DirectiveDescription directive);
  void use_named_material(const std::string& name, const SourceLocation& where);
  /// The type comes from the parameter "string type".
  void add_named_material(const std::string& name, DirectiveDescription directive);
  void add_medium(const std::string& name, DirectiveDescription directive);
  void add_texture(const std::string& name, const std::string& value_type,
                   DirectiveDescription directive);
  void add_light(DirectiveDescription directive);
  void set_area_light(DirectiveDescription directive);
  void add_shape(DirectiveDescription directive);

  /// Called at the end of all files: all scopes must be closed and all used names defined.
  void finish(const SourceLocation& end_of_file) const;

 private:
  struct Scope {
    enum class Kind { kAttribute, kObject, kImport };
    Kind kind;
    SourceLocation where;
    GraphicsState state;
    std::map<std::string, TransformDescription> coordinate_systems;  // saved by imports only
  };
  using Names = std::map<std::string, SourceLocation>;

  void set_once(std::optional<DirectiveDescription>& slot, DirectiveDescription directive,
                const char* name);
  void add_defaults(AttributeTarget target, ParameterSet& parameters) const;
  void keep_camera(const Parameter& option);
  void push_scope(Scope::Kind kind, const SourceLocation& where);
  void pop_scope();
  void check_nothing_open(size_t scopes) const;
  MaterialReference material_of(const SourceLocation& shape_where);

  SceneDescription& scene_;
  Diagnostics& diagnostics_;
  bool in_world_ = false;
  bool keeps_camera_ = false;  // true: the first Camera and the first Film count
  GraphicsState state_;
  std::vector<Scope> scopes_;
  std::map<std::string, TransformDescription> coordinate_systems_;
  Names material_names_, medium_names_, float_texture_names_, spectrum_texture_names_;
  ObjectDescription* object_ = nullptr;  // the object being defined
  bool warned_of_area_light_ = false;    // true after the warning in that object
  int default_material_ = -1;
};

}  // namespace nephroid
