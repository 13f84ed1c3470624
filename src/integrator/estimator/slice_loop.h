// The loop over the pixels of a pass in slices, coarse to fine, on any thread, for passes that
// finish one pixel after another. It must not know what is done at a pixel.
#pragma once

#include <span>
#include <vector>

#include "core/parallel.h"
#include "film/film.h"

namespace nephroid {

/// Runs work(result, slice) for each of `slices` and calls append(result) for all in their order.
/// Throws PassStopped, after it has appended the results so far.
template <class Result, class Work, class Append>
void for_each_slice(PassControl& control, std::span<const size_t> slices, Work&& work,
                    Append&& append) {
  std::vector<Result> results(slices.size());
  const auto append_all = [&] {
    for (Result& result : results) append(std::move(result));
  };
  try {
    parallel_chunks(control, slices.size(), 1,
                    [&](int64_t i, int64_t, int64_t) { work(results[i], slices[i]); });
  } catch (const PassStopped&) {
    append_all();
    throw;
  }
  append_all();
}

/// Adds a pass to the film, slice by slice.
struct SlicesOfPass {
  Film& film;
  int group = 0;                   ///< layout().group_count() for features alone
  uint64_t estimates = 1;          ///< estimates per pixel
  uint64_t feature_estimates = 0;  ///< feature estimates per pixel

  /// The slices that the film does not have, in order.
  std::vector<size_t> missing() const {
    std::vector<size_t> slices;
    for (size_t s = 0; s < film.slices().count(); ++s)
      if (!film.has_slice(group, s)) slices.push_back(s);
    return slices;
  }
  void finish(size_t slice) const {
    film.finish_slice(group, slice, estimates);
    if (feature_estimates > 0) film.finish_feature_slice(slice, feature_estimates);
  }
  void finish_pass() const {
    film.add_estimates(group, estimates);
    if (feature_estimates > 0) film.add_feature_estimates(feature_estimates);
  }
  /// Runs the pass: work(result, run of pixels) for each missing slice, append(result) in order.
  template <class Result, class Work, class Append>
  void render(PassControl& control, Work&& work, Append&& append) const {
    const auto work_on = [&](Result& result, size_t slice) {
      work(result, film.slices().at(slice));
      finish(slice);
    };
    for_each_slice<Result>(control, missing(), work_on, append);
    finish_pass();
  }
};

}  // namespace nephroid
