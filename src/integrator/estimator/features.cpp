#include "integrator/estimator/features.h"

#include <vector>

#include "integrator/estimator/slice_loop.h"
#include "transport/path_points.h"

namespace nephroid {

namespace {

constexpr uint64_t kFeatureStream = 0x66656174;  // "feat"

// The film's response to a flat spectrum of 1, averaged over the wavelengths of a path.
Rgb response_to_white(const FilmSettings& settings) {
  const Rgb white = settings.color_space->from_xyz({1, 1, 1});
  const Rgb seen = settings.white_balance ? *settings.white_balance * white : white;
  return seen * (kCieYIntegral * settings.imaging_ratio);
}

Rgb of_white(const Rgb& rgb, const Rgb& white) {
  return {rgb.r / white.r, rgb.g / white.g, rgb.b / white.b};
}

// Ends at the first surface that is no straight-through event.
class FirstVertexVisitor {
 public:
  explicit FirstVertexVisitor(Features& features) : features_(features) {}

  ClassMask useful(const WalkVertex&) const { return ClassMask::kNone; }
  bool scatters_in(const Medium&) const { return false; }
  bool looks_under_surfaces() const { return false; }
  void escape(const Walk&) {}
  void emitter(const Walk&, const SurfaceInteraction&, const Light&) {}
  void medium_emission(const Medium&, const SampledSpectrum&) {}
  void medium_vertex(const Walk&, const MediumVertex&, PathSampler&) {}
  void vertex(const Walk& walk, const WalkVertex& v, PathSampler&) { features_.record(walk, v); }
  bool scatter(const Walk&, const WalkEvent&) { return false; }

 private:
  Features& features_;
};

}  // namespace

void Features::record(const Walk& walk, const WalkVertex& v) {
  if (walk.vertices > 0) return;
  albedo_ = v.bsdf.albedo(v.wo);
  normal_ = v.surface.shading.z;
  depth_ = walk.length;
  surface_ = {v.surface.p, v.surface.ng, v.surface.shading.z, v.surface.wo, v.surface.uv};
}

void Features::add_to(Film& film, int x, int y, const Scene& scene, const CameraPath& path,
                      const SensorWeights& weights) const {
  const FilmSettings& settings = film.settings();
  film.add_features(x, y, of_white(weights.apply(albedo_), response_to_white(settings)), normal_,
                    depth_);
  if (settings.gbuffer && depth_ > 0) film.add_surface(x, y, surface_sample(scene, path, surface_));
}

const EstimatorDescriptor& FeatureEstimator::descriptor() const {
  static const EstimatorDescriptor kDescriptor{.traits = {.name = "features"}};
  return kDescriptor;
}

void FeatureEstimator::render_pass(const PassKey& key, const Learned*, const Scene& scene,
                                   Film& film, PassControl& control) {
  const FilmSettings& settings = film.settings();
  const SobolPoint point = eye_point(key.pass);
  const auto trace_slice = [&](uint64_t& rays, const PixelSlices::Run& run) {
    const int y = run.y;
    for (int i = 0; i < run.count; ++i) {
      const int x = run.x + i * run.step;
      PathSampler sampler(point, hash_combine(key.seed, kFeatureStream, x, y));
      sampler.start_dimension(dimensions::kWavelength);
      const SampledWavelengths lambda =
          SampledWavelengths::sample_visible(wavelength_number(scene, sampler.get_1d()));
      sampler.start_dimension(dimensions::kTime);
      CameraPath path = start_camera_path(scene, x, y, sampler, lambda, sampler.get_1d());
      Features features;
      FirstVertexVisitor visitor(features);
      if (path.camera_weight > 0)
        random_walk(scene, TransportMode::kRadiance, 1, path.walk, sampler, visitor);
      const SensorWeights weights = sensor_weights(path.walk.lambda, *settings.color_space,
                                                   settings.imaging_ratio, settings.white_balance);
      features.add_to(film, x, y, scene, path, weights);
      rays += path.walk.rays;
    }
  };
  SlicesOfPass{.film = film, .group = film.layout().group_count()}.render<uint64_t>(
      control, trace_slice, [&](uint64_t&& rays) { statistics_.rays += rays; });
  statistics_.camera_paths += film.bounds().area();
}

}  // namespace nephroid
