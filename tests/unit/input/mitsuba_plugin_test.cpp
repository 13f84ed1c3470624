// Goes over the tables of Mitsuba's plug-ins: what they call loaded, approximated or refused is. A
// new row without a sample fails.
#include <set>

#include "input/mitsuba/plugin_tables.h"
#include "unit/input/mitsuba_samples.h"
#include "unit/input/scene_dump.h"

namespace nephroid::testing {
namespace {

using mitsuba::Plugin;
using mitsuba::PluginSupport;

/// The sample of the plug-in; nullptr if it has none.
const PluginSample* sample_of(const Plugin& plugin) {
  for (const PluginSample& sample : plugin_samples())
    if (sample.tag == plugin.tag && sample.name == plugin.name) return &sample;
  return nullptr;
}

std::string title(const Plugin& plugin) {
  return std::string(plugin.tag) + " \"" + plugin.name + "\"";
}

TEST(MitsubaPlugins, ThatAreRefusedSayWhy) {
  for (const Plugin& plugin : mitsuba::plugin_tables()) {
    if (plugin.support != PluginSupport::kRefused) continue;
    MitsubaScene scene;
    const std::string error = scene.error(scene_with(plugin.tag, plugin.name, ""));
    EXPECT_NE(error.find(title(plugin) + " cannot be rendered: "), std::string::npos) << error;
    EXPECT_NE(std::string(plugin.note), "") << title(plugin);
    EXPECT_EQ(sample_of(plugin), nullptr) << title(plugin);
  }
}

TEST(MitsubaPlugins, ThatAreLoadedHaveASampleWhichBecomesWhatItSays) {
  for (const Plugin& plugin : mitsuba::plugin_tables()) {
    if (plugin.support == PluginSupport::kRefused) continue;
    SCOPED_TRACE(title(plugin));
    const PluginSample* sample = sample_of(plugin);
    ASSERT_TRUE(sample) << "mitsuba_samples.cpp has no sample of it";
    MitsubaScene scene;
    write_sample_files(scene.folder());
    const SceneDescription d = scene.read(scene_with(plugin.tag, plugin.name, sample->body));
    const std::string found = dump(d, scene.diagnostics);
    EXPECT_FALSE(sample->becomes.empty());
    for (const std::string& part : sample->becomes)
      EXPECT_NE(found.find(part), std::string::npos) << part << " is not in\n" << found;
    EXPECT_EQ(found.find("is unknown, it is ignored"), std::string::npos) << found;
    const bool is_announced =
        found.find(title(plugin) + " is approximated") != std::string::npos ||
        found.find(title(plugin) + " is ignored") != std::string::npos ||
        found.find(title(plugin) + ": this renderer has no such method") != std::string::npos;
    EXPECT_EQ(is_announced, plugin.support != PluginSupport::kLoaded) << found;
  }
}

TEST(MitsubaPlugins, StandInTheTablesOnce) {
  std::set<std::string> names;
  for (const Plugin& plugin : mitsuba::plugin_tables())
    EXPECT_TRUE(names.insert(title(plugin)).second) << title(plugin);
  EXPECT_GE(names.size(), 100u);
}

}  // namespace
}  // namespace nephroid::testing
