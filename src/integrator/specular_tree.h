// Lights that the camera sees by way of smooth boundaries alone: both ways are followed at each of
// them, as in Whitted 1980, where a walk would choose one ([S1] in docs/estimators.md). A lamp
// mirrored in glass, seen by one path in a hundred, is then seen dimly by all of them.
// Who calls it: visitors of camera walks, which leave this light to it. It must not know films.
#pragma once

#include <vector>

#include "route/scene_symbols.h"
#include "transport/random_walk.h"

namespace nephroid {

class SpecularTree {
 public:
  /// For the routes of a group and paths of `max_events` at most.
  SpecularTree(const Scene& scene, const OwnedRoutes& owned, int max_events);

  /// False if no light belongs to the group that is seen through delta lobes alone.
  bool finds_something() const { return finds_something_; }

  struct Light {
    Part part = kNoPart;  ///< one that the group owns
    SampledSpectrum value;
    bool hero_only = false;  ///< the branch kept its hero wavelength only
  };

  /// Adds to `found` all light behind a branch whose events so far, all of them delta lobes, have
  /// led to `eye`. Returns the number of rays.
  uint64_t follow(Walk branch, EyeState eye, PathSampler& sampler, std::vector<Light>& found) const;

 private:
  class Visitor;

  const Scene& scene_;
  const OwnedRoutes& owned_;
  const int max_events_;
  bool finds_something_;
};

/// A camera walk as the root of such trees: at the first boundary behind nothing but delta lobes
/// the trees take over, and from there on the walk leaves lights that it meets to them.
class SpecularRoot {
 public:
  /// No trees if null.
  explicit SpecularRoot(const SpecularTree* tree)
      : tree_(tree && tree->finds_something() ? tree : nullptr) {}

  bool branches() const { return tree_ && only_delta_ && !grown_; }
  /// True where the trees find the light that the walk meets.
  bool leaves_lights() const { return trees_ && only_delta_; }
  /// One of the two ways; `eye` is the state behind its first event.
  uint64_t branch(const Walk& way, EyeState eye, PathSampler& sampler,
                  std::vector<SpecularTree::Light>& found) {
    trees_ = true;
    return tree_->follow(way, eye, sampler, found);
  }
  /// The walk itself had an event.
  void scatter(const Walk& walk, EventClass letter) {
    grown_ = trees_;
    only_delta_ = only_delta_ && walk.delta && letter == EventClass::kSpecular;
  }

 private:
  const SpecularTree* tree_;
  bool only_delta_ = true;  ///< so far
  bool trees_ = false;      ///< were grown
  bool grown_ = false;      ///< at an earlier vertex
};

}  // namespace nephroid
