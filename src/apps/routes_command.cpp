// `nephroid routes`: prints the routes, their automaton and the proof. With a scene it also
// measures the share of each route in the light: the answer to "why do I see no caustic?".
#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "apps/commands.h"
#include "apps/messages.h"
#include "core/counted.h"
#include "core/errors.h"
#include "film/film_settings.h"
#include "integrator/presets/estimator_set.h"
#include "session/render.h"
#include "session/report/choices_report.h"
#include "session/report/noise.h"

namespace nephroid {
namespace {

/// Pixels of the longer side of the pilot's picture.
constexpr int kPilotSize = 128;

size_t longest(const std::vector<RouteDefinition>& routes, std::string RouteDefinition::*text) {
  size_t length = 0;
  for (const RouteDefinition& route : routes) length = std::max(length, (route.*text).size());
  return length;
}

void print_routes(const RoutePlan& plan, const RouteCompilation& compiled) {
  const size_t name = longest(plan.routes, &RouteDefinition::name);
  const size_t expression = longest(plan.routes, &RouteDefinition::expression);
  fmt::print("routes, the first that matches a path owns it:\n");
  for (size_t i = 0; i < plan.routes.size(); ++i) {
    const RouteDefinition& route = plan.routes[i];
    fmt::print("  {:{}}  {:{}}  {:13}  {}\n", route.name, name, route.expression, expression,
               route.estimator->name,
               compiled.examples[i].empty() ? std::string("(no path in it)")
                                            : "for example " + compiled.examples[i]);
  }
  for (const AovDefinition& aov : plan.aovs)
    fmt::print("  {:{}}  {:{}}  a layer of its own\n", aov.name, name, aov.expression, expression);
}

/// Number of eye states that are reached without merging.
size_t plain_states(const Routes& routes) {
  std::vector<bool> seen(routes.tables().eye_states);
  std::vector<EyeState> todo{routes.start()};
  seen[routes.start()] = true;
  size_t count = 0;
  while (!todo.empty()) {
    const EyeState s = todo.back();
    todo.pop_back();
    ++count;
    for (size_t e = 0; e < routes.tables().event_symbols; ++e) {
      if ((e & 7) >= kEventKinds) continue;
      const EyeState next = routes.next(s, static_cast<EventSymbol>(e));
      if (!seen[next]) todo.push_back(next);
      seen[next] = true;
    }
  }
  return count;
}

void print_automaton(const Routes& routes) {
  const RouteTables& t = routes.tables();
  const size_t plain = plain_states(routes);
  const size_t bytes = t.eye_next.bytes() + t.merge_next.bytes() + t.owner.size() +
                       t.emitted.bytes() + t.light_next.bytes() + t.meet.size();
  fmt::print(
      "automaton: {} from the eye, {} more behind a merge, {} from the light, "
      "{} kinds of events, {} of lights, {} bytes\n",
      counted(plain, "state"), t.eye_states - plain, counted(t.light_states, "state"),
      t.event_symbols / 8 * kEventKinds, t.light_symbols / 8 * kLightKinds, bytes);
}

/// Prints the proof; true if the routes can be rendered.
bool print_proof(const RouteCompilation& compiled, bool strict) {
  const bool overlap =
      std::any_of(compiled.findings.begin(), compiled.findings.end(),
                  [](const RouteFinding& f) { return f.kind == RouteFinding::Kind::kOverlap; });
  const bool broken = std::any_of(compiled.findings.begin(), compiled.findings.end(),
                                  [](const RouteFinding& f) { return f.is_error; });
  fmt::print("proof: {}, {}\n", counted(plain_states(compiled.routes), "state"),
             broken    ? "failed"
             : overlap ? "complete, disjoint only because the first match wins"
                       : "complete, disjoint");
  for (const RouteFinding& finding : compiled.findings)
    fmt::print("{}: {}\n",
               finding.is_error || (strict && finding.kind == RouteFinding::Kind::kOverlap)
                   ? "error"
                   : "warning",
               finding.message);
  return !broken && !(strict && overlap);
}

/// Renders a small picture of the scene and prints its light by route and layer, and the
/// estimators' notes.
void print_pilot(const RoutesCommand& command, const RoutePlan& plan, CompiledPlan compiled,
                 const IntegratorOptions& options, const Scene& scene) {
  EstimatorSet set = make_estimators(std::move(compiled), options, scene);
  for (const std::string& warning : set.warnings) print_warning(warning);
  Film film(film_settings(scene.film), set.layout);
  for (uint32_t pass = 0; pass < command.passes; ++pass)
    set.render_pass({scene.scene_seed, pass}, scene, film);
  fmt::print("light of {} ({} at {} x {}):\n", command.scene,
             counted(command.passes, "pass", "passes"), scene.film.width, scene.film.height);
  const EnergyShares shares = energy_shares(film);
  for (size_t i = 0; i < plan.routes.size(); ++i)
    fmt::print("  {:16} {:6.3g} %\n", plan.routes[i].name, 100 * shares.routes[i]);
  for (size_t i = 0; i < plan.aovs.size(); ++i)
    fmt::print("  {:16} {:6.3g} % (layer)\n", plan.aovs[i].name, 100 * shares.aovs[i]);
  const std::vector<EstimatorStatistics> statistics = set.statistics();
  for (const std::string& line : technique_report(statistics)) fmt::print("{}\n", line);
  for (const EstimatorStatistics& s : statistics)
    for (const std::string& note : s.notes) fmt::print("note: {}\n", note);
}

}  // namespace

int run_routes(const RoutesCommand& command) {
  if (command.scene.empty()) {
    const RoutePlan plan =
        plan_of(command.routes, command.routes.integrator_or(kDefaultIntegrator));
    const RouteCompilation compiled = compile_routes(plan.routes, plan.aovs);
    print_routes(plan, compiled);
    print_automaton(compiled.routes);
    const bool sound = print_proof(compiled, plan.strict);
    return static_cast<int>(sound ? ExitStatus::kDone : ExitStatus::kUsage);
  }
  RenderRequest request;
  request.scene = command.scene;
  request.overrides.import = command.import;
  request.routes = command.routes;
  request.settings = render_settings(command.settings);
  const LoadedScene loaded = load_small_scene(request, kPilotSize);
  print_warnings(loaded.warnings);
  print_notes(loaded.notes);
  const Scene& scene = *loaded.scene;
  const IntegratorChoice choice = choose_integrator(request, scene);
  const RoutePlan plan = plan_of(command.routes, choice.name);
  CompiledPlan compiled = compile_plan(plan, scene);
  print_routes(plan, compiled.compilation);
  print_automaton(compiled.compilation.routes);
  if (!print_proof(compiled.compilation, plan.strict)) return static_cast<int>(ExitStatus::kUsage);
  print_pilot(command, plan, std::move(compiled), choice.settings.integrator, scene);
  return static_cast<int>(ExitStatus::kDone);
}

}  // namespace nephroid
