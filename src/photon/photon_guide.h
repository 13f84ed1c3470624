// The learned guides of photon paths: for emission, and for directions from rough surfaces.
#pragma once

#include "photon/caster_guide.h"
#include "photon/emission_guide.h"

namespace nephroid {

struct PhotonGuide {
  EmissionGuide starts;
  CasterGuide casters;
  static void members(auto& self, auto& archive) { archive(self.starts, self.casters); }
};

/// Guides nothing.
inline const PhotonGuide kUnguidedPhotons;

}  // namespace nephroid
