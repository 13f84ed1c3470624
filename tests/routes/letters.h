// Words of plain letters, "DDS", followed through compiled routes: reflection events without
// labels.
#pragma once

#include <string>
#include <vector>

#include "integrator/presets/estimator_table.h"
#include "integrator/presets/route_presets.h"
#include "route/compile.h"

namespace nephroid {

inline EventSymbol event_of(char letter) {
  const EventClass c = letter == 'D'   ? EventClass::kDiffuse
                       : letter == 'G' ? EventClass::kGlossy
                       : letter == 'S' ? EventClass::kSpecular
                       : letter == 'H' ? EventClass::kHair
                                       : EventClass::kVolume;
  return event_symbol(c, false, 0);
}

/// All words of up to `length` of these letters, including the empty one.
inline std::vector<std::string> words(int length, const std::string& letters) {
  std::vector<std::string> all{""};
  for (size_t i = 0; i < all.size(); ++i)
    if (static_cast<int>(all[i].size()) < length)
      for (const char letter : letters) {
        const std::string longer = all[i] + letter;
        all.push_back(longer);
      }
  return all;
}

inline EyeState read_from_eye(const Routes& routes, const std::string& events) {
  EyeState state = routes.start();
  for (const char e : events) state = routes.next(state, event_of(e));
  return state;
}

inline LightState read_from_light(const Routes& routes, const std::string& events,
                                  LightKind light = LightKind::kShape) {
  LightState state = routes.emitted(light_symbol(light, 0));
  for (size_t i = events.size(); i-- > 0;) state = routes.light_next(state, event_of(events[i]));
  return state;
}

/// Name of the route that owns C `events` and a light, "" if there is none.
inline std::string owner_name(const Routes& routes, const std::string& events,
                              LightKind light = LightKind::kShape) {
  const Part part = routes.owner(read_from_eye(routes, events), light_symbol(light, 0));
  if (part == kNoPart) return "";
  return routes.definitions()[static_cast<size_t>(routes.parts()[part].route)].name;
}

inline RouteCompilation compiled(const std::vector<std::string>& texts,
                                 const std::vector<std::string>& aovs = {},
                                 const SymbolSet* symbols = nullptr, bool camera_connects = true) {
  std::vector<RouteDefinition> routes;
  for (const std::string& text : texts) routes.push_back(parse_route(text, estimator_traits()));
  std::vector<AovDefinition> layers;
  for (const std::string& text : aovs) layers.push_back(parse_aov(text));
  return compile_routes(routes, layers, symbols, camera_connects);
}

inline Routes preset(const std::string& name) {
  return compile_routes(route_preset(name).value(), {}).routes;
}

/// Symbols without labels: events of these letters on both sides, and lights of these kinds.
inline SymbolSet symbols_of(const std::string& letters, const std::vector<LightKind>& lights) {
  SymbolSet set{std::vector<bool>(8), std::vector<bool>(8)};
  for (const char letter : letters)
    for (const bool transmitted : {false, true})
      set.events[event_symbol(class_of(kind_of(event_of(letter))), transmitted, 0)] = true;
  for (const LightKind kind : lights) set.lights[light_symbol(kind, 0)] = true;
  return set;
}

}  // namespace nephroid
