// The photons of a pass, on surfaces and in media. It must not know how they are merged.
#pragma once

#include "photon/medium_photons.h"
#include "photon/photon_grid.h"

namespace nephroid {

class PhotonMaps {
 public:
  /// `radius_at` as in MediumPhotons. With `keeps_order`, place_of() can be asked.
  PhotonMaps(std::vector<Photon> photons, const std::function<float(const Vec3f&)>& radius_at,
             bool keeps_order = false);

  const PhotonGrid& surfaces() const { return surfaces_; }
  const MediumPhotons& media() const { return media_; }
  size_t bytes() const { return surfaces_.bytes() + media_.bytes(); }
  /// The place of a photon of either map in the constructor's argument.
  size_t place_of(const Photon& photon) const;

 private:
  struct Parts {
    std::vector<Photon> of_surfaces, of_media;
    std::vector<uint32_t> places_of_surfaces, places_of_media;
  };
  PhotonMaps(Parts parts, const std::function<float(const Vec3f&)>& radius_at, bool keeps_order);
  static Parts divided(std::vector<Photon> photons, bool keeps_order);

  std::vector<uint32_t> surface_places_, medium_places_;  ///< before the photons were divided
  std::vector<uint32_t> surface_order_, medium_order_;    ///< before they were sorted
  PhotonGrid surfaces_;
  MediumPhotons media_;
};

}  // namespace nephroid
