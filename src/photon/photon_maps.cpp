#include "photon/photon_maps.h"

#include <algorithm>
#include <iterator>

namespace nephroid {

PhotonMaps::PhotonMaps(std::vector<Photon> photons,
                       const std::function<float(const Vec3f&)>& radius_at, bool keeps_order)
    : PhotonMaps(divided(std::move(photons), keeps_order), radius_at, keeps_order) {}

PhotonMaps::PhotonMaps(Parts parts, const std::function<float(const Vec3f&)>& radius_at,
                       bool keeps_order)
    : surface_places_(std::move(parts.places_of_surfaces)),
      medium_places_(std::move(parts.places_of_media)),
      surfaces_(std::move(parts.of_surfaces), keeps_order ? &surface_order_ : nullptr),
      media_(std::move(parts.of_media), radius_at, keeps_order ? &medium_order_ : nullptr) {}

PhotonMaps::Parts PhotonMaps::divided(std::vector<Photon> photons, bool keeps_order) {
  Parts parts;
  const auto in_medium = [](const Photon& photon) { return photon.medium >= 0; };
  if (keeps_order)
    for (uint32_t i = 0; i < photons.size(); ++i)
      (in_medium(photons[i]) ? parts.places_of_media : parts.places_of_surfaces).push_back(i);
  if (const auto count = std::ranges::count_if(photons, in_medium); count > 0) {
    parts.of_media.reserve(static_cast<size_t>(count));
    std::ranges::copy_if(photons, std::back_inserter(parts.of_media), in_medium);
    std::erase_if(photons, in_medium);
  }
  parts.of_surfaces = std::move(photons);
  return parts;
}

size_t PhotonMaps::place_of(const Photon& photon) const {
  if (photon.medium >= 0) return medium_places_[medium_order_[&photon - media_.photons().data()]];
  return surface_places_[surface_order_[&photon - surfaces_.photons().data()]];
}

}  // namespace nephroid
