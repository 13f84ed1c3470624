// The interface of all lights, world space. One family per file; light_table.cpp maps the scene
// format's names to factories, and light_sampler.h chooses among lights. It must not know routes or
// integrators.
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "core/spectra.h"
#include "scene/interaction.h"
#include "scene/shape/shape.h"
#include "scene/texture/texture.h"

namespace nephroid {

/// A sampled direction from a receiving point to a light.
struct LightSample {
  SampledSpectrum radiance;  ///< arriving radiance; for a delta light divided by its delta function
  Vec3f wi{0, 0, 0};         ///< unit, from the receiver to the light
  float pdf_w = 0;           ///< density at the receiver; 1 for point and directional lights
  Vec3f p{0, 0, 0};          ///< point on the light; for infinite lights a point outside the scene
  Vec3f p_error{0, 0, 0};    ///< error bound of p; zero for infinite and point lights
  Vec3f ng{0, 0, 0};         ///< normal of the light's surface, null if it has none
  bool delta = false;        ///< no walk can hit this light
  bool infinite = false;
};

/// A ray that leaves a light: the start of a photon path.
struct EmissionSample {
  Ray ray;  ///< origin is already offset from the surface
  SampledSpectrum radiance;
  float pdf_a = 0;  ///< density of the origin, 1/area (on the disk outside the scene for infinite
                    ///< lights; 1 for a light at a point)
  float pdf_w = 0;  ///< density of the direction, 1/sr (1 for a delta direction)
  float cos_theta = 1;       ///< cosine at the emitting surface, 1 where there is none
  bool from_inside = false;  ///< leaves the side opposite to the surface's normal
  /// The light came from far behind the origin. The caller multiplies by the transmittance from
  /// there ([P4] in docs/estimators.md) and finds out in which medium it arrives.
  bool from_behind = false;
  /// `coverage` is the alpha of the start point (p, p_error, ng, uv) if that lies on a surface
  /// visible to cameras, where radiance() gives the light in other directions. 0: there is no such
  /// point.
  float coverage = 0;
  Vec3f p{0, 0, 0}, p_error{0, 0, 0}, ng{0, 0, 0};
  Vec2f uv{0, 0};
  /// Flux carried by a path: radiance * cos_theta / (pdf_a * pdf_w).
};

/// Densities of sample_emission, for weights of multiple importance sampling.
struct EmissionDensity {
  float pdf_a = 0;  ///< density of the origin, 1/area; for infinite lights perpendicular to the ray
  float pdf_w = 0;  ///< density of the direction, 1/sr (1 for a delta direction)
};

/// A light as the light tree sees it (Conty Estevez & Kulla 2018; pbrt-v4 section 12.6.3).
struct LightBounds {
  Bounds3f bounds;
  Vec3f axis{0, 0, 1};
  /// pi times the largest radiant intensity: for a Lambertian emitter, the power of one side.
  float power = 0;
  float cos_theta_o = -1, cos_theta_e = 0;
  bool two_sided = false;
  /// Flat lights: distance of their plane below the centre of the bounds, along the axis. Points
  /// farther below get no light. Infinite for lights that are not flat.
  float depth = std::numeric_limits<float>::infinity();

  Vec3f center() const { return (bounds.min + bounds.max) * 0.5f; }
  /// Whether all normals agree with the axis, so that one plane bounds the lit side.
  bool is_flat() const { return cos_theta_o > 0.99999f; }
};

struct SceneSphere {
  Vec3f center{0, 0, 0};
  float radius = 1;
};

class Light {
 public:
  virtual ~Light() = default;

  virtual bool is_delta() const { return false; }
  virtual bool is_infinite() const { return false; }
  virtual bool is_area() const { return false; }
  /// True if paths from this infinite light start uniformly on a disk as wide as the scene,
  /// whatever their direction.
  virtual bool emits_through_disk() const { return false; }

  /// Samples a direction to the light from `from`. Empty where nothing arrives. An infinite light
  /// can leave out directions that BSDF sampling finds well; pdf_towards is zero there.
  virtual std::optional<LightSample> sample_towards(const Vec3f& from, const Vec2f& u,
                                                    const SampledWavelengths& lambda) const = 0;
  /// The point that a ray from `from` in unit direction `wi` meets first on the light's surface,
  /// with pdf_w of sample_towards. Empty if it meets none that shines there, and always if
  /// has_whole_surface() is false.
  virtual std::optional<LightSample> seen_along(const Vec3f& /*from*/, const Vec3f& /*wi*/,
                                                float /*time*/, const SampledWavelengths&) const {
    return std::nullopt;
  }
  /// True if the light has a surface, and it stops every ray that meets it.
  virtual bool has_whole_surface() const { return false; }
  /// Density pdf_w of sample_towards at `from` for unit direction `wi`. `p` and `ng` are the point
  /// hit on the light (unused by infinite lights). Zero for delta lights.
  virtual float pdf_towards(const Vec3f& from, const Vec3f& wi, const Vec3f& p,
                            const Vec3f& ng) const = 0;
  /// Radiance leaving a point of an area light with outside normal `ng` in unit direction `w`, away
  /// from the light. Black for other lights.
  virtual SampledSpectrum radiance(const Vec3f& /*p*/, const Vec3f& /*ng*/, const Vec2f& /*uv*/,
                                   const Vec3f& /*w*/, const SampledWavelengths&) const {
    return SampledSpectrum();
  }
  /// Radiance of an infinite light seen from `from` in unit direction `w`, away from the viewer.
  /// Black for other lights.
  virtual SampledSpectrum radiance_at_infinity(const Vec3f& /*from*/, const Vec3f& /*w*/,
                                               const SampledWavelengths&) const {
    return SampledSpectrum();
  }
  /// Samples a ray that leaves the light; `u_position` and `u_direction` in [0,1)^2.
  virtual std::optional<EmissionSample> sample_emission(const Vec2f& u_position,
                                                        const Vec2f& u_direction,
                                                        const SampledWavelengths& lambda) const = 0;
  /// Densities of sample_emission for a start on the light with outside normal `ng` (unused by
  /// lights without a surface) in unit direction `w`, away from the light. If the shape's own
  /// density varies, its mean is used.
  virtual EmissionDensity emission_pdf(const Vec3f& ng, const Vec3f& w) const = 0;
  /// Approximate emitted power, averaged over wavelengths, in watts: for choosing among lights.
  virtual float power() const = 0;
  /// Empty for infinite lights.
  virtual std::optional<LightBounds> bounds() const = 0;
  /// Called once before rendering, when the extent of the scene is known.
  virtual void set_scene_sphere(const SceneSphere&) {}
  /// Lets sample_towards find all light from now on. For scenes with scattering media: where
  /// photons are merged in them, no BSDF sampling finds what it leaves out ([V8]).
  virtual void leave_out_nothing() {}
};
using LightPtr = std::unique_ptr<Light>;

/// Lights of "LightSource" directives, in file order. Unknown types and bad parameters throw
/// SceneError. Unsupported features are located errors or warnings. A directive gives one light, or
/// none with a warning.
std::vector<LightPtr> make_lights(const SceneDescription& description, Diagnostics& diagnostics);

/// One light per primitive of a shape with an "AreaLightSource" directive. `alpha` may be null.
/// `lets_pass`: the shape's material may let rays go straight through.
std::vector<LightPtr> make_area_lights(const DirectiveDescription& description, ShapePtr shape,
                                       SceneFiles& files, const TextureLibrary& textures,
                                       FloatTexturePtr alpha, bool lets_pass,
                                       Diagnostics& diagnostics);

}  // namespace nephroid
