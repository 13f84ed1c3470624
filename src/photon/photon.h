// What is stored where a photon lands.
#pragma once

#include "photon/packed_values.h"
#include "route/lamp.h"
#include "route/routes.h"

namespace nephroid {

struct Photon {
  PackedSpectrum flux;  ///< at the pass's wavelengths; of a photon that dropped its secondary
                        ///< wavelengths only the hero's is meaningful
  Vec3f p{0, 0, 0};
  PackedDirection wi;    ///< back along the photon's path
  PackedDirection ng;    ///< geometric normal of the surface
  LightState state = 0;  ///< of the light side, this vertex excluded
  uint8_t secondary_terminated = 0;
  uint8_t set = 0;      ///< of a map whose photons do not share one set of wavelengths
  uint16_t events = 0;  ///< scattering events before this vertex
  Lamp lamp = 0;        ///< that it comes from; not kept in files
  float cut_here = 0,
        cuts_before = 0;  ///< PartialMisWeights, where other techniques find the path, too

  static void members(auto& self, auto& archive) {
    archive(self.flux, self.p, self.wi, self.ng, self.state, self.secondary_terminated, self.set,
            self.events, self.cut_here, self.cuts_before);
  }
};

}  // namespace nephroid
