// The record stored where a photon lands.
#pragma once

#include "photon/packed_values.h"
#include "route/lamp.h"
#include "route/routes.h"
#include "transport/casters.h"

namespace nephroid {

struct Photon {
  PackedSpectrum flux;  ///< at the pass's wavelengths; only [left] is valid if one is left
  Vec3f p{0, 0, 0};
  PackedDirection wi;             ///< direction back along the photon's path
  PackedDirection ng;             ///< geometric normal of the surface
  LightState state = 0;           ///< state of the light side, this vertex excluded
  int8_t left = kAllWavelengths;  ///< index of the only wavelength left, if others were dropped
  uint8_t set = 0;                ///< set of wavelengths, in a map with several sets
  uint16_t events = 0;            ///< scattering events before this vertex
  Lamp lamp = 0;                  ///< lamp that emitted it; not kept in files
  Caster caster = Caster::kNone;  ///< smoothest caster it passed (CasterRule); not kept in files
  /// Index of the medium in which it collided; -1: it lies on a surface. Not kept in files.
  int16_t medium = -1;
  /// PartialMisWeights, if other techniques find the path, too. These are squares of areas; their
  /// roots stay in the range of a float in any unit of length.
  float root_of_cut_here = 0, root_of_cuts_before = 0;

  static void members(auto& self, auto& archive) {
    archive(self.flux, self.p, self.wi, self.ng, self.state, self.left, self.set, self.events,
            self.root_of_cut_here, self.root_of_cuts_before);
  }
};

}  // namespace nephroid
