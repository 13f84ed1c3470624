// What a scene file said, as plain structs: nothing is interpreted, nothing is looked up, every
// value remembers where it stood. Written by the parsers of this folder, read by scene/. It must
// not know what any type of shape, material or light means.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/errors.h"
#include "core/math.h"
#include "input/scene_files.h"

namespace nephroid {

struct FormatType;

/// One parameter, for instance "rgb reflectance" [ .5 .5 .5 ]. Exactly one of the vectors is used:
/// numbers for float, integer, point*, vector*, normal*, rgb, blackbody and numeric spectra;
/// strings for string, texture, spectrum names and spectrum files; bools for bool.
struct Parameter {
  std::string type;  ///< as written, with pbrt's synonyms folded ("point" -> "point3" ...)
  std::string name;
  std::vector<double> numbers;
  std::vector<std::string> strings;
  std::vector<bool> bools;
  std::string color_space = "srgb";  ///< in force where the parameter stood
  SourceLocation where;
  mutable bool used = false;  ///< set by the getters; what nobody asked for is reported
};

/// The parameters of one directive. The getters check type and count, throw a located SceneError on
/// a mismatch, and return the default (or an empty optional / vector) if the name is absent.
class ParameterSet {
 public:
  std::vector<Parameter> list;
  SourceLocation where;  ///< of the directive
  /// If set, the getters write down what they are asked for: tests hold the tables of the format
  /// against that.
  std::set<std::string>* asked = nullptr;

  /// Any type; nullptr if absent. Marks the parameter as used.
  const Parameter* find(const std::string& name) const;
  /// Only if its type is one of `types`; another type with that name is left alone.
  const Parameter* find(const std::string& name, std::initializer_list<const char*> types) const;

  float get_float(const std::string& name, float fallback) const;
  int get_int(const std::string& name, int fallback) const;
  bool get_bool(const std::string& name, bool fallback) const;
  std::string get_string(const std::string& name, const std::string& fallback) const;
  std::optional<Vec3f> get_point3(const std::string& name) const;
  std::optional<Vec3f> get_vector3(const std::string& name) const;
  std::vector<float> get_floats(const std::string& name) const;
  std::vector<int> get_ints(const std::string& name) const;
  std::vector<Vec2f> get_point2s(const std::string& name) const;
  std::vector<Vec3f> get_point3s(const std::string& name) const;
  std::vector<Vec3f> get_vector3s(const std::string& name) const;
  std::vector<Vec3f> get_normals(const std::string& name) const;

  /// Warns of each parameter that no getter has asked for, unless `type` says that the picture does
  /// not depend on it.
  void report_unused(const std::string& of_what, const FormatType& type,
                     Diagnostics& diagnostics) const;
};

/// The two keyframes of an animated transform, row-vector convention, object to world.
struct TransformDescription {
  Mat44d start, end;
  bool is_animated() const { return start != end; }
};

/// A directive with a type name and parameters: Camera "perspective" ...
struct DirectiveDescription {
  std::string type;
  ParameterSet parameters;
  SourceLocation where;
};

struct CameraDescription : DirectiveDescription {
  TransformDescription world_to_camera;  ///< the transform in force at the Camera directive
  std::string medium;
};

struct TextureDescription : DirectiveDescription {
  std::string name;
  std::string value_type;  ///< "float" or "spectrum"
  TransformDescription transform;
};

struct MaterialDescription : DirectiveDescription {
  std::string name;  ///< empty for an anonymous material
};

struct LightDescription : DirectiveDescription {
  TransformDescription transform;
  std::string medium;
};

/// Index into SceneDescription::materials, or a name that is resolved after parsing (named
/// materials may be used before they are made).
struct MaterialReference {
  int index = -1;    ///< valid if >= 0
  std::string name;  ///< else, if not empty
  SourceLocation where;
};

struct ShapeDescription : DirectiveDescription {
  TransformDescription transform;
  bool reverse_orientation = false;
  MaterialReference material;
  std::optional<DirectiveDescription> area_light;
  std::string inside_medium, outside_medium;
};

struct MediumDescription : DirectiveDescription {
  std::string name;
  TransformDescription transform;
};

struct ObjectDescription {
  std::string name;
  std::vector<ShapeDescription> shapes;
  SourceLocation where;
};

struct InstanceDescription {
  std::string object;
  TransformDescription transform;
  SourceLocation where;
};

/// Everything a scene file said, in file order. Directives that were absent are empty optionals.
struct SceneDescription {
  std::string file;  ///< as given by the user
  /// Never null; copies share it.
  std::shared_ptr<SceneFiles> files = std::make_shared<SceneFiles>();
  std::vector<Parameter> options;
  std::optional<DirectiveDescription> film, sampler, pixel_filter, integrator, accelerator;
  std::optional<CameraDescription> camera;
  float transform_start_time = 0, transform_end_time = 1;
  std::string color_space = "srgb";            ///< of the film: in force at the Film directive
  std::vector<MaterialDescription> materials;  ///< named and anonymous
  std::vector<TextureDescription> textures;
  std::vector<MediumDescription> media;
  std::vector<LightDescription> lights;
  std::vector<ShapeDescription> shapes;
  std::map<std::string, ObjectDescription> objects;
  std::vector<InstanceDescription> instances;
};

}  // namespace nephroid
