// `path+photons`: one walk from the eye that finds everything path tracing finds, and whose
// caustics are photons as well, each weighed against the other. If trial passes show that it pays,
// photons also render the caustics of glossy materials, or all light (docs/estimators.md, sections
// 20 to 23). Papers: Doidge, Jones & Mora 2012, whose future work this is; Georgiev et al. 2012 for
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
  /// Where photons start, by trial passes which techniques to use and how many light paths, and
  /// from a pass that is measured how many camera paths each tile has and where they go. All of it
  /// looks at a lattice of pixels, as many whatever the size of the film.
  std::shared_ptr<const Learned> learn(const Scene& scene, const FilmFormat& film, uint64_t seed,
                                       PassControl& control) const override;
  std::shared_ptr<const Learned> read_learned(ByteReader& from, const FilmFormat&) const override;
  void render_pass(const PassKey& key, const Learned* learned, const Scene& scene, Film& film,
                   PassControl& control) override;
  EstimatorStatistics statistics() const override;
  /// `samples`: those that the user asks for, or 0.
  static size_t bytes_per_pixel(size_t parts, bool clamps, int samples) {
    const size_t most = std::max<size_t>(SampleMap::kMax, samples);
    return pair_pass_bytes_per_pixel(parts, most, clamps, false);
  }

 private:
  /// Techniques with their number of light paths, and where these start.
  struct Choice {
    Candidate candidate;
    GuidedPhotons photons;
  };
  /// Runs the trials and returns the best choice. `photons_of(casters)` learns where photons of the
  /// caustics of these casters should start.
  Choice best_of(Trials& trials, const Scene& scene, const FilmFormat& film,
                 const std::function<GuidedPhotons(ClassMask)>& photons_of) const;
  PairPass pass_of(const PassKey& key, const Scene& scene, const FilmFormat& film,
                   const MixPlan& plan, PassControl& control) const;

  OwnedRoutes owned_;
  IntegratorOptions options_;
  bool leaves_glossy_ = true;  ///< to path tracing: the caustics of glossy materials, last pass
  EstimatorStatistics statistics_;
};

}  // namespace nephroid
