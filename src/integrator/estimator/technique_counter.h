// Counts, in the first passes, how much light each technique of an estimator found for each of its
// routes. Rows of pixels count for themselves and are added in their order, so that threads do not
// matter. It must not know walks.
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

  /// Of pass number `pass` of a group of the film.
  TechniqueCounter(const FilmFormat& film, size_t group, uint32_t pass);
  /// Counts nothing.
  explicit TechniqueCounter(const FilmFormat& film) : film_(film) {}

  /// What a row of pixels counts in, with sums that tell techniques apart if it does.
  Row start_row(PartSums& light) const;
  void add(const Row& row) { join(row, parts_); }
  static void join(const Row& row, Row& into);
  /// Each counts `share` times; those beside the film do not, nor what is not finite.
  void add_splats(std::span<const Splat> splats, double share);
  /// Joins the parts of each route and adds them to what other passes found.
  void add_to(std::vector<RouteTechniques>& all) const;

 private:
  const FilmFormat& film_;
  size_t group_ = 0;
  Row parts_;
};

}  // namespace nephroid
