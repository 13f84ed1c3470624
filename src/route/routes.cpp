#include "route/routes.h"

#include <algorithm>

namespace nephroid {

namespace {

// Eye automaton of C [SD]* D S+ D? L. What matters is how the word ends:
enum Eye : EyeState {
  kNoDiffuse,         // C S*
  kDiffuseLast,       // ... D, and no D S+ right before this D
  kSpecularChain,     // ... D S+
  kChainThenDiffuse,  // ... D S+ D
  kEyeVolume          // ... V ...: whatever follows
};

// Light automaton: what the light side says about any word that it will be part of.
enum Photon : PhotonState {
  kFromLight,    // nothing yet: the word is C ... D@ L
  kOneDiffuse,   // D: the word is C ... D@ D L
  kCausticSide,  // D? S+ ...: the D at which the photon is merged makes the word caustic
  kDiffuseSide,  // D D ...: never caustic
  kLightVolume   // ... V ...: never caustic
};

constexpr EventClass kLetters[] = {EventClass::kDiffuse, EventClass::kSpecular,
                                   EventClass::kVolume};
constexpr ClassMask kAllLetters = ClassMask::kAll | ClassMask::kVolume;

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
  constexpr size_t kV = static_cast<size_t>(EventClass::kVolume);
  for (size_t eye = 0; eye < kEyeStates; ++eye) r.eye_next_[eye][kV] = kEyeVolume;
  r.eye_next_[kEyeVolume].fill(kEyeVolume);
  r.eye_owner_ = {Route::kDiffuse, Route::kDiffuse, Route::kCaustic, Route::kCaustic,
                  Route::kDiffuse};

  r.photon_next_[kFromLight][kD] = kOneDiffuse;
  r.photon_next_[kFromLight][kS] = kCausticSide;
  r.photon_next_[kOneDiffuse][kD] = kDiffuseSide;
  r.photon_next_[kOneDiffuse][kS] = kCausticSide;
  r.photon_next_[kCausticSide][kD] = kCausticSide;
  r.photon_next_[kCausticSide][kS] = kCausticSide;
  r.photon_next_[kDiffuseSide][kD] = kDiffuseSide;
  r.photon_next_[kDiffuseSide][kS] = kDiffuseSide;

  for (size_t photon = 0; photon < kPhotonStates; ++photon)
    r.photon_next_[photon][kV] = kLightVolume;
  r.photon_next_[kLightVolume].fill(kLightVolume);

  for (size_t eye = 0; eye < kEyeStates; ++eye) {
    r.meet_[eye][kFromLight] = r.eye_owner_[eye];
    r.meet_[eye][kOneDiffuse] = r.eye_owner_[r.eye_next_[eye][kD]];
    r.meet_[eye][kCausticSide] = Route::kCaustic;
    r.meet_[eye][kDiffuseSide] = Route::kDiffuse;
  }
  r.give_volumes_to_diffuse();
  r.expressions_ = {"everything else", "C [SD]* D S+ D? L"};
  r.complete(kAllLetters);
  return r;
}

Routes Routes::all(Route route) {
  Routes r = doidge2012();
  r.eye_owner_.fill(route);
  for (auto& row : r.meet_) row.fill(route);
  r.give_volumes_to_diffuse();
  r.expressions_ = {"C [SDV]* V [SDV]* L", "nothing"};
  r.expressions_[static_cast<size_t>(route)] =
      route == Route::kDiffuse ? "C [SDV]* L" : "C [SD]* L";
  r.complete(kAllLetters);
  return r;
}

Routes Routes::seen_emission() {
  Routes r = all(Route::kCaustic);
  r.eye_owner_[kNoDiffuse] = Route::kDiffuse;
  r.expressions_ = {"C S* L | C [SDV]* V [SDV]* L", "everything else"};
  r.complete(kAllLetters);
  return r;
}

Routes Routes::restricted_to(ClassMask letters) const {
  Routes r = *this;
  r.complete(letters);
  return r;
}

void Routes::give_volumes_to_diffuse() {
  eye_owner_[kEyeVolume] = Route::kDiffuse;
  meet_[kEyeVolume].fill(Route::kDiffuse);
  for (auto& row : meet_) row[kLightVolume] = Route::kDiffuse;
}

// An event is useful if some continuation counts for the route: a fixed point over the automaton.
void Routes::complete(ClassMask letters) {
  const auto useful = [&](const auto& next, const auto& counts, auto& masks) {
    const size_t states = next.size();
    std::array<bool, std::max(kEyeStates, kPhotonStates)> alive{};
    for (size_t round = 0; round <= states; ++round)
      for (size_t s = 0; s < states; ++s) {
        alive[s] = alive[s] || counts(s);
        for (const EventClass e : kLetters)
          alive[s] = alive[s] || (contains(letters, e) && alive[next[s][static_cast<size_t>(e)]]);
      }
    for (size_t s = 0; s < states; ++s) {
      masks[s] = ClassMask::kNone;
      for (const EventClass e : kLetters)
        if (contains(letters, e) && alive[next[s][static_cast<size_t>(e)]])
          masks[s] = masks[s] | mask_of(e);
    }
  };
  for (size_t i = 0; i < 2; ++i) {
    const Route route = static_cast<Route>(i);
    useful(
        photon_next_, [&](size_t s) { return deposits(static_cast<PhotonState>(s), route); },
        useful_[i]);
    useful(
        eye_next_, [&](size_t s) { return eye_owner_[s] == route; }, useful_eye_[i]);
  }
}

std::string Routes::expression(Route route) const {
  return expressions_[static_cast<size_t>(route)];
}

}  // namespace nephroid
