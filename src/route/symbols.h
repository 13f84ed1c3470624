// The alphabet of light path expressions as small integers. A path is a word C e1 e2 ... en l: its
// events, eye first, and its light. An event has a class, a side and a label, a light has a kind
// and a label (docs/routes.md). It must not know expressions.
#pragma once

#include <cstdint>

#include "scene/bsdf/bsdf.h"

namespace nephroid {

/// Label of a material, medium or light, counted from 1; 0 if no expression mentions its name.
using Label = uint16_t;

/// Kind of an event: the low three bits of an EventSymbol. V and H have no side.
enum class EventKind : uint8_t { kDR, kDT, kGR, kGT, kSR, kST, kV, kH };
inline constexpr int kEventKinds = 8;

/// An event: 8 * label + kind.
using EventSymbol = uint16_t;

constexpr EventSymbol event_symbol(EventKind kind, Label label) {
  return static_cast<EventSymbol>(label << 3 | static_cast<int>(kind));
}
constexpr EventSymbol event_symbol(EventClass c, bool transmitted, Label label) {
  const int kind = c == EventClass::kVolume ? static_cast<int>(EventKind::kV)
                   : c == EventClass::kHair ? static_cast<int>(EventKind::kH)
                                            : 2 * static_cast<int>(c) + (transmitted ? 1 : 0);
  return static_cast<EventSymbol>(label << 3 | kind);
}
constexpr EventKind kind_of(EventSymbol s) {
  return static_cast<EventKind>(s & 7);
}
constexpr Label label_of(EventSymbol s) {
  return static_cast<Label>(s >> 3);
}
constexpr EventClass class_of(EventKind kind) {
  return kind == EventKind::kH ? EventClass::kHair
                               : static_cast<EventClass>(static_cast<int>(kind) >> 1);
}
constexpr bool is_transmission(EventKind kind) {
  return kind == EventKind::kDT || kind == EventKind::kGT || kind == EventKind::kST;
}

/// Kinds of lights. L is any of them, O an emissive shape, B an infinite light (environment or
/// distant), M an emissive medium. Walks cannot hit point and distant lights.
enum class LightKind : uint8_t { kShape, kEnvironment, kDistant, kPoint, kMedium };
inline constexpr int kLightKinds = 5;

/// A light: 8 * label + kind.
using LightSymbol = uint16_t;

constexpr LightSymbol light_symbol(LightKind kind, Label label) {
  return static_cast<LightSymbol>(label << 3 | static_cast<int>(kind));
}
constexpr LightKind kind_of_light(LightSymbol s) {
  return static_cast<LightKind>(s & 7);
}
constexpr Label label_of_light(LightSymbol s) {
  return static_cast<Label>(s >> 3);
}

}  // namespace nephroid
