// What the weights of an eye path's techniques need of its way so far ([W2] to [W11] in
// docs/estimators.md). Where only caustics merge, the path does not know yet whether an S will
// stand between its vertices and the light: it keeps the sums for both cases. It must not know
// places or routes.
#pragma once

#include "scene/bsdf/bsdf.h"
#include "transport/path_weights.h"

namespace nephroid {

class EyePartialWeights {
 public:
  /// `connects`: light paths are connected to more than lights. `caustics_only`: merges count where
  /// an S follows.
  EyePartialWeights(bool connects, bool caustics_only)
      : connects_(connects), caustics_only_(caustics_only) {}

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
    // An S behind them lets all vertices so far merge.
    plain_end_ = {letter == EventClass::kSpecular ? all_ : plain_, event, 0};
  }

  /// True if no merge counts where an event of class `c` at the vertex is followed by a light
  /// (`before_light`; else by a vertex of the light's side), because it is not the S that it takes.
  bool is_plain(EventClass c, bool before_light) const {
    return before_light && caustics_only_ && c != EventClass::kSpecular;
  }
  /// At the vertex, for a cut behind such an event.
  const PartialMisWeights& behind(EventClass c, bool before_light) const {
    return is_plain(c, before_light) ? plain_ : all_;
  }
  /// At the vertex, whatever follows.
  const PartialMisWeights& all() const { return all_; }
  /// What stands before the light, if nothing but it follows.
  const SideEnd& end_to_light() const { return caustics_only_ ? plain_end_ : end_; }

 private:
  const bool connects_, caustics_only_;
  PartialMisWeights all_;
  SideEnd end_;
  /// The same where only caustics merge, should no S follow: vertices merge that an S has followed.
  PartialMisWeights plain_;
  SideEnd plain_end_;
};

}  // namespace nephroid
