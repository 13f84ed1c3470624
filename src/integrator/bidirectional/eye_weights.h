// Partial MIS weights along an eye path ([W2] to [W11] in docs/estimators.md). If only caustics are
// merged, the path does not know yet which caster will stand between its vertices and the light, so
// it keeps sums for each case. It must not know places or routes.
#pragma once

#include <array>

#include "transport/casters.h"
#include "transport/path_weights.h"

namespace nephroid {

class EyePartialWeights {
 public:
  /// `connects`: eye vertices are connected to light vertices, and all light is merged.
  EyePartialWeights(bool connects, CasterRule rule) : connects_(connects), rule_(rule) {}

  /// [W9] Starts the sums at the first vertex; `cut` is the term of the connection to the camera.
  void arrive_first(double cut) { sums_.fill({cut, 0}); }
  /// Moves the sums to the next vertex, over the line to it.
  void arrive(const LineFactors& line) {
    for_each_case([&](size_t behind) {
      sums_[behind] = ends_[behind].next(line);
      if (!connects_) sums_[behind].here = 0;
    });
  }
  /// [W10] Moves the sums from the entry under the surface to the exit; both are one vertex.
  /// `density` is that of the way back out of the entry.
  void come_out(double density) {
    for (PartialMisWeights& s : sums_) {
      s.here += heuristic(density) * s.before;
      s.before = 0;
    }
  }

  /// True if the sums need the event's density back.
  bool asks_back() const { return most().before > 0; }
  /// Records the event by which the walk leaves; `merge` is its m of [W8], used if it may merge.
  void leave(const EventDensity& event, double merge, EventClass letter) {
    for_each_case([&](size_t behind) {
      const auto caster = static_cast<Caster>(behind);
      ends_[behind] = {sums_[static_cast<size_t>(rule_.with(letter, caster))], event,
                       contains(rule_.receivers(caster), letter) ? merge : 0};
    });
  }

  /// The sums at the vertex for a cut behind an event of class `c`; `behind` is the smoothest
  /// caster behind the event.
  const PartialMisWeights& at_cut(EventClass c, Caster behind) const {
    return sums_[static_cast<size_t>(rule_.with(c, behind))];
  }
  /// True if paths merge at an event of class `c` in this case.
  bool merges(EventClass c, Caster behind) const { return contains(rule_.receivers(behind), c); }
  /// The sums at the vertex for the case with the most merges.
  const PartialMisWeights& most() const { return sums_[kBehindSpecular]; }
  /// The last vertex before the light, if the walk hits a light next.
  const SideEnd& end_to_light() const { return ends_[0]; }

 private:
  static constexpr size_t kBehindSpecular = static_cast<size_t>(Caster::kSpecular);

  /// Calls `f` for each case that differs.
  template <class F>
  void for_each_case(const F& f) {
    f(static_cast<size_t>(Caster::kNone));
    if (rule_.caster_of(EventClass::kGlossy) == Caster::kGlossy)
      f(static_cast<size_t>(Caster::kGlossy));
    f(kBehindSpecular);
  }

  bool connects_;
  CasterRule rule_;
  /// [smoothest caster behind] the sums at the vertex, and the last vertex that the walk left.
  std::array<PartialMisWeights, kCasters> sums_;
  std::array<SideEnd, kCasters> ends_;
};

}  // namespace nephroid
