// Writes a SceneDescription as text: numbers with nine digits, matrices row by row.
#include "unit/input/scene_dump.h"

#include <cstdio>
#include <filesystem>

namespace nephroid::testing {
namespace {

std::string number(double value) {
  char text[40];
  std::snprintf(text, sizeof(text), "%.9g", value);
  return text;
}

std::string place(const SourceLocation& where) {
  return std::filesystem::path(where.to_string()).filename().string();
}

std::string quoted(const std::string& text) {
  std::string result = "'";
  result += text;
  result += "'";
  return result;
}

class Dumper {
 public:
  void line(const std::string& text) { text_ += std::string(2 * depth_, ' ') + text + "\n"; }
  void indent(int by) { depth_ += static_cast<size_t>(by); }
  const std::string& text() const { return text_; }

  void parameter(const Parameter& p) {
    std::string values;
    for (const double value : p.numbers) values += " " + number(value);
    for (const std::string& value : p.strings) values += " " + quoted(value);
    for (const bool value : p.bools) values += value ? " true" : " false";
    line(p.type + " " + quoted(p.name) + " =" + values + "  " + p.color_space +
         (p.used ? " used" : "") + " @" + place(p.where));
  }
  void directive(const std::string& kind, const DirectiveDescription& d) {
    line(kind + " " + quoted(d.type) + " @" + place(d.where));
    indent(1);
    if (place(d.parameters.where) != place(d.where))
      line("parameters @" + place(d.parameters.where));
    for (const Parameter& p : d.parameters.list) parameter(p);
    indent(-1);
  }
  void matrix(const std::string& name, const Mat44d& m) {
    if (m == Mat44d()) return;
    std::string numbers;
    for (int i = 0; i < 4; ++i) {
      for (int j = 0; j < 4; ++j) numbers += " " + number(m[i][j] + 0.0);
      if (i < 3) numbers += " |";
    }
    line(name + numbers);
  }
  void transform(const TransformDescription& t) {
    indent(1);
    if (t.is_animated()) {
      matrix("start", t.start);
      matrix("end", t.end);
    } else {
      matrix("transform", t.start);
    }
    indent(-1);
  }
  void detail(const std::string& name, const std::string& value) {
    indent(1);
    if (!value.empty()) line(name + " " + quoted(value));
    indent(-1);
  }
  void shape(const ShapeDescription& s) {
    directive("shape", s);
    transform(s.transform);
    indent(1);
    if (s.reverse_orientation) line("reversed");
    line("material " +
         (s.material.index >= 0 ? std::to_string(s.material.index) : quoted(s.material.name)) +
         " @" + place(s.material.where));
    if (s.area_light) directive("area light", *s.area_light);
    indent(-1);
    detail("inside", s.inside_medium);
    detail("outside", s.outside_medium);
  }

 private:
  std::string text_;
  size_t depth_ = 0;
};

void dump_options(Dumper& out, const SceneDescription& scene) {
  out.line("color space " + scene.color_space);
  out.line("times " + number(scene.transform_start_time) + " " + number(scene.transform_end_time));
  for (const Parameter& option : scene.options) out.parameter(option);
  if (scene.film) out.directive("film", *scene.film);
  if (scene.sampler) out.directive("sampler", *scene.sampler);
  if (scene.pixel_filter) out.directive("filter", *scene.pixel_filter);
  if (scene.integrator) out.directive("integrator", *scene.integrator);
  if (scene.accelerator) out.directive("accelerator", *scene.accelerator);
  if (scene.camera) {
    out.directive("camera", *scene.camera);
    out.transform(scene.camera->world_to_camera);
    out.detail("medium", scene.camera->medium);
  }
}

}  // namespace

std::string dump(const SceneDescription& scene, const Diagnostics& diagnostics) {
  Dumper out;
  dump_options(out, scene);
  for (const MaterialDescription& material : scene.materials) {
    out.directive("material", material);
    out.detail("name", material.name);
  }
  for (const TextureDescription& texture : scene.textures) {
    out.directive(texture.value_type + " texture", texture);
    out.detail("name", texture.name);
    out.transform(texture.transform);
  }
  for (const MediumDescription& medium : scene.media) {
    out.directive("medium", medium);
    out.detail("name", medium.name);
    out.transform(medium.transform);
  }
  for (const LightDescription& light : scene.lights) {
    out.directive("light", light);
    out.transform(light.transform);
    out.detail("medium", light.medium);
  }
  for (const ShapeDescription& shape : scene.shapes) out.shape(shape);
  for (const auto& [name, object] : scene.objects) {
    out.line("object " + quoted(name) + " @" + place(object.where));
    out.indent(1);
    for (const ShapeDescription& shape : object.shapes) out.shape(shape);
    out.indent(-1);
  }
  for (const InstanceDescription& instance : scene.instances) {
    out.line("instance " + quoted(instance.object) + " @" + place(instance.where));
    out.transform(instance.transform);
  }
  for (const Warning& warning : diagnostics.warnings())
    out.line("warning @" + place(warning.where) + " " + warning.message);
  return out.text();
}

}  // namespace nephroid::testing
