// A summary of a path: the facts that decide which sampling techniques can find it.
#pragma once

#include <compare>

#include "route/symbols.h"

namespace nephroid {

/// Progress towards two D or G in a row with only S and V before them: virtual point lights are
/// connected there.
enum class FirstRoughPair : uint8_t { kNone, kFirst, kBoth, kNever };

/// The events of a path, eye first.
struct EventSummary {
  int count = 0;                     ///< number of events; 2 stands for two or more
  bool any_rough = false;            ///< an event that is no S
  bool any_surface = false;          ///< a D or a G
  bool any_volume = false;           ///< a V
  bool volume_before_rough = false;  ///< the first event that is no S is a V
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

  /// True if a walk can hit the light.
  bool light_can_be_hit() const {
    return light != LightKind::kPoint && light != LightKind::kDistant;
  }
  /// True if the light can neither be hit nor connected to the last vertex. False for paths with S
  /// events only, which no technique finds.
  bool ends_out_of_reach() const {
    return !light_can_be_hit() && events.any_rough && events.last_specular;
  }
};

}  // namespace nephroid
