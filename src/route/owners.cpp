// Parts are numbered in the order of routes, then AOVs.
#include "route/owners.h"

#include <algorithm>
#include <map>
#include <utility>

#include "core/errors.h"

namespace nephroid {
namespace {

constexpr int kAllRoutes = -2;

/// [AOV]: number of the route whose paths alone count, kAllRoutes if all do, or kNoRoute.
std::vector<int> numbers_of_routes(std::span<const RouteDefinition> routes,
                                   std::span<const AovDefinition> aovs) {
  std::vector<int> numbers;
  for (const AovDefinition& aov : aovs) {
    const auto route = std::ranges::find(routes, aov.route, &RouteDefinition::name);
    numbers.push_back(aov.route.empty()       ? kAllRoutes
                      : route == routes.end() ? kNoRoute
                                              : static_cast<int>(route - routes.begin()));
  }
  return numbers;
}

}  // namespace

bool can_reach(const RouteDefinition& route, LightKind light, bool touches_hair) {
  return (light != LightKind::kMedium && !touches_hair) || !route.estimator->starts_at_lights;
}

int owner_of(const WordMatches& matches, std::span<const RouteDefinition> routes, LightKind light) {
  for (const int r : matches.routes)
    if (can_reach(routes[r], light, matches.touches_hair)) return r;
  return kNoRoute;
}

PartAutomaton divide_into_parts(const MatchAutomaton& m, const SymbolClasses& classes,
                                std::span<const RouteDefinition> routes,
                                std::span<const AovDefinition> aovs) {
  using Meaning = std::pair<int, std::vector<int>>;
  const std::vector<int> routes_of_aovs = numbers_of_routes(routes, aovs);
  std::map<Meaning, int> numbers;
  const auto word_at = [&](int state, int light) -> const WordMatches& {
    return m.matches[m.automaton.at(state, light)];
  };
  const auto meaning_of = [&](const WordMatches& word, int owner) {
    Meaning meaning{owner, word.aovs};
    std::erase_if(meaning.second, [&](int aov) {
      return routes_of_aovs[aov] != kAllRoutes && routes_of_aovs[aov] != owner;
    });
    return meaning;
  };
  const int states = static_cast<int>(m.automaton.states());
  const int lights = static_cast<int>(m.automaton.lights);
  for (int s = 0; s < states; ++s)
    for (int l = 0; l < lights; ++l) {
      const WordMatches& word = word_at(s, l);
      const int owner = owner_of(word, routes, classes.kind_of_light(l));
      if (!word.is_marked && owner != kNoRoute) numbers[meaning_of(word, owner)] = 0;
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
      const WordMatches& word = word_at(s, l);
      const int owner = owner_of(word, routes, classes.kind_of_light(l));
      const bool counts =
          owner != kNoRoute &&
          (!word.is_marked ||
           std::find(word.marked_by.begin(), word.marked_by.end(), owner) != word.marked_by.end());
      divided.output[s * lights + l] = counts ? numbers.at(meaning_of(word, owner)) : int{kNoPart};
    }
  result.automaton = minimise(divided);
  return result;
}

}  // namespace nephroid
