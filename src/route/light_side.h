// Reverse determinisation: what the light side of a path, read from the light, says about every eye
// side. Who calls it: the compiler. It must not know expressions.
#pragma once

#include <vector>

#include "route/automaton.h"
#include "route/routes.h"

namespace nephroid {

/// States are vectors over eye states: the part of the word that an eye side makes with this light
/// side. Two light sides with the same vector are the same state.
struct LightSide {
  std::vector<std::vector<Part>> meet;  ///< [light state][eye state]
  std::vector<int> emitted;             ///< [class of lights]
  std::vector<int> next;                ///< [light state][class of events]
};

/// `automaton` has parts as outputs. Throws UsageError if there are too many states.
LightSide reverse(const Automaton& automaton);

}  // namespace nephroid
