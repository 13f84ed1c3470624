// Goes over the tables of Mitsuba's plug-ins: what they call loaded, approximated or refused is.
#include <set>

#include "input/mitsuba/plugin_tables.h"
#include "unit/input/mitsuba_samples.h"

namespace nephroid::testing {
namespace {

using mitsuba::Plugin;
using mitsuba::PluginSupport;

std::string body_of(const Plugin& plugin) {
  for (const PluginSample& sample : plugin_samples())
    if (sample.tag == plugin.tag && sample.name == plugin.name) return sample.body;
  return "";
}

std::string title(const Plugin& plugin) {
  return std::string(plugin.tag) + " \"" + plugin.name + "\"";
}

TEST(MitsubaPlugins, HaveTheOutcomeOfTheirTable) {
  for (const Plugin& plugin : mitsuba::plugin_tables()) {
    SCOPED_TRACE(title(plugin));
    MitsubaScene scene;
    write_sample_files(scene.folder());
    const std::string error = scene.error(scene_with(plugin.tag, plugin.name, body_of(plugin)));
    if (plugin.support == PluginSupport::kRefused) {
      EXPECT_NE(error.find(title(plugin) + " cannot be rendered: "), std::string::npos) << error;
      EXPECT_NE(std::string(plugin.note), "");
      continue;
    }
    EXPECT_EQ(error, "no error");
    const std::string warnings = scene.warnings();
    EXPECT_EQ(warnings.find("is unknown, it is ignored"), std::string::npos) << warnings;
    const bool is_announced =
        warnings.find(title(plugin) + " is approximated") != std::string::npos ||
        warnings.find(title(plugin) + " is ignored") != std::string::npos ||
        warnings.find(title(plugin) + ": this renderer has no such method") != std::string::npos;
    EXPECT_EQ(is_announced, plugin.support != PluginSupport::kLoaded) << warnings;
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
