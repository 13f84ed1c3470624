// PathRecorder receives the light of single paths as an estimator finds it, each with its word and
// its vertices. Ordinary passes have none. It must not know pixels or how paths are summed.
#pragma once

#include "core/color.h"
#include "film/technique_light.h"
#include "photon/photon.h"
#include "transport/direct_light.h"
#include "transport/walk_record.h"

namespace nephroid {

/// The light at the end of a path.
struct PathEnd {
  int light = -1;         ///< index in Scene::lights, -1 for the glow of a medium
  int medium = -1;        ///< index of the glowing medium, -1 for a light
  Vec3f p{0, 0, 0};       ///< point on the light, far away if it is infinite
  bool has_place = true;  ///< false if `p` is unknown, as in a glowing medium
};

/// An infinite light, seen from `p` along the unit direction `w`.
inline PathEnd end_at_infinity(const Scene& scene, int light, const Vec3f& p, const Vec3f& w) {
  return {light, -1, p + w * (2 * scene.sphere.radius)};
}
/// The light of a light sample at the vertex `p`.
inline PathEnd end_at_sample(const Scene& scene, const DirectSample& d, const Vec3f& p) {
  return scene.lights[d.light]->is_infinite() ? end_at_infinity(scene, d.light, p, d.wi_world)
                                              : PathEnd{d.light, -1, d.p};
}

/// The light of a path as estimators add it to their PartSums.
struct PathLight {
  Part part = kNoPart;
  Technique technique = Technique::kMeetLight;
  SampledSpectrum value;
};

/// Receives the light of one camera path after the other.
class PathRecorder {
 public:
  PathRecorder() = default;
  PathRecorder(const PathRecorder&) = delete;
  PathRecorder& operator=(const PathRecorder&) = delete;
  virtual ~PathRecorder() = default;

  /// A camera path starts at the point `lens`.
  void begin(const Vec3f& lens) { walk.begin(lens); }
  /// The walk itself came to a light.
  virtual void meet(const PathLight& found, const PathEnd& end) = 0;
  /// The walk's last vertex was joined to a light by the event `last`.
  virtual void join(const PathLight& found, const WalkEvent& last, const PathEnd& end) = 0;
  /// The walk's last vertex was joined by the event `last` to the light path of a photon.
  virtual void merge(const PathLight& found, const WalkEvent& last, const Photon& photon) = 0;
  /// The camera path is complete; the arguments are those of PartSums::colors.
  virtual void end(const SensorWeights& weights, float factor, float max_component,
                   float filter_weight) = 0;

  WalkRecord walk;  ///< the camera path's walk so far
};

}  // namespace nephroid
