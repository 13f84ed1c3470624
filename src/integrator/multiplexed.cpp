#include "integrator/multiplexed.h"

#include <algorithm>
#include <utility>

#include "integrator/path_pair.h"
#include "transport/roughness_band.h"

namespace nephroid {

namespace {

// Streams of numbers.
constexpr int kEye = 0, kLight = 1, kTechnique = 2;

/// The guess: each length is tried so often relative to the one before.
constexpr double kNextLength = 0.85;
/// Share of the guess once lengths have been looked at.
constexpr double kGuessed = 0.25;
/// Longer paths than these have a light of which no picture shows anything; they are not left out
/// but share what is left.
constexpr int kMostLengths = 1000;

/// What the paths of a pass share.
struct Pass {
  PairSettings pair;
  const FilmSettings& film;
  FilmArea area;
  LengthChoice lengths;
};

/// One path by one technique.
class TechniquePaths : public PathFunction {
 public:
  explicit TechniquePaths(const Pass& pass)
      : pass_(pass), pair_(pass.pair), light_(*pair_.owned.routes, pair_.owned.group) {}

  void evaluate(MarkovSample& numbers, FoundLight& found) override {
    PathSampler choice(numbers.stream(kTechnique));
    const LengthChoice::Chosen chosen = pass_.lengths.choose(choice.get_1d());
    // Light is seen directly in one way only; else s + t = length + 2 has length + 2.
    const int techniques = chosen.length == 0 ? 1 : chosen.length + 2;
    pair_.technique.s = std::min(static_cast<int>(choice.get_1d() * static_cast<float>(techniques)),
                                 techniques - 1);
    pair_.technique.t = chosen.length + 2 - pair_.technique.s;
    found.kind = static_cast<size_t>(chosen.length);
    const float factor = static_cast<float>(techniques) / chosen.probability;

    PathSampler eye(numbers.stream(kEye));
    eye.start_dimension(dimensions::kWavelength);
    const SampledWavelengths lambda =
        SampledWavelengths::sample_visible(wavelength_number(pair_.scene, eye.get_1d()));
    eye.start_dimension(dimensions::kTime);
    const float u_time = eye.get_1d();
    const SensorWeights weights = sensor_weights(
        lambda, *pass_.film.color_space, pass_.film.imaging_ratio, pass_.film.white_balance);
    PathSampler light(numbers.stream(kLight));
    if (pair_.technique.t == 1)
      connect_to_camera(lambda, u_time, light, weights, factor, found);
    else
      connect(lambda, u_time, eye, light, weights, factor, found);
  }

 private:
  void connect_to_camera(const SampledWavelengths& lambda, float u_time, PathSampler& light,
                         const SensorWeights& weights, float factor, FoundLight& found) {
    if (pair_.view == nullptr) return;
    seen_.clear();
    found.rays += trace_light_path(pair_, lambda, u_time, light, nullptr, &seen_, nullptr);
    for (const FilmConnection& c : seen_)
      for (int i = 0; i < c.seen.count; ++i)
        found.add(c.seen.film[static_cast<size_t>(i)], light_.place(c.part),
                  weights.apply(c.value) * factor);
  }

  void connect(const SampledWavelengths& lambda, float u_time, PathSampler& eye, PathSampler& light,
               const SensorWeights& weights, float factor, FoundLight& found) {
    eye.start_dimension(dimensions::kFilm);
    const Vec2f film = pass_.area.place(eye.get_2d());
    CameraPath camera = start_camera_path(pair_.scene, film, eye, lambda, u_time);
    if (!(camera.camera_weight > 0)) return;
    path_.clear();
    if (pair_.technique.s > 1) {
      found.rays += trace_light_path(pair_, lambda, u_time, light, &path_, nullptr, nullptr);
      if (path_.size() == 0) return;
    }
    light_.clear();
    found.rays += trace_eye_path(pair_, path_, camera, eye, light_);
    const std::span<const Rgb> colors =
        light_.colors(weights, camera.camera_weight * pass_.area.area() * factor, kInfinity, 1.0f);
    for (size_t part = 0; part < colors.size(); ++part) found.add(film, part, colors[part]);
  }

  const Pass& pass_;
  PairSettings pair_;
  PartSums light_;
  LightSubpath path_;
  std::vector<FilmConnection> seen_;
};

}  // namespace

LengthChoice::LengthChoice(int max_length)
    : probability_(static_cast<size_t>(std::min(max_length, kMostLengths - 1)) + 1) {
  double p = 1;
  for (double& probability : probability_) probability = std::exchange(p, p * kNextLength);
  add_up();
}

LengthChoice::LengthChoice(std::span<const double> brightness)
    : LengthChoice(static_cast<int>(brightness.size()) - 1) {
  double total = 0;
  for (const double b : brightness) total += b;
  if (!(total > 0)) return;
  for (size_t n = 0; n < probability_.size(); ++n)
    probability_[n] = kGuessed * probability_[n] + (1 - kGuessed) * brightness[n] / total;
  add_up();
}

void LengthChoice::add_up() {
  double total = 0;
  for (const double p : probability_) total += p;
  double sum = 0;
  cdf_.clear();
  for (double& p : probability_) {
    p /= total;
    cdf_.push_back(sum += p);
  }
}

LengthChoice::Chosen LengthChoice::choose(float u) const {
  const auto at = std::upper_bound(cdf_.begin(), cdf_.end() - 1, double{u});
  const auto length = at - cdf_.begin();
  return {static_cast<int>(length), static_cast<float>(probability_[static_cast<size_t>(length)])};
}

Multiplexed::Multiplexed(OwnedRoutes owned, const IntegratorOptions& options)
    : owned_(std::move(owned)), options_(options), passes_(options) {}

void Multiplexed::render_pass(const PassKey& key, const Scene& scene, Film& film) {
  const CameraView view(scene, film.bounds());
  Pass pass{{scene, owned_},
            film.settings(),
            FilmArea(film.bounds(), *scene.filter),
            LengthChoice(options_.max_depth)};
  pass.pair.view = scene.camera->connects() ? &view : nullptr;
  pass.pair.max_depth = options_.max_depth;
  // One light path and one place of the film for each path that is tried.
  pass.pair.light_paths = static_cast<double>(pass.area.area());
  // What the pilot sees does not depend on the pass that asks first.
  pass.pair.specular_alpha = specular_alpha_of_pass(scene.specular_band, {key.seed, 0});
  const PathFunctionMaker make = [&pass] { return std::make_unique<TechniquePaths>(pass); };
  pass.lengths =
      LengthChoice(passes_.pilot(key.seed, pass.area, pass.lengths.lengths(), make).kinds);
  pass.pair.specular_alpha = specular_alpha_of_pass(scene.specular_band, key);
  passes_.render(key, scene, static_cast<int>(owned_.group), make, film);
}

}  // namespace nephroid
