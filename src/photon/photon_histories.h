// The photons of a small pass, and the whole light path of each photon, traced again when it is
// wanted. It must not know how light paths are traced.
#pragma once

#include <functional>
#include <unordered_map>
#include <vector>

#include "photon/photon_grid.h"
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

  /// Traces the light paths 0 to `count` - 1.
  PhotonHistories(int64_t count, const Trace& trace, Record record)
      : PhotonHistories(traced(count, trace), std::move(record)) {}

  const PhotonGrid& grid() const { return grid_; }
  /// The light path that left a photon of the grid.
  const LightPathRecord& of(const Photon& photon) {
    const int64_t number = paths_[order_[&photon - grid_.photons().data()]];
    const auto known = records_.find(number);
    return known != records_.end() ? known->second
                                   : records_.emplace(number, record_(number)).first->second;
  }

 private:
  PhotonHistories(Traced traced, Record record)
      : grid_(std::move(traced.photons), &order_),
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

  std::vector<uint32_t> order_;  ///< [photon of the grid]: its place before it was sorted
  PhotonGrid grid_;
  std::vector<int64_t> paths_;
  Record record_;
  std::unordered_map<int64_t, LightPathRecord> records_;
};

}  // namespace nephroid
