#include "session/learn_lights.h"

#include "session/pass_watch.h"
#include "transport/light_survey.h"

namespace nephroid {

bool learn_lights(const Scene& scene, const SignalFlags& signals,
                  const std::function<double()>& now) {
  const auto stop = [&] {
    if (signals.stop.load() != 0) throw PassStopped{};
  };
  PassWatch watch(signals, now, stop);
  watch.wake_at(kInfinity);
  try {
    stop();
    scene.light_sampler->learn(survey_lights(scene, watch));
    return true;
  } catch (const PassStopped&) {
    return false;
  }
}

}  // namespace nephroid
