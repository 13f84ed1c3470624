#include "session/inspection_stand_in.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "core/errors.h"

namespace nephroid {

namespace {

const EstimatorDescriptor& descriptor_named(std::string_view name) {
  return **std::ranges::find_if(estimator_table(), [name](const EstimatorDescriptor* row) {
    return name == row->traits.name;
  });
}

StandIn stand_in_named(std::string_view name, const std::set<std::string>& replaced,
                       const EstimatorSet& set, const Scene& scene,
                       const IntegratorOptions& options) {
  StandIn stand_in;
  stand_in.estimator = &descriptor_named(name);
  RoutePlan plan{set.routes->definitions(), set.routes->aovs(), false};
  for (RouteDefinition& route : plan.routes)
    if (replaced.contains(route.estimator->name)) route.estimator = &stand_in.estimator->traits;
  stand_in.set = make_estimators(plan, options, scene);
  stand_in.note = fmt::format(
      "single paths of {} cannot be traced again: lights, techniques and words of {} routes are "
      "estimated by {}",
      fmt::join(replaced, ", "), replaced.size() == 1 ? "its" : "their", name);
  return stand_in;
}

}  // namespace

std::optional<StandIn> stand_in_for(const EstimatorSet& set, const Scene& scene,
                                    const IntegratorOptions& options) {
  std::set<std::string> replaced;
  for (size_t g = 0; g < set.routes->groups().size(); ++g)
    if (!set.estimators[g]->records_pixels())
      replaced.insert(set.estimators[g]->descriptor().traits.name);
  if (replaced.empty()) return std::nullopt;
  // `bpm` needs no learning and finds caustics, but not all words.
  try {
    return stand_in_named("bpm", replaced, set, scene, options);
  } catch (const UsageError&) {
    return stand_in_named("path", replaced, set, scene, options);
  }
}

}  // namespace nephroid
