#include "input/convert/pbrt_writer.h"

#include <algorithm>
#include <filesystem>
#include <initializer_list>
#include <set>

#include "core/spectra.h"
#include "input/convert/companion_files.h"
#include "input/convert/dialect.h"
#include "input/convert/pbrt_text.h"
#include "input/mesh_directive.h"

namespace nephroid {
namespace {

/// Meshes with more triangles go to a file.
constexpr size_t kMaxTrianglesInText = 32;

constexpr const char* kFileParameters[] = {"filename", "faces", "normalmap", "lensfile",
                                           "emissionfilename"};

bool same_place(const SourceLocation& a, const SourceLocation& b) {
  return a.file == b.file && a.line == b.line && a.column == b.column;
}

/// Names for all materials: their own, or type and number as in scene_labels.h.
std::vector<std::string> names_of_materials(const SceneDescription& scene) {
  std::set<std::string> taken;
  for (const MaterialDescription& m : scene.materials) taken.insert(m.name);
  std::map<std::string, int> last;
  std::vector<std::string> names;
  for (const MaterialDescription& m : scene.materials) {
    std::string name = m.name;
    const std::string type = m.type.empty() ? "interface" : m.type;
    while (name.empty() || (m.name.empty() && taken.count(name) != 0))
      name = type + std::to_string(++last[type]);
    names.push_back(name);
  }
  return names;
}

class PbrtWriter {
 public:
  PbrtWriter(const SceneDescription& scene, const std::string& path)
      : scene_(scene), path_(path), files_(scene, path), materials_(names_of_materials(scene)) {}

  const std::vector<std::string>& file_names() const { return files_.names(); }
  void write() {
    text_ = "# Written by nephroid convert from " +
            std::filesystem::path(scene_.file).filename().string() + ".\n" + dialect_note(scene_);
    write_options();
    text_ += "\nWorldBegin\n";
    state_.transform = {};
    write_world();
    write_bytes(path_, text_);
  }

 private:
  /// The graphics state that reading the text up to here gives.
  struct State {
    TransformDescription transform;
    std::string color_space = "srgb", material, inside, outside;
    bool reverse_orientation = false;
  };

  void write_options();
  void write_world();
  void write_materials();
  void write_shapes(const std::vector<ShapeDescription>& shapes);
  void write_shape(const ShapeDescription& shape);
  void write_mesh(const ShapeDescription& shape, const MeshData& mesh);

  void line(const std::string& text) { text_ += text + "\n"; }
  /// `Name "type" parameters`; without a name of the directive's own type if `type` is null.
  void directive(const std::string& beginning, const ParameterSet& parameters,
                 std::initializer_list<const char*> left_out = {}, bool names_files = true);
  void typed(const std::string& name, const DirectiveDescription& d) {
    directive(name + " " + quoted_text(d.type), d.parameters);
  }
  void optional(const std::string& name, const std::optional<DirectiveDescription>& d) {
    if (d) typed(name, *d);
  }
  Parameter with_new_names(Parameter parameter);

  void set_transform(const TransformDescription& wanted);
  void set_color_space(const std::string& wanted);
  void set_media(const std::string& inside, const std::string& outside);
  void set_orientation(bool reversed);
  void set_material(const MaterialReference& reference);

  const SceneDescription& scene_;
  std::string path_;
  CompanionFiles files_;
  std::vector<std::string> materials_;
  State state_;
  std::string text_;
};

/// Files get the names by which the new scene finds them. A string of a spectrum is a file's name
/// unless it is one of the measured spectra.
Parameter PbrtWriter::with_new_names(Parameter parameter) {
  const bool is_file = parameter.type == "string" &&
                       std::find(std::begin(kFileParameters), std::end(kFileParameters),
                                 parameter.name) != std::end(kFileParameters);
  for (std::string& text : parameter.strings)
    if (!text.empty() && (is_file || (parameter.type == "spectrum" && !named_spectrum(text))))
      text = files_.name_of(text);
  return parameter;
}

void PbrtWriter::directive(const std::string& beginning, const ParameterSet& parameters,
                           std::initializer_list<const char*> left_out, bool names_files) {
  if (!parameters.list.empty()) set_color_space(parameters.list.front().color_space);
  line(beginning);
  for (const Parameter& parameter : parameters.list) {
    const bool is_wanted = std::none_of(left_out.begin(), left_out.end(),
                                        [&](const char* name) { return parameter.name == name; });
    if (is_wanted) line("  " + parameter_text(names_files ? with_new_names(parameter) : parameter));
  }
}

void PbrtWriter::set_transform(const TransformDescription& wanted) {
  if (wanted.start == state_.transform.start && wanted.end == state_.transform.end) return;
  text_ += transform_text(wanted);
  state_.transform = wanted;
}

void PbrtWriter::set_color_space(const std::string& wanted) {
  if (wanted == state_.color_space) return;
  line("ColorSpace " + quoted_text(wanted));
  state_.color_space = wanted;
}

void PbrtWriter::set_media(const std::string& inside, const std::string& outside) {
  if (inside == state_.inside && outside == state_.outside) return;
  line("MediumInterface " + quoted_text(inside) + " " + quoted_text(outside));
  state_.inside = inside;
  state_.outside = outside;
}

void PbrtWriter::set_orientation(bool reversed) {
  if (reversed != state_.reverse_orientation) line("ReverseOrientation");
  state_.reverse_orientation = reversed;
}

void PbrtWriter::set_material(const MaterialReference& reference) {
  const std::string& name =
      reference.index >= 0 ? materials_[static_cast<size_t>(reference.index)] : reference.name;
  if (name.empty() || name == state_.material) return;
  line("NamedMaterial " + quoted_text(name));
  state_.material = name;
}

void PbrtWriter::write_options() {
  for (const Parameter& option : scene_.options) line("Option " + parameter_text(option));
  if (scene_.transform_start_time != 0 || scene_.transform_end_time != 1)
    line("TransformTimes " + shortest_text(scene_.transform_start_time) + " " +
         shortest_text(scene_.transform_end_time));
  optional("Sampler", scene_.sampler);
  optional("PixelFilter", scene_.pixel_filter);
  optional("Integrator", scene_.integrator);
  optional("Accelerator", scene_.accelerator);
  if (scene_.film) {
    set_color_space(scene_.color_space);
    directive("Film " + quoted_text(scene_.film->type), scene_.film->parameters, {}, false);
  }
  if (!scene_.camera) return;
  set_media("", scene_.camera->medium);
  set_transform(scene_.camera->world_to_camera);
  typed("Camera", *scene_.camera);
}

void PbrtWriter::write_materials() {
  for (size_t i = 0; i < scene_.materials.size(); ++i) {
    const MaterialDescription& m = scene_.materials[i];
    const std::string type = m.type.empty() ? "interface" : m.type;
    directive(
        "MakeNamedMaterial " + quoted_text(materials_[i]) + " \"string type\" " + quoted_text(type),
        m.parameters, {"type"});
  }
}

void PbrtWriter::write_world() {
  for (const MediumDescription& m : scene_.media) {
    set_transform(m.transform);
    directive("MakeNamedMedium " + quoted_text(m.name) + " \"string type\" " + quoted_text(m.type),
              m.parameters, {"type"});
  }
  for (const TextureDescription& t : scene_.textures) {
    set_transform(t.transform);
    directive("Texture " + quoted_text(t.name) + " " + quoted_text(t.value_type) + " " +
                  quoted_text(t.type),
              t.parameters);
  }
  write_materials();
  for (const LightDescription& light : scene_.lights) {
    set_media("", light.medium);
    set_transform(light.transform);
    typed("LightSource", light);
  }
  write_shapes(scene_.shapes);
  for (const auto& entry : scene_.objects) {
    line("ObjectBegin " + quoted_text(entry.first));
    const State before = state_;
    write_shapes(entry.second.shapes);
    line("ObjectEnd");
    state_ = before;
  }
  for (const InstanceDescription& instance : scene_.instances) {
    set_transform(instance.transform);
    line("ObjectInstance " + quoted_text(instance.object));
  }
}

/// Shapes of one AreaLightSource stand in one scope with it.
void PbrtWriter::write_shapes(const std::vector<ShapeDescription>& shapes) {
  for (size_t i = 0; i < shapes.size();) {
    if (!shapes[i].area_light) {
      write_shape(shapes[i++]);
      continue;
    }
    const DirectiveDescription& light = *shapes[i].area_light;
    line("AttributeBegin");
    const State before = state_;
    typed("AreaLightSource", light);
    for (; i < shapes.size() && shapes[i].area_light &&
           same_place(shapes[i].area_light->where, light.where);
         ++i)
      write_shape(shapes[i]);
    line("AttributeEnd");
    state_ = before;
  }
}

void PbrtWriter::write_shape(const ShapeDescription& shape) {
  set_media(shape.inside_medium, shape.outside_medium);
  set_orientation(shape.reverse_orientation);
  set_material(shape.material);
  set_transform(shape.transform);
  const std::optional<MeshData> mesh = mesh_for_a_file(shape);
  if (mesh && mesh->triangles.size() / 3 > kMaxTrianglesInText)
    write_mesh(shape, *mesh);
  else
    typed("Shape", shape);
}

void PbrtWriter::write_mesh(const ShapeDescription& shape, const MeshData& mesh) {
  directive("Shape \"plymesh\" \"string filename\" " + quoted_text(files_.add_mesh(mesh)),
            shape.parameters, {"P", "N", "uv", "indices", "faceIndices"});
}

}  // namespace

std::vector<std::string> write_pbrt(const SceneDescription& scene, const std::string& path) {
  PbrtWriter writer(scene, path);
  writer.write();
  return writer.file_names();
}

}  // namespace nephroid
