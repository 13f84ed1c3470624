// Russian roulette of eye paths behind a vertex where photons of all light were merged ([W12] in
// docs/estimators.md). The more photons were merged, the less light is left for the path to find.
// It must not know photons or places.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>

#include "scene/bsdf/bsdf.h"

namespace nephroid {

class MergeRoulette {
 public:
  /// If photons come in batches, `of_batches` is the number of photons of all batches merged at the
  /// first rough vertex, if the path leaves it by a D. With `counts` the photons of one batch are
  /// added to it, and the path ends there. `photons_for_one` is PairMerging's.
  MergeRoulette(uint32_t* of_batches, bool counts, float photons_for_one)
      : of_batches_(of_batches), counts_(counts), photons_for_one_(photons_for_one) {}

  /// Counts a photon merged at the current vertex.
  void merge() {
    ++here_;
    ++all_;
  }
  /// Counts a photon merged in a medium. It says nothing about the light behind a vertex.
  void count_in_medium() { ++all_; }
  /// At the exit from under a surface: forgets the photons merged at the entry.
  void come_out() { here_ = 0; }
  /// The path leaves the vertex. `first`: no earlier event was rough.
  void leave(EventClass letter, bool first) {
    const uint32_t here = std::exchange(here_, 0u);
    if (!first || letter != EventClass::kDiffuse) return;
    if (counts_) *of_batches_ += here;
    const float merged = photons_for_one_ * static_cast<float>(of_batches_ ? *of_batches_ : here);
    survival_ = std::clamp(1 / merged, kMinSurvival, kMaxSurvival);
  }
  /// q of [W12], the survival probability at the next rough vertex; 1 from then on.
  float survival() { return std::exchange(survival_, 1.0f); }
  bool counts() const { return counts_; }
  uint64_t merged() const { return all_; }  ///< photons merged so far

 private:
  static constexpr float kMinSurvival = 1.0f / 16, kMaxSurvival = 0.5f;

  uint32_t* const of_batches_;
  const bool counts_;
  const float photons_for_one_;
  uint64_t all_ = 0;
  uint32_t here_ = 0;
  float survival_ = 1;
};

}  // namespace nephroid
