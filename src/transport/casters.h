// Where photons are merged: everywhere, or only if light arrived by way of a caster: an S, or as
// options a G, or any event. A merge at a D needs any caster between it and the light. One at a G
// needs an S, unless any event is a caster. (Camera walks find light from G to G, and few photons
// lie within a G lobe.) Both sides of a path must agree on this. It must not know photons or
// weights.
#pragma once

#include <algorithm>

#include "scene/bsdf/bsdf.h"

namespace nephroid {

/// The smoothest caster between a vertex and the light.
enum class Caster : uint8_t { kNone, kGlossy, kSpecular };
inline constexpr size_t kCasters = 3;

class CasterRule {
 public:
  /// `casters`: kSpecular, or kSpecular and kGlossy. kAll: any event is a caster, so photons of all
  /// light are merged, but for those that come straight from a light. kNone: these are merged, too.
  explicit CasterRule(ClassMask casters = ClassMask::kNone) : casters_(casters) {}

  bool merges_all_light() const {
    return casters_ == ClassMask::kNone || casters_ == ClassMask::kAll;
  }
  bool merges_direct_light() const { return casters_ == ClassMask::kNone; }
  /// True if whatever lets one vertex merge lets each D and G in front of it merge, too. Glossy
  /// casters do so for D alone.
  bool holds_in_front() const { return casters_ != (ClassMask::kSpecular | ClassMask::kGlossy); }
  /// The caster that an event between a vertex and the light is.
  Caster caster_of(EventClass letter) const {
    if (merges_all_light()) return Caster::kSpecular;
    if (!contains(casters_, letter)) return Caster::kNone;
    return letter == EventClass::kSpecular ? Caster::kSpecular : Caster::kGlossy;
  }
  /// The smoother one of `behind` and an event in front of it.
  Caster with(EventClass letter, Caster behind) const {
    return std::max(caster_of(letter), behind);
  }
  /// Event classes that merge if `behind` is the smoothest caster between them and the light.
  ClassMask receivers(Caster behind) const {
    if (casters_ == ClassMask::kNone || behind == Caster::kSpecular) return ClassMask::kRough;
    return behind == Caster::kGlossy ? ClassMask::kDiffuse : ClassMask::kNone;
  }

 private:
  ClassMask casters_;
};

}  // namespace nephroid
