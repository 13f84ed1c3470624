// `path+photons`: path tracing and caustic photons, combined by MIS. If trial passes show that it
// pays, photons also render caustics of glossy materials, or all light (docs/estimators.md,
// sections 20 to 23). Papers: Doidge, Jones & Mora 2012 (its future work); Georgiev et al. 2012 for
// weights; Grittmann et al. 2022 for choosing techniques by efficiency.
#pragma once

#include <functional>

#include "integrator/bidirectional/pair_pass.h"
#include "integrator/learning/photon_guiding.h"
#include "integrator/mixed/trials.h"

namespace nephroid {

struct MixPlan;

class PathAndPhotons final : public Estimator {
 public:
  PathAndPhotons(OwnedRoutes owned, const IntegratorOptions& options);
  static const EstimatorDescriptor kDescriptor;
  const EstimatorDescriptor& descriptor() const override { return kDescriptor; }
  bool records_features() const override { return true; }
  /// Learns the guide of photon emission. Trial passes then choose the techniques. A measured pass
  /// gives camera paths per tile, their guide, and the number of light paths. All passes cover a
  /// lattice of pixels whose size does not grow with the film.
  std::shared_ptr<const Learned> learn(const Scene& scene, const FilmFormat& film, uint64_t seed,
                                       PassControl& control) const override;
  std::shared_ptr<const Learned> read_learned(ByteReader& from, const FilmFormat&) const override;
  void render_pass(const PassKey& key, const Learned* learned, const Scene& scene, Film& film,
                   PassControl& control) override;
  EstimatorStatistics statistics() const override;
  bool records_pixels() const override { return true; }
  void record_pixel(const PixelPass& pixel, const Learned* learned,
                    PathTally& tally) const override;
  /// Memory of a pass per pixel; `samples` is the user's number of samples, or 0.
  static size_t bytes_per_pixel(size_t parts, bool clamps, int samples) {
    const size_t most = std::max<size_t>(SampleMap::kMax, samples);
    return pair_pass_bytes_per_pixel(parts, most, clamps, false);
  }

 private:
  /// Techniques with their number of light paths and the guide of photon emission.
  struct Choice {
    Candidate candidate;
    GuidedPhotons photons;
  };
  /// Runs the trials and returns the best choice. `photons_of(casters)` learns the emission guide
  /// for photons of the caustics of these casters.
  Choice best_of(Trials& trials, const Scene& scene, const FilmFormat& film,
                 const std::function<GuidedPhotons(ClassMask)>& photons_of) const;
  /// The merge radius of a pass in pixel footprints.
  float radius_of(const MixPlan& plan, const FilmFormat& film, uint32_t pass) const;
  PairPass pass_of(const PassKey& key, const Scene& scene, const FilmFormat& film,
                   const MixPlan& plan, PassControl& control) const;

  OwnedRoutes owned_;
  IntegratorOptions options_;
  bool leaves_glossy_ = true;  ///< glossy caustics were left to path tracing in the last pass
  EstimatorStatistics statistics_;
};

}  // namespace nephroid
