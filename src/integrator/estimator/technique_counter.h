// Counts the light that each technique of an estimator finds for each of its routes in the first
// passes. Rows of pixels count by themselves and are added in order, so threads do not matter. It
// must not know walks.
#pragma once

#include <span>
#include <vector>

#include "film/part_sums.h"
#include "film/splats.h"
#include "integrator/estimator/estimator.h"

namespace nephroid {

class TechniqueCounter {
 public:
  using Row = std::vector<TechniqueLight>;  ///< [part]; empty where nothing is counted

  /// Counts in pass number `pass` of a group of the film.
  TechniqueCounter(const FilmFormat& film, size_t group, uint32_t pass);
  /// Counts nothing.
  explicit TechniqueCounter(const FilmFormat& film) : film_(film) {}

  /// Counts for a row of pixels; lets `light` tell techniques apart if they are counted.
  Row start_row(PartSums& light) const;
  void add(const Row& row) { join(row, parts_); }
  static void join(const Row& row, Row& into);
  /// Each splat counts `share` times. Splats beside the film and non-finite values do not count.
  void add_splats(std::span<const Splat> splats, double share);
  /// Adds the counts, summed over the parts of each route, to those of other passes.
  void add_to(std::vector<RouteTechniques>& all) const;

 private:
  const FilmFormat& film_;
  size_t group_ = 0;
  Row parts_;
};

}  // namespace nephroid
