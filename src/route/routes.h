// Who renders which light: the one place that decides what a caustic is (docs/routes.md).
// A path is a word C e1 e2 ... en L of event classes, eye first. Camera walks read it from the
// left, photons from the right; both follow the tables made here, so every word has exactly one
// owner. Words with a V (a scattering in a medium, or on a surface where photons cannot be merged)
// belong to kDiffuse. Who calls it: integrators. It must not know scenes or estimators. Paper:
// Doidge et al. 2012.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "scene/bsdf/bsdf.h"

namespace nephroid {

/// The routes of the mixed method, numbered as the film's buffers.
enum class Route : uint8_t { kDiffuse = 0, kCaustic = 1 };

using EyeState = uint8_t;     ///< of the automaton that has read C e1 ... ek
using PhotonState = uint8_t;  ///< of the automaton that has read the events from L towards the eye

/// Deterministic automata for both directions, dense tables of small integers. A value type.
class Routes {
 public:
  /// The caustic sub-space C [SD]* D S+ D? L belongs to kCaustic, everything else to kDiffuse.
  static Routes doidge2012();
  /// Everything (but words with a V) belongs to one route.
  static Routes all(Route route);
  /// Light that is seen directly or through specular surfaces only, C S* L, belongs to kDiffuse,
  /// all else to kCaustic: the parts of full photon mapping, which merges at the first D.
  static Routes seen_emission();

  /// The same partition for a scene that has no events but `letters`: fewer events are useful.
  Routes restricted_to(ClassMask letters) const;

  /// Light that a medium emits belongs to this route whatever the word: no photon starts there.
  static constexpr Route kMediumEmission = Route::kDiffuse;

  static constexpr EyeState kEyeStart = 0;
  static constexpr PhotonState kPhotonStart = 0;

  /// State after one more event, seen from the eye.
  EyeState next(EyeState state, EventClass event) const {
    return eye_next_[state][static_cast<size_t>(event)];
  }
  /// Owner of the word that ends here with L.
  Route owner(EyeState state) const { return eye_owner_[state]; }

  /// State after one more event, seen from the light.
  PhotonState photon_next(PhotonState state, EventClass event) const {
    return photon_next_[state][static_cast<size_t>(event)];
  }
  /// Owner of the word whose eye side, its merge vertex included, is in `eye` and whose light side,
  /// the merge vertex excluded, is in `photon`.
  Route meet(EyeState eye, PhotonState photon) const { return meet_[eye][photon]; }
  /// True if a photon in this state, deposited at a vertex where eyes merge after C S* D, belongs
  /// to `route`.
  bool deposits(PhotonState photon, Route route) const {
    return meet_[next(kEyeStart, EventClass::kDiffuse)][photon] == route;
  }
  /// Classes in which a photon may scatter and still be able to reach a vertex where `route`
  /// merges.
  ClassMask useful_events(PhotonState photon, Route route) const {
    return useful_[static_cast<size_t>(route)][photon];
  }

  /// Classes in which a camera walk may scatter and still be able to end as a word of `route`.
  ClassMask useful_eye_events(EyeState state, Route route) const {
    return useful_eye_[static_cast<size_t>(route)][state];
  }

  /// The expression of a route, for reports.
  std::string expression(Route route) const;

  static constexpr size_t kEyeStates = 5;
  static constexpr size_t kPhotonStates = 5;

 private:
  void give_volumes_to_diffuse();
  void complete(ClassMask letters);

  std::array<std::array<EyeState, kEventClasses>, kEyeStates> eye_next_{};
  std::array<Route, kEyeStates> eye_owner_{};
  std::array<std::array<PhotonState, kEventClasses>, kPhotonStates> photon_next_{};
  std::array<std::array<Route, kPhotonStates>, kEyeStates> meet_{};
  std::array<std::array<ClassMask, kPhotonStates>, 2> useful_{};
  std::array<std::array<ClassMask, kEyeStates>, 2> useful_eye_{};
  std::array<std::string, 2> expressions_;
};

}  // namespace nephroid
