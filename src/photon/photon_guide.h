// What was learned about the paths of photons: where they should start and where they should go
// from rough surfaces.
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
