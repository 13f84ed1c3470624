#include "session/settings/unused_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace nephroid {

namespace {

struct Concern {
  const char* key;
  std::vector<EstimatorKind> estimators;
};

const std::vector<Concern>& concerns() {
  using enum EstimatorKind;
  static const std::vector<Concern> table = {
      {"technique", {kBidirectional, kVcm, kBpm}},
      {"hit-points", {kPpm}},
      {"map-photons", {kPhotonMap}},
      {"nearest", {kPhotonMap}},
      {"point-lights", {kPointLights}},
      {"mutations", {kMetropolis, kPrimarySpace}},
      {"chain-length", {kMetropolis, kPrimarySpace}},
      {"large-step", {kMetropolis, kPrimarySpace}},
      {"guide", {kPhotons, kPathAndPhotons}},
      {"guide-walks", {kPathAndPhotons}},
      {"specular-trees", {kPath, kForecast, kBidirectional, kVcm, kBpm}}};
  return table;
}

}  // namespace

std::vector<std::string> unused_settings(const std::vector<std::string>& keys,
                                         const Routes& routes) {
  const auto renders = [&](EstimatorKind kind) {
    return std::any_of(routes.groups().begin(), routes.groups().end(),
                       [&](const RouteGroup& group) { return group.estimator == kind; });
  };
  std::vector<std::string> warnings;
  for (const std::string& key : keys)
    for (const Concern& concern : concerns()) {
      if (key != concern.key ||
          std::any_of(concern.estimators.begin(), concern.estimators.end(), renders))
        continue;
      std::string names;
      for (const EstimatorKind kind : concern.estimators)
        names += (names.empty() ? "" : ", ") + std::string(estimator_type(kind).name);
      warnings.push_back(
          fmt::format("-D {} changes nothing here: no route is rendered by {}", key, names));
    }
  return warnings;
}

}  // namespace nephroid
