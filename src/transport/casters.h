// Behind which events photons are merged: everywhere, or only where the light has come by way of a
// caster, which is an S or, if wished, an S or G. A merge at a D needs any caster between it and
// the light, one at a G needs an S: what one G throws onto another walks find, and few photons lie
// within a lobe. Both sides of a path must agree on this. It must not know photons or weights.
#pragma once

#include <algorithm>

#include "scene/bsdf/bsdf.h"

namespace nephroid {

/// The smoothest caster between a vertex and the light.
enum class Caster : uint8_t { kNone, kGlossy, kSpecular };
inline constexpr size_t kCasters = 3;

class CasterRule {
 public:
  /// `casters`: kSpecular, or that and kGlossy; kNone: photons are merged everywhere.
  explicit CasterRule(ClassMask casters = ClassMask::kNone) : casters_(casters) {}

  bool merges_all_light() const { return casters_ == ClassMask::kNone; }
  /// What an event is between a vertex and the light.
  Caster caster_of(EventClass letter) const {
    if (!contains(casters_, letter)) return Caster::kNone;
    return letter == EventClass::kSpecular ? Caster::kSpecular : Caster::kGlossy;
  }
  /// The smoothest one, with that of an event in front of `behind`.
  Caster with(EventClass letter, Caster behind) const {
    return std::max(caster_of(letter), behind);
  }
  /// Classes of events that merge where `behind` stands between them and the light.
  ClassMask receivers(Caster behind) const {
    if (merges_all_light() || behind == Caster::kSpecular) return ClassMask::kRough;
    return behind == Caster::kGlossy ? ClassMask::kDiffuse : ClassMask::kNone;
  }

 private:
  ClassMask casters_;
};

}  // namespace nephroid
