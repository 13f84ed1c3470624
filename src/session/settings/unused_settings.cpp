#include "session/settings/unused_settings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "integrator/presets/estimator_table.h"

namespace nephroid {

namespace {

bool looks_at(const EstimatorDescriptor& estimator, const std::string& key) {
  return std::ranges::any_of(estimator.settings,
                             [&](const EstimatorSetting* setting) { return key == setting->key; });
}

}  // namespace

std::vector<std::string> unused_settings(const std::vector<std::string>& keys,
                                         const Routes& routes) {
  std::vector<std::string> warnings;
  for (const std::string& key : keys) {
    std::vector<std::string> names;
    for (const EstimatorDescriptor* estimator : estimator_table())
      if (looks_at(*estimator, key)) names.emplace_back(estimator->traits.name);
    const bool is_used = std::ranges::any_of(routes.groups(), [&](const RouteGroup& group) {
      return looks_at(descriptor_of(group), key);
    });
    if (!names.empty() && !is_used)
      warnings.push_back(fmt::format("-D {} changes nothing here: no route is rendered by {}", key,
                                     fmt::join(names, ", ")));
  }
  return warnings;
}

}  // namespace nephroid
