// Counts, in the first passes, how much light of each lamp an estimator found. Slices of pixels
// count for themselves and are added exactly, so that threads do not matter. It must not know
// walks.
#pragma once

#include <mutex>
#include <span>
#include <vector>

#include "film/fixed_sum.h"
#include "film/part_sums.h"
#include "film/splats.h"
#include "integrator/estimator/estimator_statistics.h"
#include "route/scene_symbols.h"

namespace nephroid {

class LampCounter {
 public:
  /// Of pass number `pass`; without `counts` of none.
  LampCounter(const SceneSymbols& symbols, uint32_t pass, bool counts = true);
  LampCounter(const LampCounter&) = delete;
  LampCounter& operator=(const LampCounter&) = delete;

  bool counts() const { return counts_; }

  /// What one thread counts, added when it ends. `counter` may be null.
  class Slice {
   public:
    /// `light` tells lamps apart from now on, if the counter counts.
    Slice(LampCounter* counter, PartSums& light);
    Slice(const Slice&) = delete;
    Slice& operator=(const Slice&) = delete;
    ~Slice();
    /// What a sample found, as the sum of a colour's components times `factor`.
    void take(const SensorWeights& weights, double factor);

   private:
    LampCounter* counter_;
    PartSums& light_;
    std::vector<double> found_;  ///< [lamp]
  };

  /// Each counts `share` times; those beside the film do not, nor what is not finite.
  void add_splats(std::span<const Splat> splats, const FilmFormat& film, double share);
  /// Adds them to what other passes found.
  void add_to(EstimatorStatistics& statistics) const;

 private:
  struct Count {
    FixedSum light;
    uint64_t rays = 0;
  };
  void add(const std::vector<double>& found, std::span<const uint32_t> rays);

  const SceneSymbols& symbols_;
  const bool counts_;
  std::mutex mutex_;
  std::vector<Count> lamps_;  ///< [lamp]
};

}  // namespace nephroid
