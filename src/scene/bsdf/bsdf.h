// The interface of all scattering models, in the local shading frame (z up, pointing outwards). A
// BSDF consists of lobes, each of class D, G or S. All functions work per class, so that an
// estimator can weigh exactly the lobes of its route (docs/architecture.md, section 4). It must not
// know routes, textures or lights.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <new>
#include <optional>
#include <utility>

#include "core/spectrum.h"

namespace nephroid {

/// kRadiance: the walk starts at the camera, and wo points towards it. kImportance: from a light.
/// Refraction scales radiance, not flux, by 1/eta^2 (pbrt-v4 section 9.5.2).
enum class TransportMode : uint8_t { kRadiance, kImportance };

/// The class of a scattering event, its letter in light path expressions. D: diffuse. G: glossy, a
/// lobe with a preferred direction but rough enough to connect or merge at. S: specular, too narrow
/// for either. V: in a medium. H: on hair and other curves, whatever the lobe. BSDFs have D, G and
/// S only.
enum class EventClass : uint8_t {
  kDiffuse = 0,
  kGlossy = 1,
  kSpecular = 2,
  kVolume = 3,
  kHair = 4
};
inline constexpr size_t kEventClasses = 5;
inline constexpr EventClass kSurfaceClasses[] = {EventClass::kDiffuse, EventClass::kGlossy,
                                                 EventClass::kSpecular};

/// Whether two local directions are on one side of the surface.
inline bool same_side(const Vec3f& a, const Vec3f& b) {
  return (a.z > 0.0f) == (b.z > 0.0f);
}

/// A set of event classes. Photons merge at kRough. kAll holds all classes of surfaces.
enum class ClassMask : uint8_t {
  kNone = 0,
  kDiffuse = 1,
  kGlossy = 2,
  kRough = 3,
  kSpecular = 4,
  kAll = 7,
  kVolume = 8,
  kHair = 16,
  kEvery = 31
};
constexpr ClassMask mask_of(EventClass c) {
  return static_cast<ClassMask>(1 << static_cast<int>(c));
}
constexpr bool contains(ClassMask m, EventClass c) {
  return (static_cast<int>(m) & static_cast<int>(mask_of(c))) != 0;
}
constexpr ClassMask operator|(ClassMask a, ClassMask b) {
  return static_cast<ClassMask>(static_cast<int>(a) | static_cast<int>(b));
}
constexpr ClassMask operator&(ClassMask a, ClassMask b) {
  return static_cast<ClassMask>(static_cast<int>(a) & static_cast<int>(b));
}

/// Microfacet lobes of at most a threshold's alpha (the larger of both, after remapping) are of
/// class S. Within the band the threshold varies between iterations (transport/roughness_band.h),
/// so that no caustic jumps when an artist moves a roughness slider.
struct SpecularBand {
  float low = 0.035f, high = 0.07f;  ///< low <= high; equal: one threshold for all iterations
};

/// One sampled direction. With c the sampled class, the throughput is multiplied by
/// f * |cos theta_i| / pdf_w.
struct BsdfSample {
  SampledSpectrum
      f;     ///< sum over the finite lobes of class c (or the one delta lobe), without cosine
  Vec3f wi;  ///< unit, local
  float pdf_w = 0;  ///< P_c * p_c(wi), 1/sr. For a delta lobe: the discrete probability; f then
                    ///< holds the 1/|cos| of the delta function.
  float eta = 1;    ///< relative index of refraction eta_t/eta_i along a transmitted ray, else 1
  EventClass event = EventClass::kDiffuse;
  bool transmitted = false;  ///< wi and wo lie on different sides of the surface
  bool delta = false;
  bool straight_through = false;  ///< no event: the ray goes on as if nothing were there
  /// The light enters a subsurface material (wi points inside). The walk asks the material's Bssrdf
  /// where and how it leaves. Entering and leaving are one D event.
  bool subsurface = false;
};

/// Value and density of one class in a given direction, without delta lobes.
struct BsdfEval {
  SampledSpectrum f;
  float pdf_w = 0;  ///< P_c * p_c(wi), 1/sr: the density of sample() with the same `among`
};

class Bsdf {
 public:
  virtual ~Bsdf() = default;

  /// Classes with any lobe, and classes with a finite lobe (not a delta function).
  virtual ClassMask classes() const = 0;
  virtual ClassMask finite_classes() const = 0;

  /// f of all finite lobes of class `c` from wi to wo, without cosine, and the density with which
  /// sample(wo, ..., among) returns wi in class `c`.
  virtual BsdfEval eval(const Vec3f& wo, const Vec3f& wi, TransportMode mode, EventClass c,
                        ClassMask among) const = 0;

  /// Chooses a class in `among` and then a direction in it, from `uc` and `u` in [0,1). Empty if
  /// nothing is scattered (also if `among` has no lobe).
  virtual std::optional<BsdfSample> sample(const Vec3f& wo, float uc, const Vec2f& u,
                                           TransportMode mode, ClassMask among) const = 0;

  /// Both samples between which sample() chooses, if there are exactly two and both are delta lobes
  /// of class S. Empty otherwise.
  virtual std::optional<std::array<BsdfSample, 2>> delta_pair(const Vec3f& /*wo*/,
                                                              TransportMode /*mode*/) const {
    return std::nullopt;
  }

  /// Relative index of refraction along the ray from wo to wi, as in BsdfSample::eta.
  virtual float eta_between(const Vec3f& /*wo*/, const Vec3f& /*wi*/) const { return 1.0f; }

  /// Approximate hemispherical reflectance plus transmittance, for denoising AOVs only.
  virtual SampledSpectrum albedo(const Vec3f& wo) const = 0;
};

/// Storage for the BSDF of one vertex, on the stack of the walk: no allocation per vertex. Objects
/// made here are not destroyed, so they hold values and plain pointers only.
class BsdfArena {
 public:
  template <class T, class... Args>
  T* make(Args&&... args) {
    static_assert(sizeof(T) + alignof(T) <= kSize && alignof(T) <= 64);
    const size_t start = (used_ + alignof(T) - 1) & ~(alignof(T) - 1);
    if (start + sizeof(T) > kSize) return nullptr;
    used_ = start + sizeof(T);
    return new (buffer_ + start) T(std::forward<Args>(args)...);
  }
  void clear() { used_ = 0; }

 private:
  static constexpr size_t kSize = 4096;
  alignas(64) std::byte buffer_[kSize];
  size_t used_ = 0;
};

}  // namespace nephroid
