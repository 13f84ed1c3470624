// `path+photons`: one walk from the eye that finds everything path tracing finds, and whose
// caustics are photons as well, each weighed against the other; where trial passes show that it is
// worth its time, light paths are connected and merged everywhere, too. How many light paths a pass
// has, where they start and how many camera paths each tile has is learned from the scene, a
// function of scene, film, options and seed (docs/estimators.md, sections 20 to 23).
// Papers: Doidge, Jones & Mora 2012, whose future work this is; Georgiev et al. 2012 for weights;
// Grittmann et al. 2022 for choosing techniques by efficiency.
#pragma once

#include <optional>

#include "integrator/bidirectional/pair_pass.h"
#include "integrator/learning/photon_guiding.h"

namespace nephroid {

class PathAndPhotons final : public Estimator {
 public:
  /// Camera paths of each pixel in the first pass, from whose spread the others learn.
  static constexpr int kHead = 8;

  PathAndPhotons(OwnedRoutes owned, const IntegratorOptions& options);
  Capabilities capabilities() const override { return {}; }
  bool records_features() const override { return true; }
  void render_pass(const PassKey& key, const Scene& scene, Film& film) override;
  /// Its notes say what was learned.
  EstimatorStatistics statistics() const override;
  /// What the pass that takes most has for each pixel, the first one.
  static constexpr size_t bytes_per_pixel(size_t parts, bool clamps) {
    return PairPass::bytes_per_pixel(parts, kHead, clamps ? kHead : 0);
  }

 private:
  /// What all passes of a seed share.
  struct Learned {
    Learned(uint64_t of_seed, const SampleMap& of_head) : seed(of_seed), head(of_head) {}
    uint64_t seed;
    PairPass pass;                   ///< light paths are those of the first one
    std::optional<Balance> balance;  ///< empty: light paths are the same in all
    SampleMap head;                  ///< camera paths of the first pass
    bool is_even = false;            ///< all passes have as many
    bool is_seen = false;            ///< the first pass was asked for spread and records
    struct Spread {
      explicit Spread(const PixelBounds& b) : paths(b), glints(b), choice(b) {}
      SampleSpread paths, glints, choice;
    };
    std::optional<Spread> spread;  ///< unless all passes have as many paths
    std::vector<RadianceRecord> records;
    // Of the passes after it.
    std::optional<Shares> shares;
    std::optional<RadianceGuide> radiance;  ///< empty until the first pass was looked at
  };
  /// The first pass, which leaves what later ones learn from.
  PairPass first_pass(const Film& film);
  /// Of a pass with so many camera paths a pixel.
  int64_t light_paths(double camera_paths) const;
  /// Makes shares and guide of what the first pass has left, or traces it for that.
  void look_back(const Scene& scene, const Film& film);
  void learn(uint64_t seed, const Scene& scene, const Film& film);
  /// What a few passes that are thrown away tell of a way to render.
  Trial try_out(PairPass how, uint64_t seed, const Scene& scene, const Film& film);

  OwnedRoutes owned_;
  IntegratorOptions options_;
  LearnedPhotons learned_photons_;
  std::optional<Learned> learned_;
  EstimatorStatistics statistics_;
};

}  // namespace nephroid
