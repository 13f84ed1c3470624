// A walk between two vertices, the vertices and events that its visitors see, and where each of its
// decisions finds random numbers. It must not know how a walk goes on.
#pragma once

#include "core/sampler.h"
#include "scene/scene.h"
#include "transport/medium_flight.h"

namespace nephroid {

/// Where each decision of a path finds its random numbers. Every vertex has the same set, so that
/// its numbers do not depend on what earlier vertices used.
namespace dimensions {
inline constexpr int kFilm = 0;         // 2
inline constexpr int kWavelength = 2;   // 1
inline constexpr int kFirstVertex = 3;  // of camera walks
inline constexpr int kLens = 11;        // 2
inline constexpr int kTime = 13;        // 1
inline constexpr int kSecondVertex = 14;
// within a vertex
inline constexpr int kLight = 0;     // 3
inline constexpr int kBsdf = 3;      // 3: the lobe, which media have not, and the direction
inline constexpr int kRoulette = 6;  // 1
inline constexpr int kFlight = 7;    // 1, of the flight that leads to the vertex
inline constexpr int kPerVertex = 8;
}  // namespace dimensions

/// Russian roulette thresholds of camera walks that look for lights by themselves: what they begin
/// with, and what they have where longer walks pay (docs/estimators.md, section 24).
inline constexpr float kCameraRouletteThreshold = 1.0f / 3, kPatientRouletteThreshold = 1.0f / 8;

/// A walk between two vertices.
struct Walk {
  Ray ray;                         ///< of unit direction
  const Medium* medium = nullptr;  ///< around the ray's origin
  float specular_alpha = 0;        ///< of the pass: see roughness_band.h
  /// No choice depends on which wavelength is the hero: for walks that share their wavelengths with
  /// others that they are multiplied with. Then `density` stays all ones.
  bool per_wavelength = false;
  SampledSpectrum throughput{1.0f};
  /// Of the choices that media made; estimates divide by density.u_mean.
  SpectralDensity density;
  SampledWavelengths lambda;
  int vertices = 0;  ///< places at which something was decided
  int events = 0;    ///< scattering events so far
  float length = 0;  ///< path length from the start
  /// Product of eta^2 over refractions, of how much more often a guide chose directions than the
  /// BSDF would have, and of the chances that the visitor gave it: what roulette leaves out.
  float eta_scale = 1;
  // The last scattering event; before the first one the values of the start.
  bool delta = true;  ///< a delta lobe or the camera: no other technique could make this ray
  float pdf_w = 0;    ///< P_c p_c of the direction
  Vec3f previous_p,
      previous_ns;    ///< vertex that the ray left and its shading normal (null: medium)
  uint64_t rays = 0;  ///< closest-hit queries
  int first_dimension = dimensions::kFirstVertex;    ///< random numbers of the first vertex
  int second_dimension = dimensions::kSecondVertex;  ///< of the second; later ones follow
  int vertex_dimension() const {
    return vertices == 0 ? first_dimension
                         : second_dimension + (vertices - 1) * dimensions::kPerVertex;
  }
  int straight_events = 0;       ///< straight-through events since the start (bounds the walk)
  float roulette_threshold = 1;  ///< roulette is played on a walk that carries less

  /// What is left of what it started with, as roulette sees it.
  float carried() const { return throughput.max_component() * eta_scale / density.u_mean; }
};

/// A value at all wavelengths of a path that shares them with others and may have kept its hero
/// only, number `left`, whose value then stands for all.
inline SampledSpectrum whole_spectrum(const SampledSpectrum& value, int left) {
  if (left == kAllWavelengths) return value;
  SampledSpectrum hero;
  hero.set(left, value[left] * kSpectrumSamples);
  return hero;
}
/// What is left of a path of two sides that have the same hero.
inline int left_of_both(int a, int b) {
  return a != kAllWavelengths ? a : b;
}

/// Two sides whose heroes were chosen one without the other, and which kept different ones: they
/// make no path.
inline bool are_apart(int a, int b) {
  return a != b && a != kAllWavelengths && b != kAllWavelengths;
}
/// [M2] The value of a path of two such sides that are not apart. Where both kept their hero they
/// have met by a chance of one in kSpectrumSamples.
inline SampledSpectrum merged_spectrum(const SampledSpectrum& value, int a, int b) {
  if (a == kAllWavelengths || b == kAllWavelengths)
    return whole_spectrum(value, left_of_both(a, b));
  return whole_spectrum(value, a) * static_cast<float>(kSpectrumSamples);
}

/// The medium on the side of a surface to which `w` (world) points, for light that was in
/// `current`.
inline const Medium* medium_towards(const SurfaceInteraction& surface, const Vec3f& w,
                                    const Medium* current) {
  const MediumInterface& media = surface.record->media;
  if (!media.is_transition()) return current;
  return dot(w, surface.ng) > 0.0f ? media.outside : media.inside;
}

/// A surface vertex that a visitor sees.
struct WalkVertex {
  const SurfaceInteraction& surface;
  const Material& material;  ///< one of the two of a `mix`
  const Bsdf& bsdf;
  Vec3f wo;  ///< local
  /// Classes in which photons may be merged here in any of the guises that a `mix` chooses from at
  /// random. What is stored for others to meet depends on this and not on the guise that this walk
  /// happened to see.
  ClassMask possible;
  bool mixed = false;  ///< other walks may meet another material here
  /// False in a guise where photons cannot be merged, hair and other curves: its events are H.
  bool merges = true;
  /// Light that went under the surface elsewhere comes out here: a walk leaves, it does not arrive.
  bool subsurface_exit = false;
  /// The hero's number if the walk had no other wavelength when it arrived; the material may have
  /// dropped them since.
  int left = kAllWavelengths;
  /// Letters of events from which the walk's path can go on: its visitor's answer to `useful`.
  ClassMask letters = ClassMask::kNone;

  /// Classes of events that the walk may have here.
  ClassMask useful_classes() const { return classes_of(letters); }
  Vec3f to_local(const Vec3f& w) const { return surface.shading.to_local(w); }
  /// True if light that leaves along the local direction `wi` is transmitted.
  bool transmits(const Vec3f& wi) const { return subsurface_exit || wo.z * wi.z < 0.0f; }
  /// The letter of an event of class `c` here.
  EventClass letter(EventClass c) const { return merges ? c : EventClass::kHair; }
  /// Classes of events whose letters are among `some`.
  ClassMask classes_of(ClassMask some) const {
    if (merges) {
      // What goes below here may come out on a curve.
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
};

/// A scattering event of a walk.
struct WalkEvent {
  EventClass letter = EventClass::kDiffuse;
  bool transmitted = false;        ///< of surfaces
  int material = -1, medium = -1;  ///< index of the one that it happened at
};

}  // namespace nephroid
