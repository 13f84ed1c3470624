// Translates events of walks to symbols of routes. It must not know estimators.
#pragma once

#include "route/scene_symbols.h"
#include "transport/random_walk.h"

namespace nephroid {

inline Label label_at(const SceneSymbols& symbols, const WalkVertex& v) {
  return symbols.material(v.material.index());
}

inline EventSymbol symbol_of(const SceneSymbols& symbols, const WalkEvent& event) {
  return event_symbol(
      event.letter, event.transmitted,
      event.medium >= 0 ? symbols.medium(event.medium) : symbols.material(event.material));
}

/// An event of class `c` at a vertex, towards the local direction `wi`.
inline EventSymbol symbol_at(const SceneSymbols& symbols, const WalkVertex& v, EventClass c,
                             const Vec3f& wi) {
  return event_symbol(v.letter(c), v.transmits(wi), label_at(symbols, v));
}

/// True if the vertex is on the lamp that a light belongs to; false for null.
inline bool is_on_lamp(const SceneSymbols& symbols, const WalkVertex* v, int light) {
  return v && v->surface.area_light >= 0 &&
         symbols.lamp(v->surface.area_light) == symbols.lamp(light);
}

inline EventSymbol symbol_in(const SceneSymbols& symbols, const Medium& medium) {
  return event_symbol(EventClass::kVolume, false, symbols.medium(medium.index()));
}

}  // namespace nephroid
