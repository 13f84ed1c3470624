// Estimators that stand in for those whose single paths cannot be traced again, in inspections of
// pixels. It must not know what is recorded.
#pragma once

#include <optional>
#include <string>

#include "integrator/presets/estimator_set.h"

namespace nephroid {

struct StandIn {
  EstimatorSet set;  ///< the same routes, with one estimator in the place of all that cannot
  const EstimatorDescriptor* estimator = nullptr;  ///< the one that stands in
  std::string note;                                ///< what stands in for what

  /// True for an estimator of `set` that stands in, and for one in the place of which it stands.
  bool replaces(const Estimator& other) const {
    return !other.records_pixels() || &other.descriptor() == estimator;
  }
};

/// Empty if all estimators of the set can record their paths.
std::optional<StandIn> stand_in_for(const EstimatorSet& set, const Scene& scene,
                                    const IntegratorOptions& options);

}  // namespace nephroid
