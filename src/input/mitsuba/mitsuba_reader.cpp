#include "input/mitsuba/mitsuba_reader.h"

#include <utility>
#include <vector>

#include "core/counted.h"
#include "input/mitsuba/bsdf_plugins.h"
#include "input/mitsuba/emitter_plugins.h"
#include "input/mitsuba/integrator_names.h"
#include "input/mitsuba/medium_plugins.h"
#include "input/mitsuba/object_reader.h"
#include "input/mitsuba/sensor_plugins.h"
#include "input/mitsuba/shape_plugins.h"
#include "input/mitsuba/texture_plugins.h"
#include "input/number_text.h"
#include "input/token_stream.h"

namespace nephroid {
namespace {

using namespace mitsuba;

std::vector<const Object*> objects_with(const Document& document, const char* tag) {
  std::vector<const Object*> found;
  for (const Child& child : document.scene.children)
    if (child.object->tag == tag) found.push_back(child.object);
  return found;
}

/// Ids of sensors, or indices where there are none.
std::vector<std::string> names_of(const std::vector<const Object*>& sensors) {
  std::vector<std::string> names;
  for (const Object* sensor : sensors)
    names.push_back(sensor->id.empty() ? std::to_string(names.size()) : sensor->id);
  return names;
}

/// Lists the sensors and the parameters.
void add_choices(const Document& document, FileChoices& choices) {
  choices.cameras = names_of(objects_with(document, "sensor"));
  for (const auto& entry : document.parameters)
    choices.parameters.push_back(entry.first + "=" + entry.second);
}

/// The sensor that the user named by id or index; the first by default.
const Object* chosen_sensor(const Document& document, const std::string& wanted) {
  const std::vector<const Object*> sensors = objects_with(document, "sensor");
  if (wanted.empty()) return sensors.empty() ? nullptr : sensors[0];
  const auto index = parse_integer(wanted);
  for (size_t i = 0; i < sensors.size(); ++i) {
    const bool is_wanted =
        sensors[i]->id == wanted || (index && *index == static_cast<long long>(i));
    if (is_wanted) return sensors[i];
  }
  std::string names;
  for (const std::string& name : names_of(sensors)) names += (names.empty() ? "" : ", ") + name;
  throw SceneError(document.scene.where, "there is no camera \"" + wanted + "\"" +
                                             (names.empty() ? ": the scene has no sensor"
                                                            : ", expected one of: " + names));
}

void write_object(ImportContext& context, const Object& object) {
  if (object.tag == "shape") {
    write_shape(context, object);
  } else if (object.tag == "emitter") {
    write_emitter(context, object);
  } else if (object.tag == "integrator") {
    write_integrator(context, object);
  } else if (object.tag == "bsdf") {
    if (!object.id.empty()) write_bsdf(context, object);
  } else if (object.id.empty() && object.tag != "medium" && object.tag != "sensor") {
    // Objects with an id are written where others refer to them.
    context.diagnostics.warn(
        object.where, object.tag + " \"" + object.type + "\" outside of other objects is ignored");
  }
}

void warn_of_one_sided(const ImportContext& context) {
  const int count = context.one_sided_shapes;
  if (count == 0) return;
  context.diagnostics.warn(context.first_one_sided,
                           counted(static_cast<uint64_t>(count), "open shape") +
                               in_number(static_cast<uint64_t>(count), " has a one-sided BSDF",
                                         " have one-sided BSDFs, this is the first") +
                               ": the back is black in Mitsuba, and like the front here");
}

}  // namespace

SceneDescription read_mitsuba(const std::string& path, const ImportOptions& options,
                              Diagnostics& diagnostics, std::shared_ptr<SceneFiles> files) {
  SceneDescription scene;
  scene.file = shown_name(path);
  scene.files = files ? std::move(files) : files_of_scene(path);
  const Document document = read_document(path, *scene.files, options, diagnostics);
  add_choices(document, scene.choices);
  ImportContext context{scene, document.file_names, diagnostics, document.version};
  for (const Child& child : document.scene.children) write_object(context, *child.object);
  if (const Object* sensor = chosen_sensor(document, options.camera))
    write_sensor(context, *sensor, path);
  scene.choices.cameras = names_of(objects_with(document, "sensor"));
  warn_of_one_sided(context);
  return scene;
}

}  // namespace nephroid
