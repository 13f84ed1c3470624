// How an eye path ends behind a vertex where photons of all light were merged: light that comes
// there by way of another rough vertex is in these photons, so the more of them there are, the less
// is left for the path to find ([W12] in docs/estimators.md). It must not know photons or places.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>

#include "scene/bsdf/bsdf.h"

namespace nephroid {

class MergeRoulette {
 public:
  /// Where photons come in batches, `of_batches` is how many of all of them the path merges where
  /// it leaves its first rough vertex by a D; with `counts` those of a batch are added to it, and
  /// the path ends there. `photons_for_one`: PairMerging.
  MergeRoulette(uint32_t* of_batches, bool counts, float photons_for_one)
      : of_batches_(of_batches), counts_(counts), photons_for_one_(photons_for_one) {}

  /// The path merges a photon at the vertex where it is.
  void merge() {
    ++here_;
    ++all_;
  }
  /// Where it comes out from under a surface: photons where it went in say nothing of that place.
  void come_out() { here_ = 0; }
  /// It leaves the vertex. `first`: no event was rough before.
  void leave(EventClass letter, bool first) {
    const uint32_t here = std::exchange(here_, 0u);
    if (!first || letter != EventClass::kDiffuse) return;
    if (counts_) *of_batches_ += here;
    before_ = of_batches_ ? *of_batches_ : here;
  }
  /// At the next rough vertex: the chance to go on there, 1 from then on.
  float survival() {
    constexpr float kLeast = 1.0f / 16;
    const float merged = photons_for_one_ * static_cast<float>(std::exchange(before_, 0u));
    return std::clamp(1 / std::max(merged, 1.0f), kLeast, 1.0f);
  }
  bool counts() const { return counts_; }
  uint64_t merged() const { return all_; }  ///< photons, so far

 private:
  uint32_t* const of_batches_;
  const bool counts_;
  const float photons_for_one_;
  uint64_t all_ = 0;
  uint32_t here_ = 0, before_ = 0;
};

}  // namespace nephroid
