// What the weights of an eye path's techniques need of its way so far ([W2] to [W11] in
// docs/estimators.md). Where only caustics merge, the path does not know yet whether a
// caster will stand between its vertices and the light: it keeps the sums for both cases. It must
// not know places or routes.
#pragma once

#include "scene/bsdf/bsdf.h"
#include "transport/path_weights.h"

namespace nephroid {

class EyePartialWeights {
 public:
  /// `connects`: light paths are connected to more than lights. `casters`: merges count where an
  /// event of one of these classes follows; kNone: anywhere.
  EyePartialWeights(bool connects, ClassMask casters) : connects_(connects), casters_(casters) {}

  /// [W9] At the first vertex: `cut` is what the connection to the camera counts.
  void arrive_first(double cut) {
    all_ = plain_ = {};
    all_.here = cut;
  }
  /// At the next vertex, over the line to it.
  void arrive(const LineFactors& line) {
    all_ = end_.next(line);
    plain_ = plain_end_.next(line);
    if (!connects_) all_.here = plain_.here = 0;
  }
  /// [W10] The way under the surface is one step: what was at its entry counts here. `density` is
  /// that of the way back out of the entry.
  void come_out(double density) {
    for (PartialMisWeights* s : {&all_, &plain_}) {
      s->here += heuristic(density) * s->before;
      s->before = 0;
    }
  }

  /// True if the density back of the event here has something to be multiplied with.
  bool asks_back() const { return all_.before > 0; }
  /// The walk leaves by an event of the letter; `merge` is [W8] of it.
  void leave(const EventDensity& event, double merge, EventClass letter) {
    end_ = {all_, event, merge};
    // A caster behind them lets all vertices so far merge, but not its own.
    plain_end_ = {contains(casters_, letter) ? all_ : plain_, event, 0};
  }

  /// True if a merge at the vertex counts where a light (`before_light`) or else a vertex of the
  /// light's side follows, which a caster may stand behind.
  bool merges_here(bool before_light) const { return !before_light || merges_all_light(); }
  /// At the vertex, for a cut behind an event of class `c` that is followed likewise.
  const PartialMisWeights& behind(EventClass c, bool before_light) const {
    return merges_here(before_light) || contains(casters_, c) ? all_ : plain_;
  }
  /// At the vertex, whatever follows.
  const PartialMisWeights& all() const { return all_; }
  /// What stands before the light, if nothing but it follows.
  const SideEnd& end_to_light() const { return merges_all_light() ? end_ : plain_end_; }

 private:
  bool merges_all_light() const { return casters_ == ClassMask::kNone; }

  const bool connects_;
  const ClassMask casters_;
  PartialMisWeights all_;
  SideEnd end_;
  /// The same where only caustics merge, should no caster follow: those vertices merge that one has
  /// followed.
  PartialMisWeights plain_;
  SideEnd plain_end_;
};

}  // namespace nephroid
