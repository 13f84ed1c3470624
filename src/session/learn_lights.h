// Teaches a scene's light sampler before a render, unless a signal comes first. It must not know
// how the survey works.
#pragma once

#include <functional>

#include "scene/scene.h"
#include "session/signals.h"

namespace nephroid {

/// False if a stop was signalled: then nothing was learned, and nothing may be rendered, as its
/// light would be that of other choices. `now` is a clock in seconds.
bool learn_lights(const Scene& scene, const SignalFlags& signals,
                  const std::function<double()>& now);

}  // namespace nephroid
