// Hostile light path expressions and route files, compiled and proved; see targets.h.
#include "core/errors.h"
#include "fuzz/targets.h"
#include "integrator/presets/estimator_table.h"
#include "route/compile.h"

namespace nephroid::fuzz {
namespace {

constexpr std::string_view kAov = "--aov ";

/// Reads words of all symbols from both ends and traps where the owners differ.
void use(const Routes& routes) {
  const RouteTables& t = routes.tables();
  const auto events = static_cast<EventSymbol>(t.event_symbols);
  const auto lights = static_cast<LightSymbol>(t.light_symbols);
  bool good = t.eye_states > 0 && t.light_states > 0 && routes.start() < t.eye_states;
  for (EventSymbol first = 0; first < events; ++first)
    for (EventSymbol second = 0; second < events; ++second)
      for (LightSymbol light = 0; light < lights; ++light) {
        if ((first & 7) == 7 || (second & 7) == 7 || (light & 7) >= kLightKinds) continue;
        const EyeState before = routes.next(routes.start(), first);
        const EyeState eye = routes.next(before, second);
        const LightState emitted = routes.emitted(light);
        const Part owner = routes.owner(eye, light);
        good = good && routes.meet(eye, emitted) == owner &&
               routes.meet(before, routes.light_next(emitted, second)) == owner &&
               (owner == kNoPart || owner < routes.parts().size());
        const Part merged = routes.meet(routes.merge(before, second), emitted);
        good = good && (merged == kNoPart || merged == owner);
      }
  if (!good) __builtin_trap();
}

}  // namespace

void routes(const std::string& bytes) {
  std::string file;
  std::vector<std::string> aov_lines;
  for (size_t start = 0; start < bytes.size();) {
    const size_t end = std::min(bytes.find('\n', start), bytes.size() - 1) + 1;
    const std::string line = bytes.substr(start, end - start);
    if (line.rfind(kAov, 0) == 0)
      aov_lines.push_back(line.substr(kAov.size(), line.find_last_not_of('\n') + 1 - kAov.size()));
    else
      file += line;
    start = end;
  }
  try {
    const std::vector<RouteDefinition> definitions =
        parse_route_file(file, estimator_traits(), "fuzz.routes");
    std::vector<AovDefinition> aovs;
    for (const std::string& line : aov_lines) aovs.push_back(parse_aov(line));
    const RouteCompilation compilation = compile_routes(definitions, aovs);
    use(compilation.routes);
    checked_routes(compilation, false);
  } catch (const Error&) {
  }
}

}  // namespace nephroid::fuzz
