#include "integrator/photons/photon_pass.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "transport/path_points.h"
#include "transport/roughness_band.h"

namespace nephroid {

namespace {

// Default number of photons per pass; it grows with the picture, within bounds.
int64_t default_photons_per_pass(int64_t pixels) {
  constexpr int64_t kMinPhotons = 1 << 16, kMaxPhotons = 1 << 20;
  return std::clamp<int64_t>(std::bit_ceil(static_cast<uint64_t>(pixels)), kMinPhotons,
                             kMaxPhotons);
}

}  // namespace

Vec2f wavelengths_and_time_of_pass(const PassKey& key) {
  constexpr int kShift = std::countr_zero(static_cast<unsigned>(kSpectrumSamples));
  static_assert(1 << kShift == kSpectrumSamples);
  constexpr uint64_t kStream = 0x70617373;  // "pass"
  const uint64_t of_order = hash_combine(key.seed, kStream, 0);
  const uint64_t of_places = hash_combine(key.seed, kStream, 1);
  // The order must be independent of the camera walks' order, or a pixel would see each time at one
  // place only. Runs of 2^k passes that start at a multiple of 2^k stay together.
  const uint32_t index =
      owen_scramble_reversed(reverse_bits(key.pass), static_cast<uint32_t>(of_order));
  const uint32_t reversed = reverse_bits(index);
  return {bits_to_unit_float((reversed ^ (reversed >> kShift)) ^
                             static_cast<uint32_t>(of_places >> 32)),
          bits_to_unit_float(owen_scramble_reversed(sobol_second_reversed(index),
                                                    static_cast<uint32_t>(of_places)))};
}

PhotonPass start_photon_pass(const PassKey& key, const Scene& scene, const FilmFormat& film,
                             const IntegratorOptions& options, PassControl& control) {
  constexpr uint64_t kHeroes = 0x6865726f;  // "hero"
  PhotonPass pass{.trace = {},
                  .weights = {},
                  .footprint = scene.camera->footprint(),
                  .u_time = 0,
                  .first_hero = static_cast<uint32_t>(hash_combine(key.seed, kHeroes)),
                  .point = eye_point(key.pass)};
  pass.trace.key = key;
  pass.trace.control = &control;
  const Vec2f u = wavelengths_and_time_of_pass(key);
  pass.trace.lambda = SampledWavelengths::sample_visible(wavelength_number(scene, u.x));
  pass.u_time = u.y;
  pass.trace.time = scene.camera->motion_time(pass.u_time);
  pass.trace.photons_per_pass = options.photons_per_pass > 0
                                    ? options.photons_per_pass
                                    : default_photons_per_pass(film.bounds().area());
  pass.trace.max_events = options.max_depth;
  pass.trace.specular_alpha = specular_alpha_of_pass(scene.specular_band, key);
  pass.weights = sensor_weights(pass.trace.lambda, *film.settings().color_space,
                                film.settings().imaging_ratio, film.settings().white_balance);
  return pass;
}

namespace {

/// True if `what(light state, label)` is not empty for some light and label of the scene.
template <class What>
bool any_emitted(const OwnedRoutes& owned, What&& what) {
  const Routes& routes = *owned.routes;
  const SymbolSet& present = owned.symbols->present();
  for (size_t light = 0; light < present.lights.size(); ++light) {
    if (!present.lights[light]) continue;
    const LightState state = routes.emitted(static_cast<LightSymbol>(light));
    for (size_t label = 0; label <= routes.labels().size(); ++label)
      if (what(state, static_cast<Label>(label)) != ClassMask::kNone) return true;
  }
  return false;
}

}  // namespace

bool deposits_at_once(const OwnedRoutes& owned) {
  return any_emitted(owned, [&](LightState light, Label label) {
    return owned.routes->deposits(owned.group, light, label);
  });
}

bool has_events(const OwnedRoutes& owned, EventClass letter) {
  const std::vector<bool>& events = owned.symbols->present().events;
  for (size_t e = 0; e < events.size(); ++e)
    if (events[e] && class_of(kind_of(static_cast<EventSymbol>(e))) == letter) return true;
  return false;
}

std::string names_of_routes(const OwnedRoutes& owned) {
  const std::vector<int>& routes = owned.routes->groups()[owned.group].routes;
  std::string text = routes.size() == 1 ? "route" : "routes";
  for (size_t i = 0; i < routes.size(); ++i)
    text += (i == 0 ? " '" : ", '") + owned.routes->definitions()[routes[i]].name + "'";
  return text;
}

bool photons_can_count(const OwnedRoutes& owned) {
  return deposits_at_once(owned) || any_emitted(owned, [&](LightState light, Label label) {
           return owned.routes->useful_before_deposit(owned.group, light, label);
         });
}

void count_photons(const PhotonTrace& trace, EstimatorStatistics& statistics) {
  statistics.photon_paths += trace.paths;
  statistics.photon_paths_useful += trace.useful_paths;
  statistics.photon_paths_specular += trace.specular_paths;
  statistics.photons_stored += trace.photons.size();
  statistics.rays += trace.rays;
}

}  // namespace nephroid
