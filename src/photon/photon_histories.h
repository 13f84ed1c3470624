// The photons of a small pass, and the whole light path of each photon, traced again when it is
// wanted. It must not know how light paths are traced.
#pragma once

#include <functional>
#include <unordered_map>
#include <vector>

#include "photon/photon_maps.h"
#include "transport/walk_record.h"

namespace nephroid {

class PhotonHistories {
 public:
  /// Photons in the order in which they were traced, each with the number of its light path.
  struct Traced {
    std::vector<Photon> photons;
    std::vector<int64_t> paths;
  };
  /// Traces light path `number` and adds its photons.
  using Trace = std::function<void(int64_t number, std::vector<Photon>& photons)>;
  /// Traces it again with a record.
  using Record = std::function<LightPathRecord(int64_t number)>;

  /// Traces the light paths 0 to `count` - 1. `radius_at` as in MediumPhotons,
  /// not needed if no photons are in media.
  PhotonHistories(int64_t count, const Trace& trace, Record record,
                  const std::function<float(const Vec3f&)>& radius_at = {})
      : PhotonHistories(traced(count, trace), std::move(record), radius_at) {}

  const PhotonMaps& maps() const { return maps_; }
  /// The light path that left a photon of the maps.
  const LightPathRecord& of(const Photon& photon) {
    const int64_t number = paths_[maps_.place_of(photon)];
    const auto known = records_.find(number);
    return known != records_.end() ? known->second
                                   : records_.emplace(number, record_(number)).first->second;
  }

 private:
  PhotonHistories(Traced traced, Record record, const std::function<float(const Vec3f&)>& radius_at)
      : maps_(std::move(traced.photons), radius_at, true),
        paths_(std::move(traced.paths)),
        record_(std::move(record)) {}
  static Traced traced(int64_t count, const Trace& trace) {
    Traced all;
    for (int64_t j = 0; j < count; ++j) {
      trace(j, all.photons);
      all.paths.resize(all.photons.size(), j);
    }
    return all;
  }

  PhotonMaps maps_;
  std::vector<int64_t> paths_;
  Record record_;
  std::unordered_map<int64_t, LightPathRecord> records_;
};

}  // namespace nephroid
