// The proof that every path is rendered once: what can be decided on the automata, with a shortest
// path as witness for each fault.
// Who calls it: compile_routes. It must not know tables or scenes.
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
  const SymbolSet* symbols;  ///< null: all, but no light from media
  bool camera_connects;      ///< light paths can be connected to the camera
};

struct Proof {
  std::vector<RouteFinding> findings;  ///< errors first
  std::vector<std::string> examples;   ///< [route]: empty if it owns no path of these symbols
  std::vector<bool> aov_matches;       ///< [AOV]: any path of these symbols
};

/// Throws UsageError if there are too many cases to look at.
Proof prove(const ProofInput& input);

}  // namespace nephroid
