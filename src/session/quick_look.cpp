#include "session/quick_look.h"

#include <algorithm>

#include "film/film_settings.h"
#include "integrator/presets/integrator_table.h"
#include "scene/scene.h"
#include "session/pass_watch.h"

namespace nephroid {
namespace {

constexpr int64_t kMinPixels = 4 * PixelSlices::kMaxFirstPixels;
constexpr double kMaxSeconds = 1, kSecondsBetweenLooks = 0.01;

}  // namespace

bool is_worth_a_quick_look(const EstimatorSet& set, const FilmFormat& film) {
  return film.bounds().area() >= kMinPixels &&
         std::ranges::any_of(set.estimators, [](const auto& estimator) {
           return estimator->descriptor().traits.starts_at_lights;
         });
}

void take_quick_look(const QuickLook& look, const SignalFlags& signals,
                     const std::function<double()>& now) {
  IntegratorOptions options;
  options.max_depth = look.max_depth;
  EstimatorSet set = make_estimators(plan_of_integrator("path"), options, look.scene);
  Film film(film_settings(look.scene.film), set.layout);
  const double begin = now();
  PassWatch watch(signals, now, [&] {
    if (film.can_be_shown() || now() >= begin + kMaxSeconds || signals.stop.load() != 0)
      throw PassStopped{};
    watch.wake_at(now() + kSecondsBetweenLooks);
  });
  watch.wake_at(begin);
  try {
    set.render_pass({look.seed, 0}, look.scene, film, watch);
  } catch (const PassStopped&) {
    if (!film.can_be_shown()) return;
  }
  look.show(film);
}

}  // namespace nephroid
