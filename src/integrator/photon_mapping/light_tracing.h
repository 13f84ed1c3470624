// `lighttrace`: light tracing (t = 1). Each vertex of a light path, and its start on a shape, is
// connected to the camera ([K4]). It finds directly visible caustics without bias; passes are
// independent. It must not know how photons are merged. Papers: Dutre, Lafortune, Willems 1993;
// Veach 1997, chapters 5 and 10.
#pragma once

#include <functional>

#include "film/splats.h"
#include "integrator/estimator/estimator.h"
#include "route/scene_symbols.h"
#include "scene/camera/camera.h"
#include "transport/random_walk.h"

namespace nephroid {

/// Factor of a connection from a vertex to the camera. Empty: 1.
using ConnectionWeight = std::function<float(const CameraConnection&, const WalkVertex&)>;

/// Traces the light paths of a pass and adds their splats to `buffer`, not yet divided by the
/// number of paths. Returns that number and adds to `statistics`. With a weight, only paths are
/// connected that could also be merged at the vertex seen by the camera.
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
