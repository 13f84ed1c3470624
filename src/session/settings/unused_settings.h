// Finds -D keys that have no effect with the routes of a render. It must not know what the keys do.
#pragma once

#include <string>
#include <vector>

#include "route/routes.h"

namespace nephroid {

/// A warning for each key that belongs only to estimators without a route.
std::vector<std::string> unused_settings(const std::vector<std::string>& keys,
                                         const Routes& routes);

}  // namespace nephroid
