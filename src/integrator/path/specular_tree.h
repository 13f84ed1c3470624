// Lights behind delta lobes alone: at each smooth boundary both ways are followed where a walk
// would choose one ([S1] in docs/estimators.md). A lamp mirrored in glass is then seen dimly by
// all paths, not brightly by one in a hundred. It must not know films or pixels.
// Paper: Whitted 1980.
#pragma once

#include <vector>

#include "film/part_sums.h"
#include "photon/path_recorder.h"
#include "route/scene_symbols.h"
#include "transport/random_walk.h"

namespace nephroid {

class SpecularTree {
 public:
  /// Serves the routes of a group, for paths of at most `max_events` events.
  SpecularTree(const Scene& scene, const OwnedRoutes& owned, int max_events);

  /// True if the group may own lights seen through delta lobes alone.
  bool finds_something() const { return finds_something_; }

  struct Light {
    Part part = kNoPart;  ///< a part that the group owns
    Lamp lamp = 0;
    SampledSpectrum value;
    int left = kAllWavelengths;  ///< the hero's number if the branch kept no other wavelength
    /// Probability that a walk which chooses one way at each boundary, and may end where it is
    /// absorbed, comes there.
    float chance = 1;

    /// The value at the wavelengths that the walk started with.
    SampledSpectrum whole() const { return whole_spectrum(value, left); }
    void add_to(PartSums& sums) const { sums.add(part, lamp, whole(), Technique::kMeetByMirrors); }
  };

  /// Adds to `found` all such lights of a camera walk that has had no event yet. Returns the number
  /// of rays. The recorder, if there is one, gets each path.
  uint64_t look(const Walk& walk, PathSampler& sampler, std::vector<Light>& found,
                PathRecorder* recorder = nullptr) const;

  /// Adds to `found` all lights behind a branch; its events so far, all delta lobes, have led to
  /// `eye` and are recorded. Returns the number of rays.
  uint64_t follow(Walk branch, EyeState eye, PathSampler& sampler, std::vector<Light>& found,
                  PathRecorder* recorder = nullptr) const;

 private:
  class Visitor;

  const Scene& scene_;
  const OwnedRoutes& owned_;
  const int max_events_;
  bool finds_something_;
};

/// Decides which lights an ordinary camera walk leaves to specular trees.
class SpecularRoot {
 public:
  enum class Leaves : uint8_t {
    kNothing,   ///< no trees
    kBranches,  ///< a tree grows at the first smooth boundary behind delta lobes alone
    kAll        ///< other walks look for all such light
  };

  SpecularRoot(const SpecularTree* tree, Leaves leaves)
      : tree_(tree), leaves_(tree && tree->finds_something() ? leaves : Leaves::kNothing) {}

  bool branches() const { return leaves_ == Leaves::kBranches && only_delta_ && !grown_; }
  /// True if the walk must ignore the lights that it hits.
  bool leaves_lights() const { return left_ && only_delta_; }
  /// Follows one of the two ways; `eye` is the state behind its first event. Adds the light to
  /// `sums` and returns the number of rays.
  uint64_t branch(const Walk& way, EyeState eye, PathSampler& sampler, PartSums& sums,
                  PathRecorder* recorder = nullptr) {
    left_ = true;
    found_.clear();
    const uint64_t rays = tree_->follow(way, eye, sampler, found_, recorder);
    for (const SpecularTree::Light& l : found_) l.add_to(sums);
    return rays;
  }
  /// Records an event of the walk itself.
  void scatter(const Walk& walk, EventClass letter) {
    left_ = left_ || leaves_ == Leaves::kAll;
    grown_ = left_;
    only_delta_ = only_delta_ && walk.delta && letter == EventClass::kSpecular;
  }

 private:
  const SpecularTree* tree_;
  Leaves leaves_;
  bool only_delta_ = true;  ///< the walk had only delta lobes so far
  bool left_ = false;       ///< lights behind this place are left to trees or other walks
  bool grown_ = false;      ///< a tree has grown at an earlier vertex
  std::vector<SpecularTree::Light> found_;
};

}  // namespace nephroid
