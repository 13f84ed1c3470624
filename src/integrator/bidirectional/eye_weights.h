// What the weights of an eye path's techniques need of its way so far ([W2] to [W11] in
// docs/estimators.md). Where only caustics merge, the path does not know yet which caster will
// stand between its vertices and the light, if any: it keeps sums for each case. It must not know
// places or routes.
#pragma once

#include <array>

#include "transport/casters.h"
#include "transport/path_weights.h"

namespace nephroid {

class EyePartialWeights {
 public:
  /// `connects`: light paths are connected to more than lights, and all light is merged.
  EyePartialWeights(bool connects, CasterRule rule) : connects_(connects), rule_(rule) {}

  /// [W9] At the first vertex: `cut` is what the connection to the camera counts.
  void arrive_first(double cut) { sums_.fill({cut, 0}); }
  /// At the next vertex, over the line to it.
  void arrive(const LineFactors& line) {
    for_each_case([&](size_t behind) {
      sums_[behind] = ends_[behind].next(line);
      if (!connects_) sums_[behind].here = 0;
    });
  }
  /// [W10] The way under the surface is one step: what was at its entry counts here. `density` is
  /// that of the way back out of the entry.
  void come_out(double density) {
    for (PartialMisWeights& s : sums_) {
      s.here += heuristic(density) * s.before;
      s.before = 0;
    }
  }

  /// True if the density back of the event here has something to be multiplied with.
  bool asks_back() const { return most().before > 0; }
  /// The walk leaves by an event of the letter; `merge` is [W8] of it, if it counts.
  void leave(const EventDensity& event, double merge, EventClass letter) {
    for_each_case([&](size_t behind) {
      const auto caster = static_cast<Caster>(behind);
      ends_[behind] = {sums_[static_cast<size_t>(rule_.with(letter, caster))], event,
                       contains(rule_.receivers(caster), letter) ? merge : 0};
    });
  }

  /// At the vertex, for a cut behind an event of class `c`, behind which `behind` is the smoothest
  /// caster.
  const PartialMisWeights& at_cut(EventClass c, Caster behind) const {
    return rule_.merges_all_light() ? most() : sums_[static_cast<size_t>(rule_.with(c, behind))];
  }
  /// True if a merge at an event of class `c` counts there.
  bool merges(EventClass c, Caster behind) const { return contains(rule_.receivers(behind), c); }
  /// At the vertex, where the most merges count.
  const PartialMisWeights& most() const { return sums_[kMost]; }
  /// What stands before the light, if nothing but it follows.
  const SideEnd& end_to_light() const { return ends_[rule_.merges_all_light() ? kMost : 0]; }

 private:
  static constexpr size_t kMost = static_cast<size_t>(Caster::kSpecular);

  /// The cases that differ.
  template <class F>
  void for_each_case(const F& f) {
    if (!rule_.merges_all_light()) {
      f(static_cast<size_t>(Caster::kNone));
      if (rule_.caster_of(EventClass::kGlossy) != Caster::kNone)
        f(static_cast<size_t>(Caster::kGlossy));
    }
    f(kMost);
  }

  const bool connects_;
  const CasterRule rule_;
  /// By the smoothest caster behind: the sums at the vertex, and what the walk left with.
  std::array<PartialMisWeights, kCasters> sums_;
  std::array<SideEnd, kCasters> ends_;
};

}  // namespace nephroid
