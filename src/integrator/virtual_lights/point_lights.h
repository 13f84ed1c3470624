// `pointlights`: light that goes from one rough surface to another is found twice: at the first
// rough vertex of a camera walk, connected to virtual point lights, and by the walk itself, which
// goes on as path tracing does. A weight leaves to the walk what a point light that is too near
// would make a spot of ([L1] to [L4] in docs/estimators.md), so nothing is clamped away. A pass is
// a function of the scene, the options and the pass key alone.
// Papers: Kollig & Keller 2004; Dammertz, Keller & Lensch 2010.
#pragma once

#include "integrator/photons/photon_pass.h"

namespace nephroid {

struct PointLightsOptions {
  int connections = 0;  ///< of a pixel and pass; 0: the default
};

class PointLights : public Estimator {
 public:
  PointLights(OwnedRoutes owned, const IntegratorOptions& options);

  static const EstimatorDescriptor kDescriptor;
  const EstimatorDescriptor& descriptor() const override { return kDescriptor; }
  std::shared_ptr<const Learned> learn(const Scene& scene, const FilmFormat& film, uint64_t seed,
                                       PassControl& control) const override;
  std::shared_ptr<const Learned> read_learned(ByteReader& from, const FilmFormat&) const override;
  void render_pass(const PassKey& key, const Learned* learned, const Scene& scene, Film& film,
                   PassControl& control) override;
  EstimatorStatistics statistics() const override { return statistics_; }

 private:
  /// One walk of each pixel, with point lights and wavelengths that they share.
  void render_sample(const PhotonPass& pass, float density, const Scene& scene, Film& film);

  OwnedRoutes owned_;
  IntegratorOptions options_;
  EstimatorStatistics statistics_;
};

/// [L1]: share of the light from y to x that point lights find, where a walk at x finds y with the
/// density `walk_pdf_a` per area and point lights lie with `density` per area. The walk finds the
/// rest.
float point_light_share(float density, float walk_pdf_a);

}  // namespace nephroid
