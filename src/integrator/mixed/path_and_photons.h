// `path+photons`: one walk from the eye that finds everything path tracing finds, and whose
// caustics are photons as well, each weighed against the other; where trial passes show that it is
// worth its time, light paths are connected and merged everywhere, too (docs/estimators.md,
// sections 20 to 23). Papers: Doidge, Jones & Mora 2012, whose future work this is; Georgiev et al.
// 2012 for weights; Grittmann et al. 2022 for choosing techniques by efficiency.
#pragma once

#include "integrator/bidirectional/pair_pass.h"

namespace nephroid {

class LearnedMix;

class PathAndPhotons final : public Estimator {
 public:
  /// Camera paths of each pixel in the first pass, from whose variance the others learn.
  static constexpr int kFirstPassSamples = 8;

  PathAndPhotons(OwnedRoutes owned, const IntegratorOptions& options);
  static const EstimatorDescriptor kDescriptor;
  const EstimatorDescriptor& descriptor() const override { return kDescriptor; }
  bool records_features() const override { return true; }
  /// Where photons start, and by trial passes which techniques to use and how many light paths.
  std::shared_ptr<const Learned> learn(const Scene& scene, const FilmFormat& film, uint64_t seed,
                                       PassControl& control) const override;
  /// How many camera paths each tile has, and where these go.
  std::shared_ptr<const Learned> learn_from_first_pass(std::shared_ptr<const Learned> before,
                                                       std::unique_ptr<PassFindings> found,
                                                       const Scene& scene, const FilmFormat& film,
                                                       uint64_t seed,
                                                       PassControl& control) const override;
  std::shared_ptr<const Learned> read_learned(ByteReader& from, const FilmFormat&) const override;
  std::unique_ptr<PassFindings> render_pass(const PassKey& key, const Learned* learned,
                                            const Scene& scene, Film& film,
                                            PassControl& control) override;
  EstimatorStatistics statistics() const override { return statistics_; }
  /// What the pass that takes most has for each pixel, the first one.
  static size_t bytes_per_pixel(size_t parts, bool clamps) {
    return pair_pass_bytes_per_pixel(parts, kFirstPassSamples, clamps ? kFirstPassSamples : 0);
  }

 private:
  PairPass pass_of(const PassKey& key, const Scene& scene, const LearnedMix& learned,
                   PassControl& control) const;
  PairLearning learning_of(const LearnedMix& learned) const;

  OwnedRoutes owned_;
  IntegratorOptions options_;
  EstimatorStatistics statistics_;
};

}  // namespace nephroid
