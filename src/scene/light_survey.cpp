#include "scene/light_survey.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/parallel.h"
#include "core/sampler.h"
#include "scene/camera/camera.h"
#include "scene/light/shadow_ray.h"

namespace nephroid {

namespace {

constexpr uint64_t kSurveySeed = 0x737572766579;  // "survey"
/// Camera paths, at most one for each pixel.
constexpr int64_t kMaxPaths = 1 << 13;
constexpr int64_t kPathsOfChunk = 64;
/// A path ends behind so many points where light is looked for, or so many surfaces.
constexpr int kMaxPoints = 3, kMaxSurfaces = 16;
/// Lights that are sampled at each point.
constexpr int kSamplesOfPoint = 6;

/// One path of the survey.
class SurveyPath {
 public:
  SurveyPath(const Scene& scene, uint32_t index, std::vector<SurveyedPoint>& points)
      : scene_(scene),
        sampler_(PaddedPoint{index}, kSurveySeed),
        lambda_(SampledWavelengths::sample_visible(sampler_.get_1d())),
        points_(points) {}

  void run() {
    const FilmDescription& film = scene_.film;
    const Vec2f u = sampler_.get_2d(), u_lens = sampler_.get_2d();
    const std::optional<CameraRay> start = scene_.camera->generate_ray(
        {u.x * static_cast<float>(film.width), u.y * static_cast<float>(film.height)}, u_lens,
        sampler_.get_1d());
    if (!start) return;
    ray_ = start->ray;
    int points = 0;
    for (int surfaces = 0; surfaces < kMaxSurfaces && points < kMaxPoints; ++surfaces) {
      SurfaceInteraction hit;
      if (!scene_.intersect(ray_, hit) || !meet(hit, points)) return;
    }
  }

 private:
  /// Looks for lights at a surface and leaves it. False: the path ends.
  bool meet(SurfaceInteraction& hit, int& points) {
    const Material* material = scene_.materials[hit.material]->resolve(hit);
    if (material->is_interface()) {
      ray_.o = hit.spawn_origin(ray_.d);
      return true;
    }
    if (material->has_bump()) material->bump(hit);
    arena_.clear();
    const Bsdf* bsdf = material->make_bsdf(hit, lambda_, scene_.specular_band.high, arena_);
    if (!bsdf) return false;
    const Vec3f wo = hit.shading.to_local(hit.wo);
    if ((bsdf->finite_classes() & ClassMask::kRough) != ClassMask::kNone) {
      look(hit, *bsdf, wo);
      ++points;
    }
    const float uc = sampler_.get_1d();
    const std::optional<BsdfSample> s =
        bsdf->sample(wo, uc, sampler_.get_2d(), TransportMode::kRadiance, ClassMask::kAll);
    if (!s || !(s->pdf_w > 0.0f) || s->subsurface) return false;
    const Vec3f wi = s->straight_through ? ray_.d : hit.shading.to_world(s->wi);
    if (!s->straight_through) {
      const float survival = (s->f * (abs_cos_theta(s->wi) / s->pdf_w)).average();
      if (!(sampler_.get_1d() < survival)) return false;
    }
    ray_.o = hit.spawn_origin(wi);
    ray_.d = wi;
    return true;
  }

  void look(const SurfaceInteraction& hit, const Bsdf& bsdf, const Vec3f& wo) {
    SurveyedPoint point{hit.p, {}};
    for (int i = 0; i < kSamplesOfPoint; ++i) {
      const float u_light = sampler_.get_1d();
      const Vec2f u = sampler_.get_2d();
      scene_.light_sampler->survey(
          hit.p, hit.shading.z, u_light,
          [&](int light) { return light_from(light, u, hit, bsdf, wo); }, point.samples);
    }
    points_.push_back(std::move(point));
  }

  /// The light that arrives from a light and leaves the surface again, as if the surface were
  /// white, over the density of its direction.
  float light_from(int light, const Vec2f& u, const SurfaceInteraction& hit, const Bsdf& bsdf,
                   const Vec3f& wo) const {
    const std::optional<LightSample> s = scene_.lights[light]->sample_towards(hit.p, u, lambda_);
    if (!s || !(s->pdf_w > 0.0f) || s->radiance.is_black()) return 0;
    const Vec3f wi = hit.shading.to_local(s->wi);
    bool reflects = false;
    for (const EventClass c : {EventClass::kDiffuse, EventClass::kGlossy})
      if (!reflects && contains(bsdf.finite_classes(), c))
        reflects = !bsdf.eval(wo, wi, TransportMode::kRadiance, c, ClassMask::kAll).f.is_black();
    if (!reflects) return 0;
    const SampledSpectrum light_here =
        s->radiance *
        scene_.transmittance(shadow_ray(hit.spawn_origin(s->wi), *s, ray_.time), lambda_);
    const float found = light_here.average() * abs_cos_theta(wi) / s->pdf_w;
    return std::isfinite(found) ? found : 0;
  }

  const Scene& scene_;
  PathSampler sampler_;
  SampledWavelengths lambda_;
  std::vector<SurveyedPoint>& points_;
  Ray ray_;
  BsdfArena arena_;
};

}  // namespace

LightVisibility survey_lights(const Scene& scene) {
  const size_t slots = scene.light_sampler->slot_count();
  if (slots == 0) return {};
  const int64_t pixels = int64_t{scene.film.width} * scene.film.height;
  std::vector<SurveyedPoint> points;
  ordered_reduce<std::vector<SurveyedPoint>>(
      unwatched, std::min(kMaxPaths, pixels), kPathsOfChunk,
      [&](std::vector<SurveyedPoint>& found, int64_t begin, int64_t end) {
        for (int64_t i = begin; i < end; ++i)
          SurveyPath(scene, static_cast<uint32_t>(i), found).run();
      },
      [&](std::vector<SurveyedPoint>&& found) {
        std::ranges::move(found, std::back_inserter(points));
      });
  return {points, slots};
}

}  // namespace nephroid
