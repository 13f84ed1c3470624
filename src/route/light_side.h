// Reverse determinisation: an automaton that reads the light side of a path from the light. It must
// not know expressions.
#pragma once

#include <vector>

#include "route/automaton.h"
#include "route/routes.h"

namespace nephroid {

/// A light state is a vector over eye states: the part that each eye side makes with this light
/// side. Light sides with equal vectors are one state.
struct LightSide {
  std::vector<std::vector<Part>> meet;  ///< [light state][eye state]
  std::vector<int> emitted;             ///< [light class]
  std::vector<int> next;                ///< [light state][event class]
};

/// `automaton` has parts as outputs. Throws UsageError if there are too many states.
LightSide reverse(const Automaton& automaton);

}  // namespace nephroid
