// The interface of every scattering model, in the local shading frame (z up, pointing outwards).
// A BSDF is made of lobes, and each lobe has a class, D, G or S, which is its letter in light path
// (but on curves) expressions. All functions work per class, so that the estimator of a route can
// weigh exactly the lobes that belong to it (docs/architecture.md, section 4). Who calls it:
// transport and photon. It must not know routes, textures or lights.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <new>
#include <optional>
#include <utility>

#include "core/spectrum.h"

namespace nephroid {

/// Radiance: the walk runs from the camera, wo points towards it. Importance: from a light.
/// Refraction scales radiance, not flux, by 1/eta^2 (pbrt-v4 section 9.5.2).
enum class TransportMode : uint8_t { kRadiance, kImportance };

/// The class of a scattering event, its letter in light path expressions: D diffuse; G glossy, a
/// lobe with a preferred direction but rough enough to connect or merge at; S is not; V happens in
/// a medium, H on hair and other curves, whatever their lobes are, so no BSDF has these two.
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

/// A set of event classes; kRough are those at which photons merge, kAll those that surfaces have.
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

/// Microfacet lobes with alpha (the larger of both directions, after remapping) at or below a
/// threshold are of class S. In the band between these two the threshold differs from pass to pass
/// (transport/roughness_band.h), so that no caustic jumps when a slider of roughness is moved.
struct SpecularBand {
  float low = 0.035f, high = 0.07f;  ///< low <= high; equal: one threshold for all passes
};

/// One sampled direction. With c the sampled class, the throughput is multiplied by
/// f * |cos theta_i| / pdf_w.
struct BsdfSample {
  SampledSpectrum
      f;     ///< sum over the finite lobes of class c (or the one delta lobe), without cosine
  Vec3f wi;  ///< unit, local
  float pdf_w = 0;  ///< P_c * p_c(wi), 1/sr; for a delta lobe the discrete probability (f then
                    ///< holds the 1/|cos| of the delta function)
  float eta = 1;  ///< relative index of refraction along the transmitted ray (eta_t/eta_i), else 1
  EventClass event = EventClass::kDiffuse;
  bool transmitted = false;  ///< wi lies on the other side of the surface than wo
  bool delta = false;
  bool straight_through = false;  ///< adds no letter: the ray goes on as if nothing were there
  /// The light goes into a subsurface material (wi is on the inside): the walk asks the material's
  /// Bssrdf where and how it comes out again. Entering and leaving are one D event.
  bool subsurface = false;
};

/// Value and density of one class at a given direction, delta lobes left out.
struct BsdfEval {
  SampledSpectrum f;
  float pdf_w = 0;  ///< P_c * p_c(wi), 1/sr: what sample() with the same `among` would have
};

class Bsdf {
 public:
  virtual ~Bsdf() = default;

  /// Classes that have any lobe, and classes that have a lobe which is not a delta function.
  virtual ClassMask classes() const = 0;
  virtual ClassMask finite_classes() const = 0;

  /// f of all finite lobes of class `c` from wi to wo, without cosine, and the density with which
  /// sample(wo, ..., among) would find wi in class `c`.
  virtual BsdfEval eval(const Vec3f& wo, const Vec3f& wi, TransportMode mode, EventClass c,
                        ClassMask among) const = 0;

  /// Chooses a class in `among` and then a direction in it, from `uc` and `u` in [0,1). Empty if
  /// nothing is scattered (also when `among` has no lobe).
  virtual std::optional<BsdfSample> sample(const Vec3f& wo, float uc, const Vec2f& u,
                                           TransportMode mode, ClassMask among) const = 0;

  /// Both directions between which sample() chooses, with what it would say of them, where there
  /// are two and no more, both of delta lobes of class S; else empty.
  virtual std::optional<std::array<BsdfSample, 2>> delta_pair(const Vec3f& /*wo*/,
                                                              TransportMode /*mode*/) const {
    return std::nullopt;
  }

  /// Relative index of refraction along the ray from wo to wi, `eta` of a sample in that direction.
  virtual float eta_between(const Vec3f& /*wo*/, const Vec3f& /*wi*/) const { return 1.0f; }

  /// Approximate hemispherical reflectance plus transmittance, for denoising AOVs only.
  virtual SampledSpectrum albedo(const Vec3f& wo) const = 0;
};

/// Room for the BSDF of one vertex, on the stack of the walk: no allocation per vertex.
/// Objects made here are not destroyed, so they hold values and plain pointers only.
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
  static constexpr size_t kSize = 2048;
  alignas(64) std::byte buffer_[kSize];
  size_t used_ = 0;
};

}  // namespace nephroid
