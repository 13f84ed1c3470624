// The scenes of the folder "features", one tiny scene for each feature of the scene format and for
// each extension of glTF, and their pictures for one seed. It must not know what is stored.
#pragma once

#include <algorithm>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "film/film_output.h"
#include "input/gltf/support.h"
#include "input/scene_reader.h"
#include "rendering.h"
#include "session/settings/integrator_choice.h"
#include "source_directory.h"

namespace nephroid::testing_support {

/// Ends with a slash.
inline const std::string kFeatureFolder =
    testing_support::source_directory() + "/tests/regression/features/";

/// Ends of the names of scenes.
constexpr const char* kFeatureSuffixes[] = {".pbrt", ".gltf", ".glb"};

/// Names of all scenes, without folder and suffix, sorted.
inline std::vector<std::string> feature_names() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(kFeatureFolder))
    for (const char* suffix : kFeatureSuffixes)
      if (entry.path().extension() == suffix) names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

/// The file of a scene. Throws std::runtime_error if there is none.
inline std::string feature_file(const std::string& name) {
  for (const char* suffix : kFeatureSuffixes)
    if (std::filesystem::exists(kFeatureFolder + name + suffix))
      return kFeatureFolder + name + suffix;
  throw std::runtime_error("there is no scene " + name);
}

/// Options of the user about a scene: without a variant its extension would show nothing.
inline ImportOptions feature_import_options(const std::string& name) {
  ImportOptions options;
  options.exposure = 0;
  if (name == "KHR_materials_variants") options.variant = "green";
  return options;
}

/// True if loading may warn: the scene is of an extension that is approximated.
inline bool is_approximated(const std::string& name) {
  const auto extensions = gltf::extension_table();
  return std::any_of(extensions.begin(), extensions.end(), [&](const gltf::Feature& extension) {
    return name == extension.name && extension.support == gltf::FeatureSupport::kApproximated;
  });
}

/// Throws std::runtime_error on any other warning: these scenes are correct.
inline std::unique_ptr<Scene> load_feature(const std::string& name) {
  constexpr int kGltfSide = 24;  // pbrt-v4 scenes say theirs
  Diagnostics diagnostics;
  SceneOverrides overrides;
  overrides.import = feature_import_options(name);
  const std::string file = feature_file(name);
  if (!file.ends_with(".pbrt")) overrides.width = overrides.height = kGltfSide;
  const SceneDescription description = read_scene(file, overrides.import, diagnostics);
  auto scene = build_scene(description, overrides, diagnostics);
  if (!is_approximated(name))
    for (const Warning& warning : diagnostics.warnings())
      throw std::runtime_error(located(warning.where, warning.message));
  return scene;
}

/// The options that the scene asks for.
inline IntegratorOptions feature_options(const Scene& scene, const std::string& integrator) {
  return choose_integrator(integrator, scene.integrator, scene.integrator_parameters, {})
      .settings.integrator;
}

/// All layers that the program would write, rendered by `path`.
inline Picture feature_picture(const Scene& scene, uint64_t seed, uint32_t passes) {
  return film_picture(render(scene, "path", feature_options(scene, "path"), seed, passes), {});
}

/// The compared channels: colours, and the geometry of a gbuffer film.
inline std::vector<std::string> compared_channels(const Picture& picture) {
  std::vector<std::string> names = {"R", "G", "B"};
  if (picture.find_channel("Albedo.R") < 0) return names;
  for (const char* name : {"Albedo.R", "Albedo.G", "Albedo.B", "N.X", "N.Y", "N.Z", "P.X", "P.Y",
                           "P.Z", "Ns.X", "Ns.Y", "Ns.Z", "u", "v", "dzdx", "dzdy", "Z"})
    names.emplace_back(name);
  return names;
}

/// Values of one channel of many pictures, as [pixel][picture].
inline SeedValues channel_values(const std::vector<Picture>& pictures, const std::string& channel) {
  const auto c = static_cast<size_t>(pictures[0].find_channel(channel));
  const size_t stride = pictures[0].channels.size();
  SeedValues values(pictures[0].pixels.size() / stride);
  for (const Picture& picture : pictures)
    for (size_t i = 0; i < values.size(); ++i)
      values[i].push_back(picture.pixels.at(i * stride + c));
  return values;
}

/// The mean over the pixels for each picture.
inline std::vector<double> picture_means(const SeedValues& pixels) {
  std::vector<double> means(pixels[0].size(), 0.0);
  for (const auto& pixel : pixels)
    for (size_t s = 0; s < means.size(); ++s)
      means[s] += pixel[s] / static_cast<double>(pixels.size());
  return means;
}

}  // namespace nephroid::testing_support
