// What is stored where a photon lands.
#pragma once

#include "core/spectrum.h"
#include "route/routes.h"

namespace nephroid {

struct Photon {
  SampledSpectrum flux;  ///< at the pass's wavelengths; of a photon that dropped its secondary
                         ///< wavelengths only the hero's is meaningful
  Vec3f p{0, 0, 0};
  Vec3f wi{0, 0, 0};     ///< unit, back along the photon's path
  Vec3f ng{0, 0, 0};     ///< geometric normal of the surface
  LightState state = 0;  ///< of the light side, this vertex excluded
  uint8_t secondary_terminated = 0;
  uint8_t set = 0;      ///< of a map whose photons do not share one set of wavelengths
  uint16_t events = 0;  ///< scattering events before this vertex
  float cut_here = 0,
        cuts_before = 0;  ///< PartialMisWeights, where other techniques find the path, too

  static void members(auto& self, auto& archive) {
    archive(self.flux, self.p, self.wi, self.ng, self.state, self.secondary_terminated, self.set,
            self.events, self.cut_here, self.cuts_before);
  }
};

}  // namespace nephroid
