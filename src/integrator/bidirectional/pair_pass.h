// One pass of an estimator of path pairs: photons are traced in batches that fit in memory and
// merged. If the pass connects, each camera path is also connected to a light path of its own. All
// paths share wavelengths and time. It must not know earlier passes or the use of what it measures.
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
#include "transport/casters.h"

namespace nephroid {

/// Cost of merging a photon, in rays: 70 to 120 ns over the 700 ns of a ray.
inline constexpr double kCostOfMerge = 0.13;

/// The techniques of a pass, among which trial passes choose.
struct PairTechniques {
  int64_t light_paths = 1;  ///< number of light paths that leave photons; 0: no photons
  bool connects = true;     ///< false: camera paths are connected to lights only
  /// Classes of casters: only photons that had such an event are merged (CasterRule). kNone: all
  /// photons are merged. If neither kNone nor kAll, `connects` must be false.
  ClassMask casters = ClassMask::kNone;
  /// Photons of indirect light are also merged in media: camera paths do not scatter there before
  /// their first other event that is no S ([V8]). Needs casters of kAll and no `connects`.
  bool gathers_in_media = false;
  bool separates_chains = false;  ///< walks of their own look for specular chains
  bool follows_chains = false;    ///< camera paths grow specular trees (Leaves::kBranches)
  float roulette_threshold = 1;   ///< Russian roulette threshold of camera paths
  bool merges_all_light() const { return CasterRule(casters).merges_all_light(); }
  static void members(auto& self, auto& archive) {
    archive(self.light_paths, self.connects, self.casters, self.gathers_in_media,
            self.separates_chains, self.follows_chains, self.roulette_threshold);
  }
  bool is_sound() const {
    const bool merges_caustics =
        casters == ClassMask::kSpecular || casters == (ClassMask::kSpecular | ClassMask::kGlossy);
    return light_paths >= 0 && (merges_all_light() || (merges_caustics && !connects)) &&
           (!gathers_in_media || (casters == ClassMask::kAll && !connects)) &&
           !(separates_chains && follows_chains) && roulette_threshold > 0 &&
           roulette_threshold <= 1;
  }
};

/// The inputs of every kind of pass.
struct PairPass {
  PassKey key;
  uint64_t seed = 0;  ///< the estimator's seed; estimators of one plan have different ones
  const Scene& scene;
  const OwnedRoutes& owned;
  const IntegratorOptions& options;
  PairTechniques techniques{};
  float radius_pixels = 1;    ///< merge radius in footprints
  float photons_for_one = 1;  ///< as in PairMerging
  const EmissionGuide& emission = kUnguided;
  /// The estimator's passes differ in their number of light paths: each number has a sequence of
  /// random numbers of its own.
  bool light_paths_vary = false;
  /// The samples of a pixel are independent, not stratified, so their variance is that of one.
  bool independent_samples = false;
  /// [W13]; not over a lattice of pixels, where discs are larger and hold fewer photons than those
  /// of the film, and would seem noisier.
  bool corrects_edges = true;
  /// Techniques to render: all, or one alone.
  TechniqueChoice technique{};
  PassControl& control = unwatched;
};

/// Number of samples of each pixel.
struct PairSamples {
  const SampleMap& paths;   ///< camera paths per pixel
  const SampleMap& chains;  ///< walks for specular chains per pixel; 0: camera paths find them
};

/// Options of a pass whose light goes to a film.
struct PairRender {
  Film& film;
  PairSamples samples;
  bool adds_features = false;                     ///< camera paths record the film's features
  const RadianceGuide& directions = kNoRadiance;  ///< guide of camera paths
};

/// Options of a measured pass over the first lattice of a film, from which later passes learn.
struct PairLearning {
  bool measures_variance = true;
  bool keeps_records = true;  ///< keeps records of the light behind vertices of camera paths
  double records_per_path = PassRecords::kMaxPerPath;  ///< expected mean of records per path
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

/// Options of a trial: a pass over the first lattice, without splats, that measures how good its
/// techniques are. Its light is thrown away.
struct PairTrial {
  const SampleMap& paths;  ///< camera paths per pixel
  bool counts_records = false;
};

/// Adds a pass to the film, the number of estimates included.
void render(const PairPass& pass, const PairRender& to, EstimatorStatistics& statistics);
/// Measures a pass without adding it to a film.
PairFindings measure(const PairPass& pass, const FilmFormat& film, const PairSamples& samples,
                     const PairLearning& learning, EstimatorStatistics& statistics);
/// Adds the light of camera paths, without specular chains, to `variance`. Returns the number of
/// radiance records that the paths would leave.
size_t run_trial(const PairPass& pass, const FilmFormat& film, const PairTrial& trial,
                 SampleVariance& variance, EstimatorStatistics& statistics);

/// Memory of a pass per pixel, with at most so many samples.
size_t pair_pass_bytes_per_pixel(size_t parts, size_t samples, bool clamps, bool splats);

}  // namespace nephroid
