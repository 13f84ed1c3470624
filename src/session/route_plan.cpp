#include "session/route_plan.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "core/errors.h"
#include "input/spelling.h"
#include "integrator/presets/estimator_table.h"
#include "integrator/presets/integrator_table.h"
#include "integrator/presets/route_presets.h"

namespace nephroid {
namespace {

void check_one_source(const RouteChoice& choice) {
  std::string given;
  int count = 0;
  for (const auto& [name, is_given] : {std::pair{"--integrator", !choice.integrator.empty()},
                                       {"--routes", !choice.preset_or_file.empty()},
                                       {"--route", !choice.routes.empty()}}) {
    if (!is_given) continue;
    given += std::string(count == 0 ? "" : " and ") + name;
    ++count;
  }
  if (count > 1)
    throw UsageError(given + " cannot be combined: each sets the routes, expected one of them");
}

std::string read_file(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  if (!in.is_open() || in.bad()) throw IoError("'" + file + "' cannot be read");
  return text;
}

std::vector<RouteDefinition> routes_of(const std::string& preset_or_file) {
  if (const auto preset = route_preset(preset_or_file)) return *preset;
  if (std::filesystem::is_regular_file(preset_or_file))
    return parse_route_file(read_file(preset_or_file), estimator_traits(), preset_or_file);
  std::vector<std::string> names;
  for (const RoutePreset& preset : route_presets()) names.emplace_back(preset.name);
  throw UsageError(fmt::format(
      "--routes: '{}' is neither a preset nor a file, expected the name of a file or one of: {}{}",
      preset_or_file, fmt::join(names, ", "), did_you_mean(preset_or_file, names)));
}

}  // namespace

RoutePlan plan_of(const RouteChoice& choice, const std::string& integrator) {
  check_one_source(choice);
  RoutePlan plan;
  if (!choice.routes.empty())
    plan.routes = choice.routes;
  else if (!choice.preset_or_file.empty())
    plan.routes = routes_of(choice.preset_or_file);
  else
    plan = plan_of_integrator(integrator);
  plan.aovs = choice.aovs;
  plan.has_own_routes = !choice.routes.empty() ||
                        (!choice.preset_or_file.empty() && !route_preset(choice.preset_or_file));
  plan.strict = choice.strict;
  return plan;
}

std::string routes_text(const RoutePlan& plan) {
  std::string text;
  for (const RouteDefinition& route : plan.routes)
    text += route.name + " = " + route.expression + " : " + route.estimator->name + "\n";
  return text;
}

std::string aovs_text(const RoutePlan& plan) {
  std::string text;
  for (const AovDefinition& aov : plan.aovs)
    text += aov.name + " = " + aov.expression +
            (aov.route.empty() ? "" : " of route " + aov.route) + "\n";
  return text;
}

std::string name_of(const RouteChoice& choice, const std::string& integrator) {
  if (!choice.routes.empty()) return "--route";
  return choice.preset_or_file.empty() ? integrator : choice.preset_or_file;
}

}  // namespace nephroid
