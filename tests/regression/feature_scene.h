// The scenes of the folder "features", one tiny scene for each feature of the scene format, and
// their pictures for one seed. It must not know what is stored.
#pragma once

#include <algorithm>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "film/film_output.h"
#include "rendering.h"
#include "session/settings/integrator_choice.h"
#include "source_directory.h"

namespace nephroid::testing_support {

/// Ends with a slash.
inline const std::string kFeatureFolder =
    testing_support::source_directory() + "/tests/regression/features/";

/// Names of all scenes, without folder and ".pbrt", sorted.
inline std::vector<std::string> feature_names() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(kFeatureFolder))
    if (entry.path().extension() == ".pbrt") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

/// Throws std::runtime_error on any warning: these scenes are correct.
inline std::unique_ptr<Scene> load_feature(const std::string& name) {
  Diagnostics diagnostics;
  const SceneDescription description =
      parse_pbrt_file(kFeatureFolder + name + ".pbrt", diagnostics);
  auto scene = build_scene(description, {}, diagnostics);
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
