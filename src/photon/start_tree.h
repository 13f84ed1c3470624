// Useful starts of light paths, cut into crowds: a tree of cuts along the axes, of which those are
// kept that make aiming at the crowds cheaper (docs/estimators.md, [G4]). It must not know scenes
// and lights.
#pragma once

#include <span>
#include <vector>

#include "core/math.h"

namespace nephroid {

/// The start of a light path that was of use.
struct UsefulStart {
  int light = 0;
  Vec3f first_hit{0, 0, 0};  ///< where the path first met something
  float weight = 1;          ///< density of the lights' own starts over that of its making
};

class StartTree {
 public:
  /// Some of the starts, [begin, end) of an order of them.
  struct Crowd {
    size_t begin = 0, end = 0;
    Bounds3f bounds;    ///< of their first hits
    double weight = 0;  ///< of all of them

    /// [G4] The square of the sum over all crowds is the variance, up to a factor, if paths are
    /// aimed at each as [G3] has it.
    double cost() const { return std::sqrt(weight * length_squared(bounds.max - bounds.min)); }
    Vec3f center() const { return (bounds.min + bounds.max) * 0.5f; }
    float half_diagonal() const { return 0.5f * length(bounds.max - bounds.min); }
    bool contains(const Crowd& other) const { return begin <= other.begin && other.end <= end; }
  };

  /// Of at least one start; the tree has `most` leaves at most and keeps no reference.
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
