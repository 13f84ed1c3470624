// Counts the light of each lamp that an estimator finds in the first passes. Each slice of pixels
// counts by itself. Sums are exact, so threads do not matter. It must not know walks.
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
  /// Counts in pass number `pass` if `counts` and the pass is among the first.
  LampCounter(const SceneSymbols& symbols, uint32_t pass, bool counts = true);
  LampCounter(const LampCounter&) = delete;
  LampCounter& operator=(const LampCounter&) = delete;

  bool counts() const { return counts_; }

  /// The counts of one thread, added to the counter on destruction. `counter` may be null.
  class Slice {
   public:
    /// Lets `light` tell lamps apart from now on, if the counter counts.
    Slice(LampCounter* counter, PartSums& light);
    Slice(const Slice&) = delete;
    Slice& operator=(const Slice&) = delete;
    ~Slice();
    /// Takes the light of a sample, as the sum of a colour's components times `factor`.
    void take(const SensorWeights& weights, double factor);

   private:
    LampCounter* counter_;
    PartSums& light_;
    std::vector<double> found_;  ///< [lamp]
  };

  /// Each splat counts `share` times. Splats beside the film and non-finite values do not count.
  void add_splats(std::span<const Splat> splats, const FilmFormat& film, double share);
  /// Adds the counts to those of other passes.
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
