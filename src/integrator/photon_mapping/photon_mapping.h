// `photons`: stochastic progressive photon mapping with the memoryless radius [E2] that stores only
// the photons of its own routes. Passes are independent. It must not know how a pass gathers.
// Papers: Hachisuka & Jensen 2009; Knaus & Zwicker 2011; Doidge et al. 2012.
#pragma once

#include "integrator/estimator/estimator.h"
#include "route/scene_symbols.h"

namespace nephroid {

class PhotonMapping : public Estimator {
 public:
  PhotonMapping(OwnedRoutes owned, const IntegratorOptions& options);

  static const EstimatorDescriptor kDescriptor;
  const EstimatorDescriptor& descriptor() const override { return kDescriptor; }
  std::shared_ptr<const Learned> learn(const Scene& scene, const FilmFormat& film, uint64_t seed,
                                       PassControl& control) const override;
  std::shared_ptr<const Learned> read_learned(ByteReader& from, const FilmFormat&) const override;
  void render_pass(const PassKey& key, const Learned* learned, const Scene& scene, Film& film,
                   PassControl& control) override;
  EstimatorStatistics statistics() const override;
  bool records_pixels() const override { return true; }
  void record_pixel(const PixelPass& pixel, const Learned* learned,
                    PathTally& tally) const override;

 private:
  OwnedRoutes owned_;
  IntegratorOptions options_;
  bool photons_can_count_;
  uint64_t found_ = 0;  ///< photons merged
  EstimatorStatistics statistics_;
};

}  // namespace nephroid
