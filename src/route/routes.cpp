#include "route/routes.h"

namespace nephroid {

namespace {

// Eye automaton of C [SD]* D S+ D? L. What matters is how the word ends:
enum Eye : EyeState {
  kNoDiffuse,        // C S*
  kDiffuseLast,      // ... D, and no D S+ right before this D
  kSpecularChain,    // ... D S+
  kChainThenDiffuse  // ... D S+ D
};

// Light automaton: what the light side says about any word that it will be part of.
enum Photon : PhotonState {
  kFromLight,    // nothing yet: the word is C ... D@ L
  kOneDiffuse,   // D: the word is C ... D@ D L
  kCausticSide,  // D? S+ ...: the D at which the photon is merged makes the word caustic
  kDiffuseSide   // D D ...: never caustic
};

}  // namespace

Routes Routes::doidge2012() {
  Routes r;
  constexpr size_t kD = static_cast<size_t>(EventClass::kDiffuse);
  constexpr size_t kS = static_cast<size_t>(EventClass::kSpecular);
  r.eye_next_[kNoDiffuse][kD] = kDiffuseLast;
  r.eye_next_[kNoDiffuse][kS] = kNoDiffuse;
  r.eye_next_[kDiffuseLast][kD] = kDiffuseLast;
  r.eye_next_[kDiffuseLast][kS] = kSpecularChain;
  r.eye_next_[kSpecularChain][kD] = kChainThenDiffuse;
  r.eye_next_[kSpecularChain][kS] = kSpecularChain;
  r.eye_next_[kChainThenDiffuse][kD] = kDiffuseLast;
  r.eye_next_[kChainThenDiffuse][kS] = kSpecularChain;
  r.eye_owner_ = {Route::kDiffuse, Route::kDiffuse, Route::kCaustic, Route::kCaustic};

  r.photon_next_[kFromLight][kD] = kOneDiffuse;
  r.photon_next_[kFromLight][kS] = kCausticSide;
  r.photon_next_[kOneDiffuse][kD] = kDiffuseSide;
  r.photon_next_[kOneDiffuse][kS] = kCausticSide;
  r.photon_next_[kCausticSide][kD] = kCausticSide;
  r.photon_next_[kCausticSide][kS] = kCausticSide;
  r.photon_next_[kDiffuseSide][kD] = kDiffuseSide;
  r.photon_next_[kDiffuseSide][kS] = kDiffuseSide;

  for (size_t eye = 0; eye < kEyeStates; ++eye) {
    r.meet_[eye][kFromLight] = r.eye_owner_[eye];
    r.meet_[eye][kOneDiffuse] = r.eye_owner_[r.eye_next_[eye][kD]];
    r.meet_[eye][kCausticSide] = Route::kCaustic;
    r.meet_[eye][kDiffuseSide] = Route::kDiffuse;
  }
  r.expressions_ = {"everything else", "C [SD]* D S+ D? L"};
  r.complete();
  return r;
}

Routes Routes::all(Route route) {
  Routes r = doidge2012();
  r.eye_owner_.fill(route);
  for (auto& row : r.meet_) row.fill(route);
  r.expressions_.fill("nothing");
  r.expressions_[static_cast<size_t>(route)] = "C [SD]* L";
  r.complete();
  return r;
}

Routes Routes::seen_emission() {
  Routes r = all(Route::kCaustic);
  r.eye_owner_[kNoDiffuse] = Route::kDiffuse;
  r.expressions_ = {"C S* L", "everything else"};
  r.complete();
  return r;
}

// An event is useful if some continuation deposits for the route: a fixed point over the automaton.
void Routes::complete() {
  for (size_t route = 0; route < 2; ++route) {
    std::array<bool, kPhotonStates> alive{};
    for (size_t round = 0; round <= kPhotonStates; ++round)
      for (size_t s = 0; s < kPhotonStates; ++s)
        alive[s] = deposits(static_cast<PhotonState>(s), static_cast<Route>(route)) ||
                   alive[photon_next_[s][0]] || alive[photon_next_[s][1]];
    for (size_t s = 0; s < kPhotonStates; ++s) {
      ClassMask mask = ClassMask::kNone;
      for (const EventClass e : {EventClass::kDiffuse, EventClass::kSpecular})
        if (alive[photon_next_[s][static_cast<size_t>(e)]]) mask = mask | mask_of(e);
      useful_[route][s] = mask;
    }
    std::array<bool, kEyeStates> ends{};
    for (size_t round = 0; round <= kEyeStates; ++round)
      for (size_t s = 0; s < kEyeStates; ++s)
        ends[s] = eye_owner_[s] == static_cast<Route>(route) || ends[eye_next_[s][0]] ||
                  ends[eye_next_[s][1]];
    for (size_t s = 0; s < kEyeStates; ++s) {
      ClassMask mask = ClassMask::kNone;
      for (const EventClass e : {EventClass::kDiffuse, EventClass::kSpecular})
        if (ends[eye_next_[s][static_cast<size_t>(e)]]) mask = mask | mask_of(e);
      useful_eye_[route][s] = mask;
    }
  }
}

std::string Routes::expression(Route route) const {
  return expressions_[static_cast<size_t>(route)];
}

}  // namespace nephroid
