// `lighttrace`: light paths whose vertices are connected to the camera, and the start points of
// those on shapes as well. It finds what is seen directly of caustics, without any bias. A pass is
// a function of the scene, the options and the pass key alone, so passes may be rendered anywhere
// and added up. It must not know how photons are merged. Papers: Dutre, Lafortune, Willems 1993;
// Veach 1997, chapters 5 and 10.
#pragma once

#include <functional>

#include "film/splats.h"
#include "integrator/estimator/estimator.h"
#include "route/scene_symbols.h"
#include "scene/camera/camera.h"
#include "transport/random_walk.h"

namespace nephroid {

/// A factor for a connection to the camera from a vertex; empty: 1.
using ConnectionWeight = std::function<float(const CameraConnection&, const WalkVertex&)>;

/// Traces the light paths of a pass and adds what they expose, not yet divided by their number, to
/// `buffer`; returns that number and adds to `statistics`. With a weight, only what could as well
/// be merged at the vertex that the camera sees is connected.
int64_t light_pass(const PassKey& key, const Scene& scene, const Film& film,
                   const OwnedRoutes& owned, const IntegratorOptions& options,
                   const ConnectionWeight& weight, SplatBuffer& buffer,
                   EstimatorStatistics& statistics, PassControl& control);

class LightTracing : public Estimator {
 public:
  LightTracing(OwnedRoutes owned, const IntegratorOptions& options);

  static const EstimatorDescriptor kDescriptor;
  const EstimatorDescriptor& descriptor() const override { return kDescriptor; }
  void render_pass(const PassKey& key, const Learned*, const Scene& scene, Film& film,
                   PassControl& control) override;
  EstimatorStatistics statistics() const override;

 private:
  OwnedRoutes owned_;
  IntegratorOptions options_;
  EstimatorStatistics statistics_;
};

}  // namespace nephroid
