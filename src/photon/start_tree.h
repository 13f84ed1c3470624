// Divides useful starts of light paths into crowds, by axis-aligned cuts that lower the cost [G4]
// of guiding paths to them (docs/estimators.md). It must not know scenes and lights.
#pragma once

#include <span>
#include <vector>

#include "core/math.h"

namespace nephroid {

/// The start of a useful light path.
struct UsefulStart {
  int light = 0;
  Vec3f first_hit{0, 0, 0};  ///< where the path first met something
  float weight = 1;          ///< unguided density of the start over its guided density
};

class StartTree {
 public:
  /// A crowd: the starts [begin, end) of the tree's order.
  struct Crowd {
    size_t begin = 0, end = 0;
    Bounds3f bounds;    ///< bounds of their first hits
    double weight = 0;  ///< sum of their weights

    /// [G4] Its squared sum over all crowds is proportional to the variance under the shares [G3].
    double cost() const { return std::sqrt(weight * length_squared(bounds.max - bounds.min)); }
    Vec3f center() const { return (bounds.min + bounds.max) * 0.5f; }
    float half_diagonal() const { return 0.5f * length(bounds.max - bounds.min); }
    bool contains(const Crowd& other) const { return begin <= other.begin && other.end <= end; }
  };

  /// Needs at least one start. The tree has at most `most` leaves and keeps no reference.
  StartTree(std::span<const UsefulStart> starts, size_t most);

  const std::vector<Crowd>& leaves() const { return leaves_; }
  /// The crowds that were cut, parts before wholes.
  const std::vector<Crowd>& inner() const { return inner_; }
  /// The indices of a crowd's starts.
  std::span<const uint32_t> starts_of(const Crowd& crowd) const {
    return std::span(order_).subspan(crowd.begin, crowd.end - crowd.begin);
  }

 private:
  std::vector<Crowd> leaves_, inner_;
  std::vector<uint32_t> order_;
};

}  // namespace nephroid
