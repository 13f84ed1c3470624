// Which of the user's -D keys change nothing with the routes that render. Who calls it: the render
// command. It must not know what keys do.
#pragma once

#include <string>
#include <vector>

#include "route/route_set.h"
#include "session/settings/integrator_settings.h"

namespace nephroid {

/// A sentence for each key that concerns only estimators which own no route here.
std::vector<std::string> unused_settings(const SettingList& settings, const Routes& routes);

}  // namespace nephroid
