// From what matches a word to who owns it and to the part of the picture that it lies in.
// Who calls it: the compiler and the proof. It must not know tables.
#pragma once

#include <span>
#include <vector>

#include "route/automaton.h"
#include "route/routes.h"

namespace nephroid {

inline constexpr int kNoRoute = -1;

/// True if the route's estimator can make such light at all. What starts at lights cannot start in
/// a medium, and cannot pass hair: its scattering is known for walks from the eye only (ADR 9).
bool can_reach(const RouteDefinition& route, LightKind light, bool touches_hair);

/// The first of the routes that match a word and can reach its light, or kNoRoute.
int owner_of(const WordMatches& matches, std::span<const RouteDefinition> routes, LightKind light);

/// An automaton whose outputs are parts: those of words without a mark, and of marked words if
/// their owner merges exactly there; else kNoPart.
struct PartAutomaton {
  Automaton automaton;  ///< minimal
  std::vector<PartMeaning> parts;
};

/// Throws UsageError if there are too many parts.
PartAutomaton divide_into_parts(const MatchAutomaton& matches, const SymbolClasses& classes,
                                std::span<const RouteDefinition> routes);

}  // namespace nephroid
