// Classes of symbols that no atom of a set of expressions distinguishes. Automata are built over
// the few classes and written out for symbols at the end. It must not know automata.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "route/expression.h"

namespace nephroid {

/// Classes of events and of lights, each numbered from 0 in the order of their first symbols.
/// Events of one class have the same EventClass, lights of one class the same LightKind.
struct SymbolClasses {
  static constexpr int kNone = -1;             ///< class of numbers that are no symbol
  std::vector<int> event_class;                ///< [EventSymbol]
  std::vector<int> light_class;                ///< [LightSymbol]
  std::vector<EventSymbol> events;             ///< [class]: its first symbol
  std::vector<LightSymbol> lights;             ///< [class]: its first symbol
  std::vector<std::vector<bool>> reads_event;  ///< [atom][event class]
  std::vector<std::vector<bool>> reads_light;  ///< [atom][light class]
  std::vector<bool> reads_eye;                 ///< [atom]

  EventClass class_of_event(int c) const { return class_of(kind_of(events[c])); }
  LightKind kind_of_light(int c) const { return nephroid::kind_of_light(lights[c]); }
};

/// `labels[i]` is Label i + 1 and includes all labels of the atoms.
SymbolClasses classify_symbols(std::span<const ExpressionAtom* const> atoms,
                               const std::vector<std::string>& labels);

}  // namespace nephroid
