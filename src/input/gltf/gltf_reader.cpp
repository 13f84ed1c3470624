// Reads the parts of a glTF file in order: extensions, choices, animations, nodes, camera, lights,
// meshes.
#include "input/gltf/gltf_reader.h"

#include <new>
#include <utility>

#include "input/gltf/cameras.h"
#include "input/gltf/choices.h"
#include "input/gltf/lights.h"
#include "input/gltf/meshes.h"
#include "input/gltf/support.h"

namespace nephroid {
namespace {

void check_version(const gltf::Document& document) {
  const gltf::JsonValue asset = document.root().get("asset");
  const std::string version = asset.get("version").text();
  if (!version.starts_with("2."))
    asset.get("version").fail("this is glTF " + version.substr(0, 20) + ", expected version 2.0");
}

SceneDescription read(const std::string& path, const ImportOptions& options,
                      Diagnostics& diagnostics, std::shared_ptr<SceneFiles> files) {
  SceneDescription scene;
  scene.file = path;
  scene.files = files ? std::move(files) : files_of_scene(path);
  gltf::Document document(path, *scene.files, options, diagnostics);
  check_version(document);
  gltf::check_extensions(document);
  gltf::add_choices(document, scene);
  const gltf::AnimationPose start(document, options.time);
  const gltf::AnimationPose end(document, options.time + options.shutter);
  const gltf::NodeGraph nodes(document, start, end);
  gltf::add_camera(document, nodes, scene);
  gltf::add_lights(document, nodes, scene);
  gltf::Meshes(document, scene, nodes, start).add_all();
  return scene;
}

}  // namespace

SceneDescription read_gltf(const std::string& path, const ImportOptions& options,
                           Diagnostics& diagnostics, std::shared_ptr<SceneFiles> files) {
  try {
    return read(path, options, diagnostics, std::move(files));
  } catch (const std::bad_alloc&) {
    throw SceneError({std::make_shared<const std::string>(path), 0, 0},
                     "the file does not fit into memory");
  }
}

}  // namespace nephroid
