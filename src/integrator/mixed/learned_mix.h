// What `path+photons` learns. It must not know how it is learned.
#pragma once

#include <optional>

#include "integrator/bidirectional/pair_pass.h"
#include "integrator/learning/photon_guiding.h"
#include "integrator/mixed/balance.h"

namespace nephroid {

/// Where the emission of photons is guided to, and the techniques of all passes.
struct MixPlan {
  GuidedPhotons photons;
  PairTechniques techniques;       ///< light paths: the number where it is the same in all passes
  std::optional<Balance> balance;  ///< that number otherwise
  double records_per_path = 0;     ///< that a camera path leaves in the mean
  SampleMap first_samples;         ///< camera paths of the first pass
  bool is_even = false;            ///< all passes have as many
  bool lacks_specular = false;     ///< the scene has no lobe of class S
  uint64_t rays = 0;               ///< that learning took, but for those of `photons`
  uint64_t photon_bytes = 0, pixel_bytes = 0;  ///< memory that it took

  int64_t light_paths(double camera_paths) const {
    return balance ? balance->light_paths(camera_paths) : techniques.light_paths;
  }
  static void members(auto& self, auto& archive) {
    archive(self.photons, self.techniques, self.balance, self.records_per_path, self.first_samples,
            self.is_even, self.lacks_specular, self.rays, self.photon_bytes, self.pixel_bytes);
  }
};

/// What the first pass taught.
struct MixRefinement {
  SampleAllocation samples;
  RadianceGuide directions;
  static void members(auto& self, auto& archive) { archive(self.samples, self.directions); }
};

class LearnedMix final : public Learned {
 public:
  explicit LearnedMix(MixPlan plan, std::optional<MixRefinement> refinement = {})
      : plan_(std::move(plan)), refinement_(std::move(refinement)) {}
  const MixPlan& plan() const { return plan_; }
  /// Empty before the first pass was learned from.
  const std::optional<MixRefinement>& refinement() const { return refinement_; }
  void write(ByteWriter& to) const override { to(plan_, refinement_); }
  void add_to(EstimatorStatistics& statistics) const override;

 private:
  MixPlan plan_;
  std::optional<MixRefinement> refinement_;
};

}  // namespace nephroid
