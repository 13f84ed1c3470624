#include "integrator/metropolis/primary_space.h"

#include <algorithm>
#include <utility>

#include "integrator/estimator/exposed_pixels.h"
#include "integrator/estimator/reach.h"
#include "integrator/metropolis/metropolis_options.h"
#include "integrator/path/path_options.h"
#include "integrator/path/path_visitor.h"
#include "transport/camera_path.h"
#include "transport/roughness_band.h"

namespace nephroid {

namespace {

/// Settings shared by the paths of a pass.
struct PrimarySpacePass {
  const Scene& scene;
  const OwnedRoutes& owned;
  const IntegratorOptions& options;
  const FilmSettings& film;
  FilmArea area;
  float specular_alpha = 0;
};

class CameraPaths : public PathFunction {
 public:
  explicit CameraPaths(const PrimarySpacePass& pass)
      : pass_(pass),
        is_blind_(pass.options.own<PathOptions>().blind_walks),
        light_(*pass.owned.routes, pass.owned.group) {}

  void evaluate(MarkovSample& numbers, FoundLight& found) override {
    PathSampler sampler(numbers.stream(0));
    sampler.start_dimension(dimensions::kWavelength);
    const SampledWavelengths lambda =
        SampledWavelengths::sample_visible(wavelength_number(pass_.scene, sampler.get_1d()));
    sampler.start_dimension(dimensions::kTime);
    const float u_time = sampler.get_1d();
    sampler.start_dimension(dimensions::kFilm);
    const Vec2f film = pass_.area.place(sampler.get_2d());
    CameraPath path = start_camera_path(pass_.scene, film, sampler, lambda, u_time);
    if (!(path.camera_weight > 0)) return;
    path.walk.specular_alpha = pass_.specular_alpha;
    const SensorWeights weights = sensor_weights(
        lambda, *pass_.film.color_space, pass_.film.imaging_ratio, pass_.film.white_balance);
    light_.clear();
    PathVisitor visitor(pass_.scene, pass_.owned, is_blind_, light_, nullptr);
    random_walk(pass_.scene, TransportMode::kRadiance, pass_.options.max_depth, path.walk, sampler,
                visitor);
    found.rays += path.walk.rays + visitor.more_rays();
    const std::span<const Rgb> colors =
        light_.colors(weights, path.camera_weight * pass_.area.area(), kInfinity, 1.0f);
    for (size_t part = 0; part < colors.size(); ++part) found.add(film, part, colors[part]);
  }

 private:
  const PrimarySpacePass& pass_;
  const bool is_blind_;
  PartSums light_;
};

}  // namespace

constinit const EstimatorDescriptor PrimarySpace::kDescriptor = {
    .traits = {.name = "pssmlt",
               .help = "path tracing from the eye, explored by Markov chains in the space of its "
                       "random numbers",
               .why_never_sampled = out_of_reach_of_eye_walks},
    .settings = kMetropolisSettings,
    .bytes_per_pixel =
        [](const PixelMemoryInput& need) {
          return PixelBytes{.of_pass = SplatBuffer::bytes_per_pixel(need.parts)};
        },
    .exposed_pixels = pixels_of_splats,
    .make = make_estimator<PrimarySpace>,
};

PrimarySpace::PrimarySpace(OwnedRoutes owned, const IntegratorOptions& options)
    : owned_(std::move(owned)), options_(options), passes_(options.own<MetropolisOptions>()) {}

namespace {

PathFunctionMaker maker_of(const PrimarySpacePass& pass) {
  return [&pass] { return std::make_unique<CameraPaths>(pass); };
}

}  // namespace

std::shared_ptr<const Learned> PrimarySpace::learn(const Scene& scene, const FilmFormat& film,
                                                   uint64_t seed, PassControl& control) const {
  // The pilot has the roughness threshold of pass 0, whichever pass needs it.
  const PrimarySpacePass pass{scene,
                              owned_,
                              options_,
                              film.settings(),
                              FilmArea(film.bounds(), *scene.filter),
                              specular_alpha_of_pass(scene.specular_band, {seed, 0})};
  return LearnedPilot::learn(seed, pass.area, 1, maker_of(pass), control);
}

std::shared_ptr<const Learned> PrimarySpace::read_learned(ByteReader& from,
                                                          const FilmFormat&) const {
  return LearnedPilot::read(from, 1);
}

void PrimarySpace::render_pass(const PassKey& key, const Learned* learned, const Scene& scene,
                               Film& film, PassControl& control) {
  const PrimarySpacePass pass{scene,
                              owned_,
                              options_,
                              film.settings(),
                              FilmArea(film.bounds(), *scene.filter),
                              specular_alpha_of_pass(scene.specular_band, key)};
  passes_.render(key, scene, static_cast<int>(owned_.group),
                 static_cast<const LearnedPilot*>(learned)->pilot(), maker_of(pass), film, control);
}

}  // namespace nephroid
