// An example of each plug-in of Mitsuba that is loaded, for tests that go over the tables.
#pragma once

#include <string>
#include <vector>

#include "unit/input/mitsuba_scene.h"

namespace nephroid::testing {

struct PluginSample {
  std::string tag, name;
  std::vector<std::string> becomes;  ///< parts of the scene's dump (scene_dump.h)
  std::string body = {};             ///< elements in the plug-in
};

/// A sample of each plug-in that is not refused; the files they use are written by
/// write_sample_files.
const std::vector<PluginSample>& plugin_samples();

void write_sample_files(const TemporaryDirectory& folder);

/// A scene that uses the plug-in where it belongs.
std::string scene_with(const std::string& tag, const std::string& name, const std::string& body);

}  // namespace nephroid::testing
