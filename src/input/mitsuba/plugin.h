// Rows of the tables of Mitsuba's plug-ins: what is loaded, approximated with a warning, or
// refused. It must not know any plug-in.
#pragma once

#include <string>
#include <vector>

#include "input/mitsuba/plugin_properties.h"
#include "input/spelling.h"

namespace nephroid::mitsuba {

enum class PluginSupport {
  kLoaded,
  kApproximated,  ///< loaded with a warning
  kIgnored,       ///< skipped with a warning: the scene makes sense without it
  kRefused,       ///< a located error
};

/// `note` says how the plug-in is loaded or why it is not: the text of the warning or the error.
struct Plugin {
  const char* tag;
  const char* name;
  PluginSupport support = PluginSupport::kLoaded;
  const char* note = "";
};

/// Warns that something is not as in Mitsuba.
inline void warn_approximated(PluginProperties& properties, const std::string& how) {
  properties.context().diagnostics.warn(properties.where(), properties.title() + ": " + how);
}

[[noreturn]] void refuse_plugin(const Object& object, const Plugin* row,
                                const std::vector<std::string>& known);

/// The row of the object's plug-in. Throws SceneError if it is unknown or refused; warns if it is
/// approximated or ignored.
template <class Row, size_t N>
const Row& plugin_row(const Row (&table)[N], const Object& object, Diagnostics& diagnostics) {
  const Row* found = nullptr;
  std::vector<std::string> known;
  for (const Row& row : table) {
    if (object.type == row.name) found = &row;
    if (row.support != PluginSupport::kRefused) known.emplace_back(row.name);
  }
  if (!found || found->support == PluginSupport::kRefused) refuse_plugin(object, found, known);
  if (found->support != PluginSupport::kLoaded)
    diagnostics.warn(
        object.where,
        object.tag + " \"" + object.type + "\" " +
            (found->support == PluginSupport::kIgnored ? "is ignored: " : "is approximated: ") +
            found->note);
  return *found;
}

}  // namespace nephroid::mitsuba
