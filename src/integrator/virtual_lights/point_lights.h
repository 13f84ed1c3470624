// `pointlights`: path tracing whose first rough vertex is also connected to virtual point lights.
// Weights leave to the walk the light of point lights that are too near, which would be spots ([L1]
// to [L4] in docs/estimators.md), so nothing is clamped. Passes are independent.
// Papers: Kollig & Keller 2004; Dammertz, Keller & Lensch 2010.
#pragma once

#include "integrator/photons/photon_pass.h"

namespace nephroid {

struct PointLightsOptions {
  int connections = 0;  ///< connections per pixel and pass; 0: the default
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
  /// Renders one walk per pixel; all share point lights and wavelengths.
  void render_sample(const PhotonPass& pass, float density, const Scene& scene, Film& film);

  OwnedRoutes owned_;
  IntegratorOptions options_;
  EstimatorStatistics statistics_;
};

/// s of [L1], the point lights' share of the light from y to x; the walk finds the rest.
/// `walk_pdf_a` is the density p_A with which the walk comes from x to y, `density` is ρ.
float point_light_share(float density, float walk_pdf_a);

}  // namespace nephroid
