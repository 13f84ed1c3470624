// Connects a vertex of a light path to the camera (light tracing, t = 1): the film points that the
// line to the lens exposes, and the transmittance along it. It must not know the MIS weights of
// other techniques.
#pragma once

#include <array>
#include <optional>

#include "film/film.h"
#include "route/routes.h"
#include "scene/camera/camera.h"
#include "scene/pixel_filter.h"
#include "transport/random_walk.h"

namespace nephroid {

/// A connection and the film points that it exposes: several if the picture wraps around.
struct LensConnection {
  CameraConnection line;
  std::array<Vec2f, 4> film;
  int count = 0;
};

/// The part of the scene that a film sees through its camera. Refers to the scene's camera.
class CameraView {
 public:
  CameraView(const Scene& scene, const PixelBounds& crop);

  /// Connects `p` to the lens. Empty if no pixel of the crop has a filter that reaches the film
  /// point. `u_lens` and `u_time` as Camera::connect.
  std::optional<LensConnection> connect(const Vec3f& p, const Vec2f& u_lens, float u_time) const;

 private:
  bool reaches(const Vec2f& film) const {
    return film.x > low_.x && film.x < high_.x && film.y > low_.y && film.y < high_.y;
  }
  const Camera& camera_;
  Vec2f low_, high_;  ///< bounds of the film points that pixel filters reach
};

/// Transmittance from `origin`, in `medium` and already offset from its surface, to the lens. It is
/// right for each wavelength by itself. Random numbers come from the sampler's current dimension.
SampledSpectrum attenuation_to_camera(const Scene& scene, const Vec3f& origin, float time,
                                      const Medium* medium, const CameraConnection& line,
                                      const SampledWavelengths& lambda, const PathSampler& sampler);

/// Cosine at a light path's vertex towards the unit direction `w` (world), with the correction for
/// shading normals ([P2] in docs/estimators.md; Veach 1997, section 5.3). `wo` is the local
/// direction back along the path. A subsurface exit has no cosine of arrival. The result may be
/// infinite or NaN at grazing angles.
inline float light_side_cosine(const SurfaceInteraction& surface, const Vec3f& wo, const Vec3f& w,
                               bool subsurface_exit) {
  return abs_dot(w, surface.ng) *
         (subsurface_exit ? 1.0f : abs_cos_theta(wo) / abs_dot(surface.wo, surface.ng));
}

/// Light that a surface vertex of a light path scatters to the lens by one event class.
struct CameraEvent {
  const LensConnection& seen;
  Part part = kNoPart;
  EventClass letter = EventClass::kDiffuse;
  Vec3f wi;                 ///< local, towards the lens
  SampledSpectrum f;        ///< BSDF value
  SampledSpectrum through;  ///< transmittance to the lens
  float cosine = 0;         ///< light_side_cosine
};

/// Connects light paths of one time to the camera, and counts the rays.
class CameraConnector {
 public:
  CameraConnector(const Scene& scene, const CameraView& view, float u_time)
      : scene_(scene), view_(view), u_time_(u_time) {}

  /// Calls found(CameraEvent) for each of the finite `classes` by which a surface scatters light to
  /// the lens. `part_of(class, wi)` names the part of the path; kNoPart is skipped.
  template <class PartOf, class Found>
  void connect(const Walk& walk, const WalkVertex& v, ClassMask classes, PathSampler& sampler,
               PartOf&& part_of, Found&& found) {
    const auto seen = view_.connect(v.surface.p, sampler.get_2d(), u_time_);
    if (!seen) return;
    const Vec3f& w = seen->line.wi;
    const Vec3f wi = v.to_local(w);
    const float cosine = light_side_cosine(v.surface, v.wo, w, v.subsurface_exit);
    if (!std::isfinite(cosine)) return;
    SampledSpectrum through;
    bool traced = false;
    for (const EventClass c : kSurfaceClasses) {
      if (!contains(classes, c)) continue;
      const Part part = part_of(c, wi);
      if (part == kNoPart) continue;
      const BsdfEval e = v.bsdf.eval(v.wo, wi, TransportMode::kImportance, c, ClassMask::kAll);
      if (e.f.is_black()) continue;
      if (!traced)
        through = arrives(*seen, v.surface.spawn_origin(w), walk,
                          medium_towards(v.surface, w, walk.medium), sampler);
      traced = true;
      if (through.is_black()) return;
      found(CameraEvent{*seen, part, c, wi, e.f, through, cosine});
    }
  }

  /// Calls found(seen, through, phase function) at a vertex in a medium.
  template <class Found>
  void connect(const Walk& walk, const MediumVertex& v, PathSampler& sampler, Found&& found) {
    const auto seen = view_.connect(v.p, sampler.get_2d(), u_time_);
    if (!seen) return;
    const SampledSpectrum through = arrives(*seen, v.p, walk, walk.medium, sampler);
    found(*seen, through, v.phase.eval(v.wo, seen->line.wi));
  }

  /// Transmittance from `origin`, in `medium`, to the lens.
  SampledSpectrum arrives(const LensConnection& seen, const Vec3f& origin, const Walk& walk,
                          const Medium* medium, const PathSampler& sampler) {
    ++rays_;
    return attenuation_to_camera(scene_, origin, walk.ray.time, medium, seen.line, walk.lambda,
                                 sampler);
  }
  const CameraView& view() const { return view_; }
  float u_time() const { return u_time_; }
  uint64_t rays() const { return rays_; }

 private:
  const Scene& scene_;
  const CameraView& view_;
  const float u_time_;
  uint64_t rays_ = 0;
};

}  // namespace nephroid
