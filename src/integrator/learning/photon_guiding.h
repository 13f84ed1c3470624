// Learns where the photons of an estimator should start and where they should go from rough
// surfaces: what the camera sees through its routes is scattered over the scene as points, photons
// are traced in a few rounds, and the paths of those that land near such a point make the guide,
// each round with what the rounds before have learned (docs/estimators.md, section 20).
#pragma once

#include "integrator/estimator/estimator.h"
#include "photon/photon_guide.h"
#include "route/scene_symbols.h"

namespace nephroid {

/// What photon guiding has learned.
struct GuidedPhotons {
  PhotonGuide guide;
  uint64_t rays = 0;  ///< that learning took

  /// What was learned, in words.
  void add_notes(EstimatorStatistics& statistics) const;
  static void members(auto& self, auto& archive) { archive(self.guide, self.rays); }
};

/// A function of its arguments. With `guides_scattering` photons are guided from rough surfaces,
/// too (ADR 25); else where they start alone. Guides nothing where options or routes have no use
/// for it.
GuidedPhotons guide_photons(uint64_t seed, const Scene& scene, const FilmFormat& film,
                            const OwnedRoutes& owned, const IntegratorOptions& options,
                            bool guides_scattering, PassControl& control = unwatched);

/// The same where photons start, for an estimator of other routes whose photons are of use where
/// those of a route of caustics would be. `casters`: what throws these, kSpecular or that and
/// kGlossy.
GuidedPhotons guide_caustic_photons(uint64_t seed, const Scene& scene, const FilmFormat& film,
                                    const IntegratorOptions& options, ClassMask casters,
                                    PassControl& control = unwatched);

/// The same as what an estimator has learned.
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
