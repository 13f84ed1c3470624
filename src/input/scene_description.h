// A parsed scene file as plain structs: nothing is interpreted or looked up, and every value has
// its location. It must not know the meaning of types of shapes, materials or lights.
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

/// One parameter, such as "rgb reflectance" [ .5 .5 .5 ]. Exactly one of the vectors is used:
/// - numbers: float, integer, point*, vector*, normal*, rgb, blackbody, numeric spectra
/// - strings: string, texture, names and files of spectra
/// - bools: bool
struct Parameter {
  std::string type;  ///< type without pbrt's synonyms ("point" -> "point3" ...)
  std::string name;
  std::vector<double> numbers;
  std::vector<std::string> strings;
  std::vector<bool> bools;
  std::string color_space = "srgb";  ///< current colour space at the parameter
  SourceLocation where;
  mutable bool used = false;  ///< set by the getters; unused parameters are reported
};

/// The parameters of one directive. The getters check type and count, throw a located SceneError on
/// a mismatch, and return the default (or an empty optional / vector) if the name is absent.
class ParameterSet {
 public:
  std::vector<Parameter> list;
  SourceLocation where;  ///< location of the directive
  /// If set, the getters record the names they are asked for. Tests compare these with the tables
  /// of the format.
  std::set<std::string>* asked = nullptr;

  /// The parameter of any type; nullptr if absent. Marks it as used.
  const Parameter* find(const std::string& name) const;
  /// The same without marking it: for those who look at a description before it is used.
  const Parameter* peek(const std::string& name) const;
  /// As find() if its type is one of `types`; parameters of other types are ignored.
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

  /// Warns of each unused parameter, unless it is kNotNeeded in `type`.
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
  TransformDescription world_to_camera;  ///< current transform at the Camera directive
  /// The world's up in camera space: what the file says, as LookAt does; else the camera's own.
  Vec3d up{0, 1, 0};
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
  /// Mean luminance of an image of surroundings, cd/m^2, where the file gives it.
  std::optional<double> mean_luminance;
};

/// Index into SceneDescription::materials, or a name that is resolved after parsing: named
/// materials may be used before they are defined.
struct MaterialReference {
  int index = -1;    ///< used if >= 0
  std::string name;  ///< used otherwise, if not empty
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

/// The choices that a file offers, which `nephroid info` lists. Files of pbrt-v4 offer none.
struct FileChoices {
  std::vector<std::string> cameras;     ///< names, or numbers where there are none; for --camera
  std::vector<std::string> variants;    ///< for --variant
  std::vector<std::string> animations;  ///< names with their times, as in "walk, 0 to 2.5 s"; --at
  std::vector<std::string> parameters;  ///< with their values, as in "spp=64"; for --define
};

/// The contents of a scene file, in file order. Absent directives are empty optionals.
struct SceneDescription {
  std::string file;  ///< as given by the user
  /// Never null; copies share it.
  std::shared_ptr<SceneFiles> files = std::make_shared<SceneFiles>();
  std::vector<Parameter> options;
  std::optional<DirectiveDescription> film, sampler, pixel_filter, integrator, accelerator;
  std::optional<CameraDescription> camera;
  float transform_start_time = 0, transform_end_time = 1;
  std::string color_space = "srgb";            ///< colour space at the Film directive
  std::vector<MaterialDescription> materials;  ///< named and anonymous
  std::vector<TextureDescription> textures;
  std::vector<MediumDescription> media;
  std::vector<LightDescription> lights;
  std::vector<ShapeDescription> shapes;
  std::map<std::string, ObjectDescription> objects;
  std::vector<InstanceDescription> instances;
  FileChoices choices;
};

}  // namespace nephroid
