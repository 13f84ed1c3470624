#include "integrator/metropolis/multiplexed.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "integrator/bidirectional/path_pair.h"
#include "integrator/estimator/exposed_pixels.h"
#include "integrator/estimator/reach.h"
#include "integrator/metropolis/metropolis_options.h"
#include "transport/roughness_band.h"

namespace nephroid {

namespace {

// Streams of random numbers.
constexpr int kEye = 0, kLight = 1, kTechnique = 2;

/// P_0 of [Z8]: probability of each length over that of the one before.
constexpr double kNextLength = 0.85;
/// a of [Z8], the guess's shares after the pilot. They bound the weight of a path: at most four
/// times that of the guess by its length, twice by its technique.
constexpr double kGuessedLength = 0.25, kGuessedTechnique = 0.5;
/// Number of path lengths; the light of longer paths is invisible.
constexpr int kMaxLengths = 1000;

/// Settings shared by the paths of a pass.
struct MultiplexedPass {
  PairSettings pair;
  const FilmSettings& film;
  FilmArea area;
  KindChoice kinds;
};

/// [Z7] Makes one path by one technique.
class TechniquePaths : public PathFunction {
 public:
  explicit TechniquePaths(const MultiplexedPass& pass)
      : pass_(pass), pair_(pass.pair), light_(*pair_.owned.routes, pair_.owned.group) {}

  void evaluate(MarkovSample& numbers, FoundLight& found) override {
    PathSampler choice(numbers.stream(kTechnique));
    const KindChoice::Chosen chosen = pass_.kinds.choose(choice.get_2d());
    pair_.technique = {chosen.s, chosen.length + 2 - chosen.s};
    found.kind = chosen.kind;
    const float factor = 1 / chosen.probability;

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
    found.rays += trace_light_path(pair_, lambda, u_time, light, nullptr, &seen_, nullptr).rays;
    for (const CameraSplat& c : seen_)
      for (int i = 0; i < c.seen.count; ++i)
        found.add(c.seen.film[i], light_.place(c.part), weights.apply(c.value) * factor);
  }

  void connect(const SampledWavelengths& lambda, float u_time, PathSampler& eye, PathSampler& light,
               const SensorWeights& weights, float factor, FoundLight& found) {
    eye.start_dimension(dimensions::kFilm);
    const Vec2f film = pass_.area.place(eye.get_2d());
    CameraPath camera = start_camera_path(pair_.scene, film, eye, lambda, u_time);
    if (!(camera.camera_weight > 0)) return;
    path_.clear();
    if (pair_.technique.s > 1) {
      found.rays += trace_light_path(pair_, lambda, u_time, light, &path_, nullptr, nullptr).rays;
      if (path_.size() == 0) return;
    }
    light_.clear();
    found.rays += trace_eye_path(pair_, path_, camera, eye, light_).rays;
    const std::span<const Rgb> colors =
        light_.colors(weights, camera.camera_weight * pass_.area.area() * factor, kInfinity, 1.0f);
    for (size_t part = 0; part < colors.size(); ++part) found.add(film, part, colors[part]);
  }

  const MultiplexedPass& pass_;
  PairSettings pair_;
  PartSums light_;
  LightSubpath path_;
  std::vector<CameraSplat> seen_;
};

}  // namespace

KindChoice::Table::Table(std::vector<double> weights) : probability(std::move(weights)) {
  double total = 0;
  for (const double p : probability) total += p;
  double sum = 0;
  for (double& p : probability) {
    p /= total;
    cdf.push_back(sum += p);
  }
}

size_t KindChoice::Table::choose(float u) const {
  return static_cast<size_t>(std::upper_bound(cdf.begin(), cdf.end() - 1, double{u}) - cdf.begin());
}

KindChoice::KindChoice(int max_length) : KindChoice() {
  const int lengths = std::min(max_length, kMaxLengths - 1) + 1;
  std::vector<double> weights;
  double weight = 1;
  size_t kinds = 0;
  for (int length = 0; length < lengths; ++length) {
    weights.push_back(std::exchange(weight, weight * kNextLength));
    // Light seen directly has one technique; all other lengths have length + 2 (s + t).
    const size_t techniques = length == 0 ? 1 : static_cast<size_t>(length) + 2;
    techniques_.emplace_back(std::vector<double>(techniques, 1.0));
    first_kind_.push_back(kinds);
    kinds += techniques;
  }
  first_kind_.push_back(kinds);
  length_ = Table(std::move(weights));
}

KindChoice::KindChoice(const KindChoice& guess, std::span<const double> mean_squares)
    : KindChoice(guess) {
  double total = 0;
  std::vector<double> wanted(mean_squares.size()), lengths(guess.lengths(), 0.0);
  for (size_t n = 0; n < guess.lengths(); ++n)
    for (size_t s = 0; s < guess.techniques_[n].probability.size(); ++s) {
      const size_t kind = guess.first_kind_[n] + s;
      wanted[kind] = std::sqrt(mean_squares[kind] * guess.length_.probability[n] *
                               guess.techniques_[n].probability[s]);
      lengths[n] += wanted[kind];
      total += wanted[kind];
    }
  if (!(total > 0)) return;
  const auto mixed = [](double share, double guessed, double learned) {
    return share * guessed + (1 - share) * learned;
  };
  for (size_t n = 0; n < lengths.size(); ++n) {
    if (lengths[n] > 0) {
      std::vector<double> weights = guess.techniques_[n].probability;
      for (size_t s = 0; s < weights.size(); ++s)
        weights[s] =
            mixed(kGuessedTechnique, weights[s], wanted[guess.first_kind_[n] + s] / lengths[n]);
      techniques_[n] = Table(std::move(weights));
    }
    lengths[n] = mixed(kGuessedLength, guess.length_.probability[n], lengths[n] / total);
  }
  length_ = Table(std::move(lengths));
}

KindChoice::Chosen KindChoice::choose(const Vec2f& u) const {
  const size_t length = length_.choose(u.x);
  const size_t s = techniques_[length].choose(u.y);
  return {static_cast<int>(length), static_cast<int>(s), first_kind_[length] + s,
          static_cast<float>(length_.probability[length] * techniques_[length].probability[s])};
}

constinit const EstimatorDescriptor Multiplexed::kDescriptor = {
    .traits = {.name = "mlt",
               .help = "bidirectional paths, one technique at a time, explored by Markov chains",
               .starts_at_lights = true,
               .why_never_sampled = out_of_reach_of_connections},
    .settings = kMetropolisSettings,
    .bytes_per_pixel =
        [](const PixelMemoryInput& need) {
          return PixelBytes{.of_pass = SplatBuffer::bytes_per_pixel(need.parts)};
        },
    .exposed_pixels = pixels_of_splats,
    .make = make_estimator<Multiplexed>,
};

Multiplexed::Multiplexed(OwnedRoutes owned, const IntegratorOptions& options)
    : owned_(std::move(owned)), options_(options), passes_(options.own<MetropolisOptions>()) {}

namespace {

/// Settings of a pass, with the kinds of the guess.
MultiplexedPass start_pass(const Scene& scene, const OwnedRoutes& owned, const FilmFormat& film,
                           const IntegratorOptions& options, const CameraView& view,
                           const PassKey& key) {
  MultiplexedPass pass{{scene, owned},
                       film.settings(),
                       FilmArea(film.bounds(), *scene.filter),
                       KindChoice(options.max_depth)};
  pass.pair.view = scene.camera->connects() ? &view : nullptr;
  pass.pair.max_depth = options.max_depth;
  // N of [W9]: each path has one light path and one place of the film.
  pass.pair.light_paths = static_cast<double>(pass.area.area());
  pass.pair.specular_alpha = specular_alpha_of_pass(scene.specular_band, key);
  return pass;
}

PathFunctionMaker maker_of(const MultiplexedPass& pass) {
  return [&pass] { return std::make_unique<TechniquePaths>(pass); };
}

}  // namespace

std::shared_ptr<const Learned> Multiplexed::learn(const Scene& scene, const FilmFormat& film,
                                                  uint64_t seed, PassControl& control) const {
  const CameraView view(scene, film.bounds());
  // The pilot has the roughness threshold of pass 0, whichever pass needs it.
  const MultiplexedPass pass = start_pass(scene, owned_, film, options_, view, {seed, 0});
  return LearnedPilot::learn(seed, pass.area, pass.kinds.kinds(), maker_of(pass), control);
}

std::shared_ptr<const Learned> Multiplexed::read_learned(ByteReader& from,
                                                         const FilmFormat&) const {
  return LearnedPilot::read(from, KindChoice(options_.max_depth).kinds());
}

void Multiplexed::render_pass(const PassKey& key, const Learned* learned, const Scene& scene,
                              Film& film, PassControl& control) {
  const ChainPilot& pilot = static_cast<const LearnedPilot*>(learned)->pilot();
  const CameraView view(scene, film.bounds());
  MultiplexedPass pass = start_pass(scene, owned_, film.format(), options_, view, key);
  pass.kinds = KindChoice(pass.kinds, pilot.kinds);
  passes_.render(key, scene, static_cast<int>(owned_.group), pilot, maker_of(pass), film, control);
}

}  // namespace nephroid
