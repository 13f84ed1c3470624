// Weights of the techniques that can find one path: it is cut in two anywhere, an eye side and a
// light side, which are connected or merged. Each side carries two sums along, so that the weight
// of a cut costs the same however long the path is (docs/estimators.md, [W1] to [W9]). It must not
// know scenes, routes or films. Papers: Veach 1997, chapter 10; Georgiev et al. 2012, whose
// recursion this is in other terms.
#pragma once

#include "core/math.h"

namespace nephroid {

/// The heuristic of the weights, in one place: ratios of densities are raised to this power.
/// 1: balance, 2: power heuristic.
inline double heuristic(double ratio) {
  return ratio * ratio;
}

/// What the techniques that cut the path at or before vertex x_i of a side add up to, relative to
/// the one that connects x_i with the other side, up to the factors that are known only then. In
/// the terms of Georgiev et al. 2012: `here` is dVCM, `before` is dVC, what merging adds is dVM.
struct PartialMisWeights {
  double here = 0;    ///< [W3]: the cut between x_{i-1} and x_i
  double before = 0;  ///< [W4]: all cuts before that one
  /// True if there are none: what the other side would have done counts for nothing.
  bool empty() const { return here == 0 && before == 0; }
};

/// The densities of an event at a vertex of a side, per steradian; both 1 for a delta lobe.
struct EventDensity {
  double forward = 1;  ///< away from the start of the side
  double back = 1;     ///< had the walk come from the other end
  bool finite = false;
};

/// A line between two vertices a and b as factors from solid angle to area: cosine over squared
/// distance, without the cosine in media; the end of a line to an infinite light has no distance.
struct LineFactors {
  double at_a = 0, at_b = 0;
};

/// Sums of what a side hands over to its next vertex: those at its last one and the event there.
struct SideEnd {
  PartialMisWeights sums;
  EventDensity event;
  double merge = 0;  ///< [W8], 0 if the event is none at which paths merge

  /// True if the sums at the next vertex have cuts before the last one.
  bool has_cuts_before() const {
    return sums.before > 0 || (event.finite && sums.here + merge > 0);
  }
  /// The sums at the next vertex, b of `line`. [W3] and [W4]
  PartialMisWeights next(const LineFactors& line) const {
    const double forward = heuristic(event.forward * line.at_b);
    PartialMisWeights s;
    if (!(forward > 0)) return s;
    s.here = event.finite ? 1 / forward : 0;
    s.before = heuristic(line.at_a) / forward *
               ((event.finite ? sums.here + merge : 0) + heuristic(event.back) * sums.before);
    return s;
  }
};

/// [W2] All cuts at or before a vertex: `arriving` is the density per area with which the other
/// side would come to it, `back` the density per steradian with which it would then go on
/// backwards, `merge` as in SideEnd.
inline double cuts_before(const PartialMisWeights& sums, double arriving, double back,
                          double merge) {
  return heuristic(arriving) * (sums.here + merge + heuristic(back) * sums.before);
}

/// How a light starts paths, seen from the first vertex x after it.
struct LightStart {
  double start = 0;   ///< density of the light and its point; of infinite lights the direction
  double onward = 0;  ///< of the direction; of infinite lights the point across the ray
  double direct = 0;  ///< of next-event estimation at x, in the units of `start`
  bool hit = false;   ///< walks may end on the light
  LineFactors line;   ///< from the light (a) to x (b)

  /// [W5] The sums at x as the first vertex of a light side.
  PartialMisWeights first() const {
    const double forward = heuristic(onward * line.at_b);
    PartialMisWeights s;
    if (!(forward > 0) || !(start > 0)) return s;
    s.here = heuristic(direct / start) / forward;
    s.before = hit ? heuristic(line.at_a / start) / forward : 0;
    return s;
  }
};

/// [W6] Weight of next-event estimation at x, which an eye side has come to with `sums`: `towards`
/// and `back` are the densities of its event there, towards the light and back.
inline double weight_of_direct(const LightStart& light, const PartialMisWeights& sums,
                               double towards, double back, double merge) {
  if (!(light.direct > 0)) return 0;
  const double hit = light.hit ? heuristic(towards * light.line.at_a / light.direct) : 0;
  return 1 / (1 + hit +
              heuristic(light.start / light.direct) *
                  cuts_before(sums, light.onward * light.line.at_b, back, merge));
}

/// [W7] Weight of an eye side that ends on the light; `sums` are those at the light's point as a
/// vertex of the eye side.
inline double weight_of_hit(const LightStart& light, const PartialMisWeights& sums) {
  return 1 / (1 + heuristic(light.direct) * sums.here +
              heuristic(light.start) * heuristic(light.onward) * sums.before);
}

/// [W11] Weight of a merge of an eye side and a light side that both came to one place. `back_eye`
/// is the density with which its event goes back along the eye side, `back_light` along the light
/// side; `merge` as in SideEnd, not 0.
inline double weight_of_merge(const PartialMisWeights& eye, double back_eye,
                              const PartialMisWeights& light, double back_light, double merge) {
  return 1 / (1 + (eye.here + heuristic(back_eye) * eye.before + light.here +
                   heuristic(back_light) * light.before) /
                      merge);
}

}  // namespace nephroid
