// The owner of a word and the part of the picture it belongs to, by the routes and AOVs that match.
// It must not know tables.
#pragma once

#include <span>
#include <vector>

#include "route/automaton.h"
#include "route/routes.h"

namespace nephroid {

inline constexpr int kNoRoute = -1;

/// True if the route's estimator can reach such light. One that starts at lights can neither start
/// in a medium nor pass hair, whose scattering is known only for walks from the eye (ADR 9).
bool can_reach(const RouteDefinition& route, LightKind light, bool touches_hair);

/// The first route that matches a word and can reach its light, or kNoRoute.
int owner_of(const WordMatches& matches, std::span<const RouteDefinition> routes, LightKind light);

/// An automaton whose outputs are parts. A marked word has a part only if its owner merges exactly
/// at the mark; else it has kNoPart.
struct PartAutomaton {
  Automaton automaton;  ///< minimal
  std::vector<PartMeaning> parts;
};

/// Throws UsageError if there are too many parts.
PartAutomaton divide_into_parts(const MatchAutomaton& matches, const SymbolClasses& classes,
                                std::span<const RouteDefinition> routes,
                                std::span<const AovDefinition> aovs);

}  // namespace nephroid
