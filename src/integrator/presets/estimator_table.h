// The table of all estimators that routes can name.
#pragma once

#include <vector>

#include "integrator/estimator/estimator_descriptor.h"
#include "route/routes.h"

namespace nephroid {

/// Rows in the order of the help text.
using EstimatorTable = std::span<const EstimatorDescriptor* const>;
EstimatorTable estimator_table();

/// The traits of all rows, for parse_route.
TraitsTable estimator_traits();

/// The row of a group of routes. Throws std::logic_error if its estimator is not in the table.
const EstimatorDescriptor& descriptor_of(const RouteGroup& group,
                                         EstimatorTable table = estimator_table());

}  // namespace nephroid
