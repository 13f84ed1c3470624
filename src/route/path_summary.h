// A path in the few facts that decide which sampling techniques can make it.
#pragma once

#include <compare>

#include "route/symbols.h"

namespace nephroid {

/// How far a path has come to two D or G in a row with only S and V before them: there, virtual
/// point lights are connected.
enum class FirstRoughPair : uint8_t { kNone, kFirst, kBoth, kNever };

/// The events of a path, eye first.
struct EventSummary {
  int count = 0;             ///< 2 stands for two and more
  bool any_rough = false;    ///< an event that is no S
  bool any_surface = false;  ///< a D or a G
  bool any_volume = false;   ///< a V
  bool first_specular = false, last_specular = false;
  bool rough_pair = false;  ///< two events in a row that are no S
  FirstRoughPair first_pair = FirstRoughPair::kNone;

  /// The same path with one more event towards the light.
  EventSummary after(EventClass event) const;
  auto operator<=>(const EventSummary&) const = default;
};

struct PathSummary {
  EventSummary events;
  LightKind light = LightKind::kShape;
  bool camera_connects = true;  ///< light paths can be connected to the camera

  /// A walk can meet the light.
  bool light_can_be_hit() const {
    return light != LightKind::kPoint && light != LightKind::kDistant;
  }
  /// Neither can the light be hit, nor can the last vertex be connected to it. False for paths of S
  /// alone, which nobody sees.
  bool ends_out_of_reach() const {
    return !light_can_be_hit() && events.any_rough && events.last_specular;
  }
};

}  // namespace nephroid
