// Finds the photons around a point: all within a radius, or the nearest ones. Photons are in Morton
// order. Each level has cells of twice the size, which are runs of that order, and a hash table
// with full cell codes; so queries of any radius are cheap and buckets never mix cells. It must not
// know BSDFs or films.
#pragma once

#include <algorithm>
#include <cmath>
#include <compare>
#include <cstdint>
#include <vector>

#include "photon/photon.h"

namespace nephroid {

class PhotonGrid {
 public:
  /// Takes the photons and sorts them. `order`, if it is not null, receives for each of photons()
  /// its index in the argument.
  explicit PhotonGrid(std::vector<Photon> photons, std::vector<uint32_t>* order = nullptr);

  size_t size() const { return photons_.size(); }
  const std::vector<Photon>& photons() const { return photons_; }
  /// Peak memory of the photons and the grid, construction included.
  size_t bytes() const { return bytes_; }

  /// Calls found(photon, distance_squared) for every photon with |photon.p - center| <= radius, in
  /// an order that depends on the photons and the query alone.
  template <class F>
  void query(const Vec3f& center, float radius, F&& found) const {
    if (photons_.empty()) return;
    const float r2 = radius * radius;
    Runs runs;
    find_runs(center, radius, runs);
    // Near photons are first collected without branches, then passed on.
    uint32_t near[kCollected];
    float distances[kCollected];
    for (int k = 0; k < runs.count; ++k) {
      for (uint32_t i = runs.begin[k]; i < runs.end[k];) {
        const uint32_t end = std::min(runs.end[k], i + kCollected);
        uint32_t count = 0;
        for (; i < end; ++i) {
          const Vec3f d = positions_[i] - center;
          const float d2 = dot(d, d);
          near[count] = i;
          distances[count] = d2;
          count += d2 <= r2;
        }
        for (uint32_t j = 0; j < count; ++j) found(photons_[near[j]], distances[j]);
      }
    }
  }

  /// A photon found by nearest().
  struct Neighbour {
    float distance_squared = 0;
    uint32_t index = 0;  ///< into photons()
    friend auto operator<=>(const Neighbour&, const Neighbour&) = default;
  };

  /// Puts into `found` the `wanted` nearest photons within max_radius for which counts(photon) is
  /// true, or all of them if they are fewer. They are sorted by distance, then by their place in
  /// photons(). counts() may be called more than once for a photon.
  template <class F>
  void nearest(const Vec3f& center, float max_radius, size_t wanted, F&& counts,
               std::vector<Neighbour>& found) const {
    found.clear();
    if (photons_.empty() || wanted == 0 || !(max_radius > 0.0f)) return;
    // The first disk is about as large as a finest cell, which holds a few photons. The next one's
    // area follows from the photons found so far; on a surface it holds a few more than are wanted.
    float radius = max_radius;
    if (wanted < photons_.size())
      radius = std::min(0.5f * std::ldexp(quantum_, levels_.front().shift), max_radius);
    for (;;) {
      found.clear();
      query(center, radius, [&](const Photon& photon, float d2) {
        found.push_back({d2, static_cast<uint32_t>(&photon - photons_.data())});
      });
      const bool is_last = !(radius < max_radius);
      size_t kept = found.size();
      if (kept >= wanted || is_last) {
        std::sort(found.begin(), found.end());
        kept = 0;
        for (size_t i = 0; i < found.size() && kept < wanted; ++i)
          if (counts(photons_[found[i].index])) found[kept++] = found[i];
        found.resize(kept);
        if (kept == wanted || is_last) return;
      }
      const float growth = std::sqrt(1.2f * static_cast<float>(wanted) /
                                     static_cast<float>(std::max<size_t>(kept, 1)));
      radius = std::min(radius * std::clamp(growth, 1.2f, 4.0f), max_radius);
    }
  }

  static constexpr int kCoordinateBits = 20;

 private:
  static constexpr uint32_t kCollected = 64;

  struct Cell {
    uint64_t code = 0;
    uint32_t begin = 0, end = 0;  ///< empty if equal
  };
  /// Photon ranges of the cells that a query reaches into: at most two along each axis.
  struct Runs {
    int count = 0;
    uint32_t begin[8], end[8];
  };
  /// Cells of size 2^shift quanta.
  struct Level {
    int shift = 0;
    float size = 0;
    uint64_t mask = 0;
    std::vector<Cell> table;  ///< open addressing, a power of two
    const Cell* find(uint64_t code) const;
  };

  uint32_t quantize(float x, int axis) const;
  void find_runs(const Vec3f& center, float radius, Runs& runs) const;
  /// Sorts the photons and returns their Morton codes. `order` as in the constructor.
  std::vector<uint64_t> sort(std::vector<uint32_t>* order);
  /// The `count` cells of 2^shift quanta, in the order of their codes.
  static std::vector<Cell> finest_cells(int shift, const std::vector<uint64_t>& codes,
                                        size_t count);
  /// Joins cells into cells of twice the size.
  static void join_cells(std::vector<Cell>& cells);
  void add_level(int shift, const std::vector<Cell>& cells);
  /// The level on which a query between these quanta covers at most two cells along each axis.
  const Level& level_for(float reach, const uint32_t (&lo)[3], const uint32_t (&hi)[3]) const;

  std::vector<Photon> photons_;
  std::vector<Vec3f> positions_;
  Vec3f min_, max_;
  float quantum_ = 1;  ///< size of the smallest cell
  float quanta_ = 1;   ///< 1 / quantum_
  float slack_ = 0;    ///< rounding error of positions far from the origin
  std::vector<Level> levels_;
  size_t bytes_ = 0;
};

}  // namespace nephroid
