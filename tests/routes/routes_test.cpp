// The partition of path space: the paper's known answers, and every short word against a plain regular
// expression, read from the eye, from the light, and met anywhere in between.
#include "route/routes.h"

#include <gtest/gtest.h>

#include <regex>
#include <string>
#include <vector>

namespace nephroid {
namespace {

EventClass event_of(char letter) {
  return letter == 'D'   ? EventClass::kDiffuse
         : letter == 'S' ? EventClass::kSpecular
                         : EventClass::kVolume;
}

// All words over the letters of up to `length` letters, the empty one included.
std::vector<std::string> words(int length, const std::string& letters = "SD") {
  std::vector<std::string> all{""};
  for (size_t i = 0; i < all.size(); ++i)
    if (static_cast<int>(all[i].size()) < length)
      for (const char letter : letters) {
        const std::string longer = all[i] + letter;
        all.push_back(longer);
      }
  return all;
}

Route oracle(const std::string& events) {
  static const std::regex caustic("[SD]*DS+D?");
  return std::regex_match(events, caustic) ? Route::kCaustic : Route::kDiffuse;
}

EyeState read(const Routes& routes, const std::string& events) {
  EyeState state = Routes::kEyeStart;
  for (const char e : events) state = routes.next(state, event_of(e));
  return state;
}

// The paper's form: a path is a string of bits (1 = specular), the last three of which index tables of
// whether a vertex may be lit by hitting a light (implicit) or by asking for one (explicit).
struct BitEncoded {
  static bool diffuse_may_end(uint32_t bits, int events) {
    // Trailing D or none, then a run of ones which a zero (D) precedes: a caustic.
    const auto specular = [&](int k) { return ((bits >> k) & 1u) != 0; };
    int k = 0;
    if (k < events && !specular(k)) ++k;
    const int before = k;
    while (k < events && specular(k)) ++k;
    return !(k > before && k < events);
  }
};

TEST(Routes, PaperExample) {
  // The events D D S D D D at vertices 1..6 (Doidge et al. 2012).
  const Routes routes = Routes::doidge2012();
  const std::string events = "DDSDDD";
  const bool implicit[] = {true, true, true, false, false, true};
  const bool explicitly[] = {true, true, false, false, true, true};
  for (size_t k = 1; k <= events.size(); ++k) {
    EXPECT_EQ(routes.owner(read(routes, events.substr(0, k - 1))) == Route::kDiffuse,
              implicit[k - 1]) << "implicit at vertex " << k;
    EXPECT_EQ(routes.owner(read(routes, events.substr(0, k))) == Route::kDiffuse,
              explicitly[k - 1]) << "explicit at vertex " << k;
  }
}

TEST(Routes, EyeTablesAgreeWithTheRegularExpression) {
  const Routes routes = Routes::doidge2012();
  for (const std::string& w : words(8, "SDV"))
    EXPECT_EQ(routes.owner(read(routes, w)), oracle(w)) << w;
  for (const std::string& w : words(12)) EXPECT_EQ(routes.owner(read(routes, w)), oracle(w)) << w;
}

TEST(Routes, BitEncodedFormAgrees) {
  const Routes routes = Routes::doidge2012();
  for (const std::string& w : words(12)) {
    uint32_t bits = 0;
    for (const char e : w) bits = (bits << 1) | (e == 'S');
    EXPECT_EQ(routes.owner(read(routes, w)) == Route::kDiffuse,
              BitEncoded::diffuse_may_end(bits, static_cast<int>(w.size()))) << w;
  }
}

TEST(Routes, EyeAndLightAgreeWhereverTheyMeetAtADiffuseVertex) {
  const Routes routes = Routes::doidge2012();
  for (const std::string& w : words(8, "SDV"))
    for (size_t k = 0; k < w.size(); ++k) {
      if (w[k] != 'D') continue;
      PhotonState photon = Routes::kPhotonStart;
      for (size_t i = w.size(); --i > k;) photon = routes.photon_next(photon, event_of(w[i]));
      EXPECT_EQ(routes.meet(read(routes, w.substr(0, k + 1)), photon), oracle(w)) << w << " at " << k;
    }
}

TEST(Routes, EachCausticWordIsMergedExactlyOnce) {
  // The eye merges at its first D; a photon deposits there exactly if the word is a caustic, and no
  // earlier event of its path was one that the tables call useless.
  const Routes routes = Routes::doidge2012();
  for (const std::string& w : words(8, "SDV")) {
    const size_t first = w.find('D');
    if (first == std::string::npos) {
      EXPECT_EQ(oracle(w), Route::kDiffuse) << w;
      continue;
    }
    PhotonState photon = Routes::kPhotonStart;
    // The eye's walk merges behind specular events only.
    bool reachable = w.find_first_not_of('S') == first;
    for (size_t i = w.size(); --i > first;) {
      reachable &= contains(routes.useful_events(photon, Route::kCaustic), event_of(w[i]));
      photon = routes.photon_next(photon, event_of(w[i]));
    }
    EXPECT_EQ(reachable && routes.deposits(photon, Route::kCaustic), oracle(w) == Route::kCaustic)
        << w;
  }
}

TEST(Routes, UselessLightPathsEnd) {
  const Routes routes = Routes::doidge2012();
  PhotonState state = Routes::kPhotonStart;
  state = routes.photon_next(state, EventClass::kDiffuse);
  EXPECT_EQ(routes.useful_events(state, Route::kCaustic), ClassMask::kSpecular);
  state = routes.photon_next(state, EventClass::kDiffuse);
  EXPECT_EQ(routes.useful_events(state, Route::kCaustic), ClassMask::kNone);
}

TEST(Routes, OneRouteForAll) {
  for (const Route route : {Route::kDiffuse, Route::kCaustic}) {
    const Routes routes = Routes::all(route);
    for (const std::string& w : words(6, "SDV")) {
      const bool volume = w.find('V') != std::string::npos;
      EXPECT_EQ(routes.owner(read(routes, w)), volume ? Route::kDiffuse : route) << w;
    }
    EXPECT_TRUE(routes.deposits(Routes::kPhotonStart, route));
    EXPECT_EQ(routes.useful_events(Routes::kPhotonStart, route) & ClassMask::kAll, ClassMask::kAll);
  }
}

TEST(Routes, SeenEmissionIsWhatFullPhotonMappingLeaves) {
  const Routes routes = Routes::seen_emission();
  for (const std::string& w : words(6, "SDV")) {
    const bool path = w.find('D') == std::string::npos || w.find('V') != std::string::npos;
    EXPECT_EQ(routes.owner(read(routes, w)), path ? Route::kDiffuse : Route::kCaustic) << w;
  }
  EXPECT_TRUE(contains(routes.useful_eye_events(read(routes, "D"), Route::kDiffuse),
                       EventClass::kVolume));
  // Without media no walk goes on behind the first D in vain.
  const Routes clear = routes.restricted_to(ClassMask::kAll);
  EXPECT_EQ(clear.useful_eye_events(Routes::kEyeStart, Route::kDiffuse), ClassMask::kSpecular);
  EXPECT_EQ(clear.useful_eye_events(read(clear, "D"), Route::kDiffuse), ClassMask::kNone);
  EXPECT_EQ(clear.useful_eye_events(Routes::kEyeStart, Route::kCaustic), ClassMask::kAll);
}

TEST(Routes, NoPhotonOfACausticScattersInAMedium) {
  const Routes routes = Routes::doidge2012();
  for (const std::string& w : words(6)) {
    PhotonState photon = Routes::kPhotonStart;
    for (size_t i = w.size(); i-- > 0;) photon = routes.photon_next(photon, event_of(w[i]));
    EXPECT_FALSE(contains(routes.useful_events(photon, Route::kCaustic), EventClass::kVolume)) << w;
  }
}

TEST(Routes, EveryCameraWalkOfTheMixedMethodMayStillCount) {
  const Routes routes = Routes::doidge2012();
  for (const std::string& w : words(6))
    EXPECT_EQ(routes.useful_eye_events(read(routes, w), Route::kDiffuse),
              ClassMask::kAll | ClassMask::kVolume)
        << w;
}

}  // namespace
}  // namespace nephroid
