// Parts are numbered in the order of routes, then AOVs.
#include "route/owners.h"

#include <algorithm>
#include <map>
#include <utility>

#include "core/errors.h"

namespace nephroid {

bool can_reach(const RouteDefinition& route, LightKind light, bool touches_hair) {
  return (light != LightKind::kMedium && !touches_hair) || !route.estimator->starts_at_lights;
}

int owner_of(const WordMatches& matches, std::span<const RouteDefinition> routes, LightKind light) {
  for (const int r : matches.routes)
    if (can_reach(routes[r], light, matches.touches_hair)) return r;
  return kNoRoute;
}

PartAutomaton divide_into_parts(const MatchAutomaton& m, const SymbolClasses& classes,
                                std::span<const RouteDefinition> routes) {
  using Meaning = std::pair<int, std::vector<int>>;
  std::map<Meaning, int> numbers;
  const auto meaning_at = [&](int state, int light) -> const WordMatches& {
    return m.matches[m.automaton.at(state, light)];
  };
  const int states = static_cast<int>(m.automaton.states());
  const int lights = static_cast<int>(m.automaton.lights);
  for (int s = 0; s < states; ++s)
    for (int l = 0; l < lights; ++l) {
      const WordMatches& word = meaning_at(s, l);
      const int owner = owner_of(word, routes, classes.kind_of_light(l));
      if (!word.is_marked && owner != kNoRoute) numbers[{owner, word.aovs}] = 0;
    }
  if (numbers.size() > kNoPart)
    throw UsageError("the routes and AOVs overlap in " + std::to_string(numbers.size()) +
                     " combinations, expected at most " + std::to_string(kNoPart) +
                     ": use fewer overlapping AOVs");

  PartAutomaton result;
  for (auto& [meaning, number] : numbers) {
    number = static_cast<int>(result.parts.size());
    result.parts.push_back({meaning.first, meaning.second});
  }
  Automaton divided = m.automaton;
  for (int s = 0; s < states; ++s)
    for (int l = 0; l < lights; ++l) {
      const WordMatches& word = meaning_at(s, l);
      const int owner = owner_of(word, routes, classes.kind_of_light(l));
      const bool counts =
          owner != kNoRoute &&
          (!word.is_marked ||
           std::find(word.marked_by.begin(), word.marked_by.end(), owner) != word.marked_by.end());
      divided.output[s * lights + l] = counts ? numbers.at({owner, word.aovs}) : int{kNoPart};
    }
  result.automaton = minimise(divided);
  return result;
}

}  // namespace nephroid
