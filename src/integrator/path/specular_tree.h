// Lights that the camera sees by way of smooth boundaries alone: both ways are followed at each of
// them, as in Whitted 1980, where a walk would choose one ([S1] in docs/estimators.md). A lamp
// mirrored in glass, seen by one path in a hundred, is then seen dimly by all of them. It must not
// know films or pixels.
#pragma once

#include <vector>

#include "film/part_sums.h"
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
    Lamp lamp = 0;
    SampledSpectrum value;
    int left = kAllWavelengths;  ///< or the hero's number, if the branch kept no other wavelength
    /// With which a walk that chooses one way each time, and ends where it is absorbed, had come
    /// there.
    float chance = 1;

    /// `sums` are of the wavelengths that the walk started with.
    void add_to(PartSums& sums) const {
      sums.add(part, lamp, whole_spectrum(value, left), Technique::kMeetByMirrors);
    }
  };

  /// Adds to `found` all such light that a camera walk, before its first event, can see. Returns
  /// the number of rays.
  uint64_t look(const Walk& walk, PathSampler& sampler, std::vector<Light>& found) const;

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

/// What a camera walk that looks for everything leaves to trees.
class SpecularRoot {
 public:
  enum class Leaves : uint8_t {
    kNothing,   ///< there are no trees
    kBranches,  ///< trees are grown at the first boundary behind nothing but delta lobes
    kAll        ///< other walks have looked for all such light
  };

  SpecularRoot(const SpecularTree* tree, Leaves leaves)
      : tree_(tree), leaves_(tree && tree->finds_something() ? leaves : Leaves::kNothing) {}

  bool branches() const { return leaves_ == Leaves::kBranches && only_delta_ && !grown_; }
  /// True where the light that the walk meets is not its own.
  bool leaves_lights() const { return left_ && only_delta_; }
  /// One of the two ways; `eye` is the state behind its first event. Adds the light to `sums` and
  /// returns the number of rays.
  uint64_t branch(const Walk& way, EyeState eye, PathSampler& sampler, PartSums& sums) {
    left_ = true;
    found_.clear();
    const uint64_t rays = tree_->follow(way, eye, sampler, found_);
    for (const SpecularTree::Light& l : found_) l.add_to(sums);
    return rays;
  }
  /// The walk itself had an event.
  void scatter(const Walk& walk, EventClass letter) {
    left_ = left_ || leaves_ == Leaves::kAll;
    grown_ = left_;
    only_delta_ = only_delta_ && walk.delta && letter == EventClass::kSpecular;
  }

 private:
  const SpecularTree* tree_;
  Leaves leaves_;
  bool only_delta_ = true;  ///< so far
  bool left_ = false;       ///< lights behind this place
  bool grown_ = false;      ///< at an earlier vertex
  std::vector<SpecularTree::Light> found_;
};

}  // namespace nephroid
