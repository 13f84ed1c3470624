// One pass of an estimator that pairs eye paths with light paths: photons are traced and merged,
// and where the pass connects, another set of light paths, one for each camera path, is connected
// to it. Wavelengths and time are the pass's; nothing is kept but photons, in batches that fit in
// memory. It must not know passes before it, or what becomes of what it measures.
#pragma once

#include <optional>

#include "film/splats.h"
#include "integrator/bidirectional/measured_samples.h"
#include "integrator/bidirectional/technique_choice.h"
#include "integrator/estimator/estimator.h"
#include "integrator/learning/guided_walk.h"
#include "integrator/path/specular_chain_pass.h"
#include "photon/emission_guide.h"
#include "route/scene_symbols.h"

namespace nephroid {

/// Cost of merging a photon, in rays: 70 to 120 ns where a ray takes 700.
inline constexpr double kCostOfMerge = 0.13;

/// The techniques of a pass, among which trial passes choose.
struct PairTechniques {
  int64_t light_paths = 1;  ///< number of light paths that leave photons; 0: no photons
  bool connects = true;     ///< false: camera paths are connected to lights only
  /// Only photons that passed an event of one of these classes are merged (CasterRule); kNone: all
  /// photons are. If not kNone, `connects` must be false.
  ClassMask casters = ClassMask::kNone;
  bool separates_chains = false;  ///< specular chains are for walks of their own
  bool follows_chains = false;    ///< camera paths follow them: SpecularRoot::Leaves::kBranches
  float roulette_threshold = 1;   ///< of camera paths
  bool merges_all_light() const { return casters == ClassMask::kNone; }
  static void members(auto& self, auto& archive) {
    archive(self.light_paths, self.connects, self.casters, self.separates_chains,
            self.follows_chains, self.roulette_threshold);
  }
  bool is_sound() const {
    const bool merges_caustics =
        casters == ClassMask::kSpecular || casters == (ClassMask::kSpecular | ClassMask::kGlossy);
    return light_paths >= 0 && (merges_all_light() || (merges_caustics && !connects)) &&
           !(separates_chains && follows_chains) && roulette_threshold > 0 &&
           roulette_threshold <= 1;
  }
};

/// The inputs of a pass, whatever it is for.
struct PairPass {
  PassKey key;
  uint64_t seed = 0;  ///< of the estimator's random numbers: those of one plan are independent
  const Scene& scene;
  const OwnedRoutes& owned;
  const IntegratorOptions& options;
  PairTechniques techniques{};
  float radius_pixels = 1;    ///< merge radius, in footprints
  float photons_for_one = 1;  ///< PairMerging
  const EmissionGuide& emission = kUnguided;
  /// Estimators whose passes differ in their number of light paths: each number has a sequence of
  /// random numbers of its own.
  bool light_paths_vary = false;
  /// The samples of a pixel do not fill each other's gaps, so that their spread is that of one.
  bool independent_samples = false;
  /// One technique of the estimator alone.
  TechniqueChoice technique{};
  PassControl& control = unwatched;
};

/// How often each pixel is sampled.
struct PairSamples {
  const SampleMap& paths;   ///< camera paths
  const SampleMap& chains;  ///< walks for specular chains; 0: camera paths find them
};

/// A pass whose light goes to a film.
struct PairRender {
  Film& film;
  PairSamples samples;
  bool adds_features = false;  ///< camera paths add what they see first to the film's features
  const RadianceGuide& directions = kNoRadiance;  ///< of camera paths
};

/// A pass over the first lattice of a film that is measured so that others can be better.
struct PairLearning {
  bool measures_variance = true;
  bool keeps_records = true;  ///< of the light behind the vertices of camera paths
  double records_per_path = PassRecords::kMaxPerPath;  ///< expected, in the mean
};
struct PairFindings {
  struct Variance {
    Variance(const PixelBounds& b, int spacing) : paths(b, spacing), chains(b, spacing) {}
    SampleVariance paths;
    ChainVariance chains;
  };
  std::optional<Variance> variance;
  std::vector<RadianceRecord> records;
};

/// A pass without splats over the first lattice that tells how good its techniques are, and whose
/// light is thrown away.
struct PairTrial {
  const SampleMap& paths;  ///< camera paths of each pixel
  bool counts_records = false;
  double records_per_path = PassRecords::kMaxPerPath;
};

/// Adds a pass to the film, the number of estimates included.
void render(const PairPass& pass, const PairRender& to, EstimatorStatistics& statistics);
/// Measures a pass for no film.
PairFindings measure(const PairPass& pass, const FilmFormat& film, const PairSamples& samples,
                     const PairLearning& learning, EstimatorStatistics& statistics);
/// Adds the light of camera paths, without specular chains, to `variance`. Returns the number of
/// radiance records that the paths would leave.
size_t try_out(const PairPass& pass, const FilmFormat& film, const PairTrial& trial,
               SampleVariance& variance, EstimatorStatistics& statistics);

/// Memory of a pass for each pixel that has so many samples at most.
size_t pair_pass_bytes_per_pixel(size_t parts, size_t samples, bool clamps, bool splats);

}  // namespace nephroid
