#include "transport/light_survey.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/parallel.h"
#include "transport/camera_path.h"
#include "transport/direct_light.h"

namespace nephroid {

namespace {

constexpr uint64_t kSurveySeed = 0x737572766579;  // "survey"
/// Camera paths, at most one for each pixel.
constexpr int64_t kMaxPaths = 1 << 13;
constexpr int64_t kPathsOfChunk = 64;
/// A path ends behind so many points where lights are looked for, or so many events.
constexpr int kMaxPoints = 3, kMaxEvents = 16;
/// Lights that are sampled at each point.
constexpr int kSamplesOfPoint = 6;

/// Looks for lights at each rough surface of a walk.
class SurveyVisitor {
 public:
  SurveyVisitor(const Scene& scene, std::vector<SurveyedPoint>& points)
      : scene_(scene), points_(points) {}

  static ClassMask useful(const WalkVertex&) { return ClassMask::kEvery; }
  static bool scatters_in(const Medium&) { return true; }
  static bool looks_under_surfaces() { return true; }
  static void escape(const Walk&) {}
  static void emitter(const Walk&, const SurfaceInteraction&, const Light&) {}
  static void medium_emission(const Medium&, const SampledSpectrum&) {}
  static void medium_vertex(const Walk&, const MediumVertex&, PathSampler&) {}

  void vertex(const Walk& walk, const WalkVertex& v, PathSampler& sampler) {
    if (found_ >= kMaxPoints) return;
    if ((v.bsdf.finite_classes() & ClassMask::kRough) == ClassMask::kNone) return;
    PathSampler own = sampler.stream(sampler.dimension());
    SurveyedPoint point{v.surface.p, {}};
    for (int i = 0; i < kSamplesOfPoint; ++i) {
      const float u_light = own.get_1d();
      const Vec2f u = own.get_2d();
      scene_.light_sampler->survey(
          v.surface.p, v.surface.shading.z, u_light,
          [&](int light) { return light_from(light, u, walk, v, own); }, point.samples);
    }
    points_.push_back(std::move(point));
    ++found_;
  }

  bool scatter(const Walk&, const WalkEvent&) const { return found_ < kMaxPoints; }

 private:
  /// The light that arrives from a light and leaves the surface again, as if the surface were
  /// white, over the density of its direction: a mean over wavelengths.
  float light_from(int light, const Vec2f& u, const Walk& walk, const WalkVertex& v,
                   const PathSampler& sampler) const {
    const std::optional<DirectSample> d =
        sample_direct(scene_, Receiver::of(v.surface, walk.medium), {light, 1.0f}, u, walk.lambda);
    if (!d) return 0;
    const Vec3f wi = v.to_local(d->wi_world);
    if (!reflects(v, wi)) return 0;
    return (d->radiance * attenuation_to_light(scene_, *d, walk.lambda, sampler)).average() *
           abs_cos_theta(wi);
  }

  static bool reflects(const WalkVertex& v, const Vec3f& wi) {
    return std::ranges::any_of(kSurfaceClasses, [&](EventClass c) {
      return contains(v.bsdf.finite_classes(), c) &&
             !v.bsdf.eval(v.wo, wi, TransportMode::kRadiance, c, ClassMask::kAll).f.is_black();
    });
  }

  const Scene& scene_;
  std::vector<SurveyedPoint>& points_;
  int found_ = 0;
};

/// Path number `index` of the survey, spread evenly over the whole picture.
void survey_path(const Scene& scene, uint32_t index, std::vector<SurveyedPoint>& points) {
  PathSampler sampler(PaddedPoint{index}, kSurveySeed);
  sampler.start_dimension(dimensions::kTime);
  const float u_time = sampler.get_1d();
  sampler.start_dimension(dimensions::kWavelength);
  const SampledWavelengths lambda =
      SampledWavelengths::sample_visible(wavelength_number(scene, sampler.get_1d()));
  sampler.start_dimension(dimensions::kFilm);
  const Vec2f u = sampler.get_2d();
  const Vec2f film(u.x * static_cast<float>(scene.film.width),
                   u.y * static_cast<float>(scene.film.height));
  CameraPath path = start_camera_path(scene, film, sampler, lambda, u_time);
  if (path.camera_weight == 0) return;
  path.walk.specular_alpha = scene.specular_band.high;
  SurveyVisitor visitor(scene, points);
  RandomWalk(scene, TransportMode::kRadiance, kMaxEvents, path.walk, sampler, visitor).run();
}

}  // namespace

LightVisibility survey_lights(const Scene& scene, PassControl& control) {
  const size_t slots = scene.light_sampler->slot_count();
  if (slots == 0) return {};
  const int64_t pixels = int64_t{scene.film.width} * scene.film.height;
  std::vector<SurveyedPoint> points;
  ordered_reduce<std::vector<SurveyedPoint>>(
      control, std::min(kMaxPaths, pixels), kPathsOfChunk,
      [&](std::vector<SurveyedPoint>& found, int64_t begin, int64_t end) {
        for (int64_t i = begin; i < end; ++i) survey_path(scene, static_cast<uint32_t>(i), found);
      },
      [&](std::vector<SurveyedPoint>&& found) {
        std::ranges::move(found, std::back_inserter(points));
      });
  return {points, slots};
}

}  // namespace nephroid
