#include "integrator/presets/estimator_set.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/errors.h"
#include "integrator/estimator/features.h"

namespace nephroid {

namespace {

void require_connecting_camera(const Scene& scene, EstimatorTable table) {
  if (scene.camera->connects()) return;
  std::vector<std::string> names;
  for (const EstimatorDescriptor* row : table)
    if (row->traits.connects) names.emplace_back(row->traits.name);
  throw UsageError(
      fmt::format("light paths cannot be connected to this camera through its lenses, expected "
                  "routes without {}, or another camera",
                  fmt::join(names, " and ")));
}

/// `part_matches` as in RouteCompilation: AOVs of other parts need no memory.
FilmLayout layout_of(const Routes& routes, const std::vector<bool>& part_matches,
                     EstimatorTable table) {
  FilmLayout layout;
  for (const RouteDefinition& route : routes.definitions()) layout.routes.push_back(route.name);
  for (const AovDefinition& aov : routes.aovs()) layout.aovs.push_back(aov.name);
  for (size_t p = 0; p < routes.parts().size(); ++p) {
    const PartMeaning& part = routes.parts()[p];
    layout.parts.push_back({part.route, part_matches[p] ? part.aovs : std::vector<int>()});
  }
  layout.groups.resize(layout.routes.size());
  for (size_t g = 0; g < routes.groups().size(); ++g)
    for (const int route : routes.groups()[g].routes) layout.groups[route] = static_cast<int>(g);
  for (const RouteGroup& group : routes.groups()) {
    const EstimatorDescriptor& estimator = descriptor_of(group, table);
    layout.merges.push_back(estimator.merges_with_radius);
    if (estimator.capabilities.per_pixel_state) layout.has_error = false;
  }
  return layout;
}

std::string quoted_list(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "'" : ", '") + name + "'";
  return text;
}

}  // namespace

EstimatorSet make_estimators(const RoutePlan& plan, const IntegratorOptions& options,
                             const Scene& scene, EstimatorTable table) {
  CompiledPlan compiled = compile_plan(plan, scene);
  std::vector<std::string> warnings;
  for (const RouteFinding& finding : compiled.compilation.findings)
    if (!finding.is_error) warnings.push_back(finding.message);
  EstimatorSet set = make_estimators(std::move(compiled), options, scene, table);
  set.warnings.insert(set.warnings.begin(), warnings.begin(), warnings.end());
  return set;
}

EstimatorSet make_estimators(CompiledPlan compiled, const IntegratorOptions& options,
                             const Scene& scene, EstimatorTable table) {
  const auto& symbols = compiled.symbols;
  EstimatorSet set;
  if (!symbols->unknown_labels().empty())
    set.warnings.push_back(
        "nothing in the scene is called " + quoted_list(symbols->unknown_labels()) +
        (symbols->unknown_is_mix() ? "; a mix goes by the labels of its materials" : "") +
        " (`nephroid info SCENE` lists the labels)");
  for (size_t i = 0; i < compiled.compilation.aov_matches.size(); ++i)
    if (!compiled.compilation.aov_matches[i])
      set.warnings.push_back("layer '" + compiled.compilation.routes.aovs()[i].name +
                             "' will be black: no path in this scene can match '" +
                             compiled.compilation.routes.aovs()[i].expression +
                             "' (lights are named in <L.'...'>, materials in <..'...'>)");
  const std::vector<std::string>& examples = compiled.compilation.examples;
  for (size_t r = 0; r < examples.size(); ++r) {
    const RouteDefinition& route = compiled.compilation.routes.definitions()[r];
    // Estimators that merge report this themselves. A preset has routes for any scene.
    if (compiled.has_own_routes && examples[r].empty() && !route.estimator->merges)
      set.notes.push_back("'" + route.name + "' is black: no path in this scene can belong to it");
  }
  const std::vector<bool> part_matches = compiled.compilation.part_matches;
  set.routes = std::make_shared<const Routes>(
      checked_routes(std::move(compiled.compilation), compiled.strict));
  set.layout = layout_of(*set.routes, part_matches, table);
  for (size_t g = 0; g < set.routes->groups().size(); ++g) {
    const EstimatorDescriptor& row = descriptor_of(set.routes->groups()[g], table);
    if (row.traits.connects) require_connecting_camera(scene, table);
    set.estimators.push_back(row.make({set.routes, symbols, g}, options));
  }
  if (std::none_of(set.estimators.begin(), set.estimators.end(),
                   [](const auto& estimator) { return estimator->records_features(); }))
    set.estimators.push_back(std::make_unique<FeatureEstimator>());
  return set;
}

void EstimatorSet::render_pass(const PassKey& key, const Scene& scene, Film& film,
                               PassControl& control) {
  learned.resize(estimators.size());
  for (size_t i = 0; i < estimators.size(); ++i) {
    const int group = static_cast<int>(i);
    if (film.is_whole(group)) continue;
    learned[i].render_pass(*estimators[i], key, scene, film, control);
    film.note_whole(group);
  }
  film.close_pass();
}

std::vector<EstimatorStatistics> EstimatorSet::statistics() const {
  std::vector<EstimatorStatistics> all;
  for (size_t i = 0; i < estimators.size(); ++i) {
    all.push_back(estimators[i]->statistics());
    if (i < learned.size()) learned[i].add_to(all.back());
  }
  return all;
}

}  // namespace nephroid
