// The proof that every path is rendered exactly once, decided on the automata. Each fault has a
// shortest path as witness. It must not know tables or scenes.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "route/compile.h"
#include "route/owners.h"

namespace nephroid {

struct ProofInput {
  std::span<const RouteDefinition> routes;
  const std::vector<std::string>& labels;
  const SymbolClasses& classes;
  const MatchAutomaton& matches;
  const PartAutomaton& parts;
  const SymbolSet* symbols;  ///< null: all symbols except light from media and hair
  bool camera_connects;      ///< light paths can be connected to the camera
};

struct Proof {
  std::vector<RouteFinding> findings;  ///< errors first
  std::vector<std::string> examples;   ///< [route]: a path of these symbols; empty if it owns none
  std::vector<bool> aov_matches;       ///< [AOV]: true if it matches a path of these symbols
  std::vector<bool> part_matches;      ///< [part]: true if a path of these symbols lies in it
};

/// Throws UsageError if there are too many cases.
Proof prove(const ProofInput& input);

}  // namespace nephroid
