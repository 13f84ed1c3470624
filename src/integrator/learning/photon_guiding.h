// Learns a guide for photon emission, and for photons that leave rough surfaces. Camera walks leave
// visible points, photons are traced in a few rounds, and paths that land near a visible point make
// the guide. Each round uses the guide of the rounds before (docs/estimators.md, section 20).
#pragma once

#include "integrator/estimator/estimator.h"
#include "photon/photon_guide.h"
#include "route/scene_symbols.h"

namespace nephroid {

/// The learned guide and its cost.
struct GuidedPhotons {
  PhotonGuide guide;
  uint64_t rays = 0;  ///< rays of learning

  /// Adds the findings as sentences.
  void add_notes(EstimatorStatistics& statistics) const;
  static void members(auto& self, auto& archive) { archive(self.guide, self.rays); }
};

/// Learns the guide, a function of the arguments. With `guides_scattering` photons are also guided
/// when they leave rough surfaces (ADR 25), else at emission only. Guides nothing if the options
/// forbid it or the routes need no photons.
GuidedPhotons guide_photons(uint64_t seed, const Scene& scene, const FilmFormat& film,
                            const OwnedRoutes& owned, const IntegratorOptions& options,
                            bool guides_scattering, PassControl& control = unwatched);

/// The same at emission only, for an estimator of any routes. Photons count as useful if they have
/// passed one of the `casters`, as CasterRule has them: kSpecular, kSpecular and kGlossy, or kAll.
GuidedPhotons guide_photons_of(ClassMask casters, uint64_t seed, const Scene& scene,
                               const FilmFormat& film, const IntegratorOptions& options,
                               PassControl& control = unwatched);

/// GuidedPhotons as an estimator's learned value.
class LearnedPhotons final : public Learned {
 public:
  explicit LearnedPhotons(GuidedPhotons photons) : photons_(std::move(photons)) {}
  const PhotonGuide& guide() const { return photons_.guide; }
  void write(ByteWriter& to) const override { to(photons_); }
  void add_to(EstimatorStatistics& statistics) const override;

 private:
  GuidedPhotons photons_;
};

}  // namespace nephroid
