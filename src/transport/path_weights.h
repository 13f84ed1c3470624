// MIS weights of the techniques that find one path by connecting or merging an eye side and a light
// side. Each side carries two sums along, so a weight costs the same for any path length
// (docs/estimators.md, [W1] to [W11]). It must not know scenes, routes or films.
// Papers: Veach 1997, chapter 10; Georgiev et al. 2012 for the recursion.
#pragma once

#include "core/math.h"

namespace nephroid {

/// The power heuristic of all weights, b = 2: ratios of densities are squared.
inline double heuristic(double ratio) {
  return ratio * ratio;
}

/// Sums over the techniques that cut the path at or before vertex x_i of a side, relative to the
/// one that connects x_i to the other side. Factors that only the connection knows are left out. In
/// Georgiev et al. 2012, `here` is dVCM and `before` is dVC; dVM is not kept, since the radius
/// varies.
struct PartialMisWeights {
  double here = 0;    ///< [W3]: the cut between x_{i-1} and x_i
  double before = 0;  ///< [W4]: all cuts before that one
  /// True if no other technique cuts the path on this side.
  bool empty() const { return here == 0 && before == 0; }
};

/// The densities of an event at a vertex of a side, per steradian; both 1 for a delta lobe.
struct EventDensity {
  double forward = 1;  ///< away from the start of the side
  double back = 1;     ///< backwards, for a walk from the other end
  bool finite = false;
};

/// Factors from solid angle to area along a line between the vertices a and b: cosine over squared
/// distance. Media have no cosine; a line to an infinite light has no distance.
struct LineFactors {
  double at_a = 0, at_b = 0;
};

/// A side's last vertex: its sums and its event, from which those of the next vertex follow.
struct SideEnd {
  PartialMisWeights sums;
  EventDensity event;
  double merge = 0;  ///< m of [W8], 0 if paths do not merge at the event

  /// True if the sums at the next vertex have cuts before the last one.
  bool has_cuts_before() const {
    return sums.before > 0 || (event.finite && sums.here + merge > 0);
  }
  /// [W3], [W4] The sums at the next vertex, b of `line`.
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

/// [W2] The sum A_i over all cuts at or before a vertex. `arriving` is r, the density per area with
/// which the other side would come to it. `back` is g, the density per steradian with which it
/// would go on backwards. `merge` as in SideEnd.
inline double cuts_before(const PartialMisWeights& sums, double arriving, double back,
                          double merge) {
  return heuristic(arriving) * (sums.here + merge + heuristic(back) * sums.before);
}

/// Densities of a light's start, as seen from the first vertex x after it ([W5]).
struct LightStart {
  double start = 0;   ///< u, density of light and point (infinite lights: light and direction)
  double onward = 0;  ///< o, density of the direction (infinite lights: point across the ray)
  double direct = 0;  ///< D, density of next-event estimation at x, in the units of `start`
  bool hit = false;   ///< h, true if walks may end on the light
  LineFactors line;   ///< line from the light (a) to x (b)

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

/// [W6] Weight of next-event estimation at x, where an eye side arrived with `sums`. `towards` and
/// `back` are the densities of its event, towards the light and back.
inline double weight_of_direct(const LightStart& light, const PartialMisWeights& sums,
                               double towards, double back, double merge) {
  if (!(light.direct > 0)) return 0;
  const double hit = light.hit ? heuristic(towards * light.line.at_a / light.direct) : 0;
  return 1 / (1 + hit +
              heuristic(light.start / light.direct) *
                  cuts_before(sums, light.onward * light.line.at_b, back, merge));
}

/// [W7] Weight of an eye side that hits the light; `sums` are those at the light's point.
inline double weight_of_hit(const LightStart& light, const PartialMisWeights& sums) {
  return 1 / (1 + heuristic(light.direct) * sums.here +
              heuristic(light.start) * heuristic(light.onward) * sums.before);
}

/// [W11] Weight of a merge of an eye side and a light side. `back_eye` and `back_light` are the
/// event's densities back along each side. `merge` as in SideEnd, not 0.
inline double weight_of_merge(const PartialMisWeights& eye, double back_eye,
                              const PartialMisWeights& light, double back_light, double merge) {
  return 1 / (1 + (eye.here + heuristic(back_eye) * eye.before + light.here +
                   heuristic(back_light) * light.before) /
                      merge);
}

}  // namespace nephroid
