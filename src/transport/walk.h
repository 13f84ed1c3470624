// The state of a walk, the vertices and events that its visitors see, and the sampler dimensions of
// its decisions. It must not know how a walk goes on.
#pragma once

#include "core/sampler.h"
#include "scene/scene.h"
#include "transport/medium_flight.h"

namespace nephroid {

/// Sampler dimensions of a path's decisions. Every vertex has the same number of them, so that its
/// numbers do not depend on what earlier vertices used.
namespace dimensions {
inline constexpr int kFilm = 0;         // 2
inline constexpr int kWavelength = 2;   // 1
inline constexpr int kFirstVertex = 3;  // of camera walks
inline constexpr int kLens = 11;        // 2
inline constexpr int kTime = 13;        // 1
inline constexpr int kSecondVertex = 14;
// within a vertex
inline constexpr int kLight = 0;     // 3
inline constexpr int kBsdf = 3;      // 3: lobe (not used in media) and direction
inline constexpr int kRoulette = 6;  // 1
inline constexpr int kFlight = 7;    // 1, for the flight to the vertex
inline constexpr int kPerVertex = 8;
}  // namespace dimensions

/// Russian roulette thresholds of camera walks that find lights by themselves: the usual one, and
/// the one for scenes where longer walks pay (docs/estimators.md, section 24).
inline constexpr float kCameraRouletteThreshold = 1.0f / 3, kPatientRouletteThreshold = 1.0f / 8;

/// A walk between two vertices.
struct Walk {
  Ray ray;                         ///< unit direction
  const Medium* medium = nullptr;  ///< medium around the ray's origin
  float specular_alpha = 0;        ///< specular threshold of the pass (roughness_band.h)
  /// True for walks that are multiplied with others of the same wavelengths: no choice depends on
  /// the hero, and `density` stays all ones.
  bool per_wavelength = false;
  SampledSpectrum throughput{1.0f};
  /// Densities of the choices in media; estimates divide by density.u_mean.
  SpectralDensity density;
  SampledWavelengths lambda;
  int vertices = 0;  ///< vertices so far, each with its own sampler dimensions
  int events = 0;    ///< scattering events so far
  float length = 0;  ///< path length from the start
  /// Factors of the throughput that roulette ignores: eta^2 of refractions, gains of guided
  /// directions, and the visitor's survival probabilities.
  float eta_scale = 1;
  // The last scattering event; before the first one, the values of the start.
  bool delta = true;  ///< a delta lobe or the camera: no other technique can make this ray
  float pdf_w = 0;    ///< density of the direction, P_c p_c
  Vec3f previous_p,
      previous_ns;    ///< vertex that the ray left and its shading normal (null: medium)
  uint64_t rays = 0;  ///< closest-hit queries
  int first_dimension = dimensions::kFirstVertex;    ///< sampler dimension of the first vertex
  int second_dimension = dimensions::kSecondVertex;  ///< that of the second; later ones follow
  int vertex_dimension() const {
    return vertices == 0 ? first_dimension
                         : second_dimension + (vertices - 1) * dimensions::kPerVertex;
  }
  int straight_events = 0;       ///< straight-through events since the start (bounds the walk)
  float roulette_threshold = 1;  ///< Russian roulette starts below this value of carried()

  /// The throughput as roulette sees it.
  float carried() const { return throughput.max_component() * eta_scale / density.u_mean; }
};

/// [M2] The value of a path at all shared wavelengths. If the path kept only its hero, of index
/// `left`, the hero's value stands for all n: it counts n times.
inline SampledSpectrum whole_spectrum(const SampledSpectrum& value, int left) {
  if (left == kAllWavelengths) return value;
  SampledSpectrum hero;
  hero.set(left, value[left] * kSpectrumSamples);
  return hero;
}
/// The wavelengths left of a path whose two sides have the same hero.
inline int left_of_both(int a, int b) {
  return a != kAllWavelengths ? a : b;
}

/// True if two sides with independent heroes kept different ones: they make no path.
inline bool are_apart(int a, int b) {
  return a != b && a != kAllWavelengths && b != kAllWavelengths;
}
/// [M2] The value of a path of two such sides that are not apart. Two sides that both kept only
/// their hero agree with probability 1 / kSpectrumSamples.
inline SampledSpectrum merged_spectrum(const SampledSpectrum& value, int a, int b) {
  if (a == kAllWavelengths || b == kAllWavelengths)
    return whole_spectrum(value, left_of_both(a, b));
  return whole_spectrum(value, a) * static_cast<float>(kSpectrumSamples);
}

/// A surface vertex that a visitor sees.
struct WalkVertex {
  const SurfaceInteraction& surface;
  const Material& material;  ///< resolved: one of a mix's two materials
  const Bsdf& bsdf;
  Vec3f wo;  ///< local
  /// Classes in which photons may be merged here, over all materials of a mix. Photons are stored
  /// by this mask, not by the material that this walk happened to choose.
  ClassMask possible;
  bool mixed = false;  ///< true in a mix: other walks may choose another material
  /// False for hair and other curves, where photons cannot be merged: their events are H.
  bool merges = true;
  /// True for a subsurface exit: the walk leaves here but did not arrive here.
  bool subsurface_exit = false;
  /// Index of the hero if the walk arrived with no other wavelength; the material may have dropped
  /// more since.
  int left = kAllWavelengths;
  /// Letters after which the walk's path can go on: the visitor's useful().
  ClassMask letters = ClassMask::kNone;

  /// Event classes that the walk may have here.
  ClassMask useful_classes() const { return classes_of(letters); }
  Vec3f to_local(const Vec3f& w) const { return surface.shading.to_local(w); }
  /// True if light that leaves along the local direction `wi` is transmitted.
  bool transmits(const Vec3f& wi) const { return subsurface_exit || wo.z * wi.z < 0.0f; }
  /// The letter of an event of class `c` here.
  EventClass letter(EventClass c) const { return merges ? c : EventClass::kHair; }
  /// Event classes whose letters are among `some`.
  ClassMask classes_of(ClassMask some) const {
    if (merges) {
      // Subsurface light that enters here may exit on a curve.
      const bool may_become_hair =
          !subsurface_exit && contains(some, EventClass::kHair) && material.has_bssrdf();
      return (some & ClassMask::kAll) | (may_become_hair ? ClassMask::kDiffuse : ClassMask::kNone);
    }
    return contains(some, EventClass::kHair) ? ClassMask::kAll : ClassMask::kNone;
  }
};

/// A vertex in a medium.
struct MediumVertex {
  const Medium& medium;
  Vec3f p;
  Vec3f wo;  ///< unit, world
  HenyeyGreenstein phase;
  float time = 0;
  bool lit_along = false;  ///< direct light was sampled along the flight that ended here
};

/// A scattering event of a walk.
struct WalkEvent {
  EventClass letter = EventClass::kDiffuse;
  bool transmitted = false;        ///< at a surface, true if light crossed it
  int material = -1, medium = -1;  ///< index of the event's material or medium, the other is -1
};

}  // namespace nephroid
