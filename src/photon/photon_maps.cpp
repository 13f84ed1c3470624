#include "photon/photon_maps.h"

#include <algorithm>

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
  const auto count = static_cast<size_t>(std::ranges::count_if(photons, in_medium));
  if (count == 0) {
    parts.of_surfaces = std::move(photons);
    return parts;
  }
  parts.of_media.reserve(count);
  parts.of_surfaces.reserve(photons.size() - count);
  for (const Photon& photon : photons)
    (in_medium(photon) ? parts.of_media : parts.of_surfaces).push_back(photon);
  return parts;
}

size_t PhotonMaps::place_of(const Photon& photon) const {
  if (photon.medium >= 0) return medium_places_[medium_order_[&photon - media_.photons().data()]];
  return surface_places_[surface_order_[&photon - surfaces_.photons().data()]];
}

}  // namespace nephroid
