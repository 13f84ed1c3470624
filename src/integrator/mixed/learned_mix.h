// The learned value of `path+photons`. It must not know how it is learned.
#pragma once

#include "integrator/bidirectional/pair_pass.h"
#include "integrator/learning/photon_guiding.h"
#include "integrator/mixed/balance.h"

namespace nephroid {

/// The plan of all passes: guide of photon emission, techniques, allocation of samples, and guide
/// of camera paths.
struct MixPlan {
  GuidedPhotons photons;
  PairTechniques techniques;  ///< techniques with the number of light paths
  SampleAllocation samples;
  RadianceGuide directions;
  bool is_even = false;                        ///< all pixels have equally many camera paths
  uint64_t rays = 0;                           ///< rays of learning without those of `photons`
  uint64_t photon_bytes = 0, pixel_bytes = 0;  ///< memory of learning

  static void members(auto& self, auto& archive) {
    archive(self.photons, self.techniques, self.samples, self.directions, self.is_even, self.rays,
            self.photon_bytes, self.pixel_bytes);
  }
};

class LearnedMix final : public Learned {
 public:
  explicit LearnedMix(MixPlan plan) : plan_(std::move(plan)) {}
  const MixPlan& plan() const { return plan_; }
  void write(ByteWriter& to) const override { to(plan_); }
  void add_to(EstimatorStatistics& statistics) const override;

 private:
  MixPlan plan_;
};

}  // namespace nephroid
