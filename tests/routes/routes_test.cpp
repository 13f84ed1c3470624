// Compares the preset `doidge2012` with its paper: the worked example, the bit-encoded form, and
// the small hand-made tables that the general router replaced. Also tests useful events.
#include "route/routes.h"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "estimators.h"
#include "routes/letters.h"

namespace nephroid {
namespace {

// The paper's form: a path is a bit string (1 = specular). The last bits decide whether a vertex
// may be lit implicitly (hitting a light) or explicitly (sampling one).
bool diffuse_by_bits(const std::string& events) {
  // An optional trailing D, then a run of ones preceded by a zero (D): a caustic.
  uint32_t bits = 0;
  for (const char e : events) bits = (bits << 1) | (e == 'S' ? 1u : 0u);
  const int n = static_cast<int>(events.size());
  const auto specular = [&](int k) { return ((bits >> k) & 1u) != 0; };
  int k = 0;
  if (k < n && !specular(k)) ++k;
  const int before = k;
  while (k < n && specular(k)) ++k;
  return !(k > before && k < n);
}

// The hand-written table for C [SD]* D S+ D? L.
bool diffuse_by_table(const std::string& events) {
  enum { kNoDiffuse, kDiffuseLast, kSpecularChain, kChainThenDiffuse };
  constexpr std::array<std::array<int, 2>, 4> next = {{{kDiffuseLast, kNoDiffuse},
                                                       {kDiffuseLast, kSpecularChain},
                                                       {kChainThenDiffuse, kSpecularChain},
                                                       {kDiffuseLast, kSpecularChain}}};
  size_t state = kNoDiffuse;
  for (const char e : events) state = static_cast<size_t>(next[state][e == 'S' ? 1 : 0]);
  return state == kNoDiffuse || state == kDiffuseLast;
}

size_t group_of(const Routes& routes, const EstimatorTraits* estimator) {
  for (size_t g = 0; g < routes.groups().size(); ++g)
    if (routes.groups()[g].estimator == estimator) return g;
  return routes.groups().size();
}

TEST(Routes, PaperExample) {
  // The events D D S D D D at vertices 1..6 (Doidge et al. 2012).
  const Routes routes = preset("doidge2012");
  const std::string events = "DDSDDD";
  const bool implicit[] = {true, true, true, false, false, true};
  const bool explicitly[] = {true, true, false, false, true, true};
  for (size_t k = 1; k <= events.size(); ++k) {
    EXPECT_EQ(owner_name(routes, events.substr(0, k - 1)) == "diffuse", implicit[k - 1])
        << "implicit at vertex " << k;
    EXPECT_EQ(owner_name(routes, events.substr(0, k)) == "diffuse", explicitly[k - 1])
        << "explicit at vertex " << k;
  }
}

TEST(Routes, TheBitsAndTheTableOfThePaperAgree) {
  const Routes routes = preset("doidge2012");
  for (const std::string& w : words(12, "SD")) {
    const bool diffuse = owner_name(routes, w) == "diffuse";
    EXPECT_EQ(diffuse, diffuse_by_bits(w)) << w;
    EXPECT_EQ(diffuse, diffuse_by_table(w)) << w;
  }
}

TEST(Routes, ThePaperNeedsElevenStatesFromTheEyeAndFiveFromTheLight) {
  // Eye states without a merge: no rough event yet; V but no D or G yet; D last; and so on. Each
  // exists once more after the D or G where photons are merged. Hair is a state that nothing
  // changes. A minimal automaton has no two states that agree on all continuations.
  const Routes routes = preset("doidge2012");
  const RouteTables& t = routes.tables();
  EXPECT_EQ(t.eye_states, 11u);
  EXPECT_EQ(t.light_states, 5u);
  EXPECT_LT(t.eye_next.bytes() + t.merge_next.bytes(), 220u);
}

TEST(Routes, EachCausticWordIsMergedExactlyOnce) {
  const Routes routes = preset("doidge2012");
  const size_t photons = group_of(routes, estimator_named("photons"));
  for (const std::string& w : words(7, "SDGV")) {
    int merged = 0;
    for (size_t k = 0; k < w.size(); ++k) {
      if (w[k] != 'D' && w[k] != 'G') continue;
      const EyeState eye = routes.merge(read_from_eye(routes, w.substr(0, k)), event_of(w[k]));
      const Part part = routes.meet(eye, read_from_light(routes, w.substr(k + 1)));
      if (part == kNoPart) continue;
      ++merged;
      EXPECT_TRUE(routes.owns(photons, part));
      EXPECT_EQ(w.find_first_of("DG"), k) << w;
    }
    EXPECT_EQ(merged, owner_name(routes, w) == "caustic" ? 1 : 0) << w;
  }
}

TEST(Routes, AMarkMovesTheMergeVertex) {
  const Routes routes = preset("doidge-last");
  const auto merges_at = [&](const std::string& w, size_t k) {
    const EyeState eye = routes.merge(read_from_eye(routes, w.substr(0, k)), event_of(w[k]));
    return routes.meet(eye, read_from_light(routes, w.substr(k + 1))) != kNoPart;
  };
  EXPECT_FALSE(merges_at("DDSD", 0));
  EXPECT_TRUE(merges_at("DDSD", 1));
  EXPECT_FALSE(merges_at("DDSD", 3));
  EXPECT_TRUE(merges_at("DSGS", 2));
}

TEST(Routes, UselessWalksEnd) {
  const Routes routes = preset("doidge2012");
  const size_t photons = group_of(routes, estimator_named("photons"));
  const size_t path = group_of(routes, estimator_named("path"));
  constexpr ClassMask all = ClassMask::kEvery;
  // After two rough surfaces and no specular one, a photon is no caustic any more.
  const LightState once = read_from_light(routes, "D");
  EXPECT_EQ(routes.useful_before_deposit(photons, once, 0), ClassMask::kSpecular);
  EXPECT_EQ(routes.useful_before_deposit(photons, read_from_light(routes, "DD"), 0),
            ClassMask::kNone);
  EXPECT_EQ(routes.deposits(photons, once, 0), ClassMask::kNone);
  EXPECT_EQ(routes.deposits(photons, read_from_light(routes, "S"), 0), ClassMask::kRough);
  EXPECT_TRUE(routes.needs_specular(photons));
  EXPECT_TRUE(routes.needs_specular(photons, once));
  for (const char* free : {"", "S", "DS", "DSD", "DD"})
    EXPECT_FALSE(routes.needs_specular(photons, read_from_light(routes, free))) << free;
  const Routes whole = preset("all-photons");
  EXPECT_FALSE(whole.needs_specular(group_of(whole, estimator_named("photons"))));
  // A camera path for photons ends at its first D or G. Path tracing may always go on.
  EXPECT_EQ(routes.merges(photons, routes.start(), 0), ClassMask::kRough);
  EXPECT_EQ(routes.useful_before_merge(photons, routes.start(), 0),
            ClassMask::kSpecular | ClassMask::kVolume);
  EXPECT_EQ(routes.useful_before_merge(photons, read_from_eye(routes, "SD"), 0), ClassMask::kNone);
  for (const std::string& w : words(5, "SDGV"))
    EXPECT_EQ(routes.useful(path, read_from_eye(routes, w), 0), all) << w;
  EXPECT_TRUE(routes.ends(path, routes.start()));
  EXPECT_FALSE(routes.ends(path, read_from_eye(routes, "DS")) &&
               !routes.owns(path, routes.owner(read_from_eye(routes, "DS"),
                                               light_symbol(LightKind::kMedium, 0))));
  // Only path tracing ends paths at lights; only photons are stored.
  EXPECT_EQ(routes.deposits(path, once, 0), ClassMask::kNone);
  EXPECT_FALSE(routes.owns(path, kNoPart));
}

TEST(Routes, FewerEventsAreUsefulWhereFewerCanOccur) {
  const Routes routes = preset("all-photons");
  const size_t path = group_of(routes, estimator_named("path"));
  EXPECT_TRUE(contains(routes.useful(path, read_from_eye(routes, "D"), 0), EventClass::kVolume));
  // Without glowing media no camera path needs to go on after the first D.
  const Routes clear = routes.restricted_to(symbols_of("DS", {LightKind::kShape}));
  EXPECT_EQ(clear.useful(path, clear.start(), 0), ClassMask::kSpecular);
  EXPECT_EQ(clear.useful(path, read_from_eye(clear, "D"), 0), ClassMask::kNone);
  const size_t photons = group_of(clear, estimator_named("photons"));
  EXPECT_EQ(clear.merges(photons, clear.start(), 0), ClassMask::kDiffuse);
  EXPECT_EQ(clear.deposits(photons, read_from_light(clear, ""), 0), ClassMask::kDiffuse);
  // Without specular surfaces there are no caustics, so nothing is useful for them.
  const Routes dull = preset("doidge2012").restricted_to(symbols_of("DG", {LightKind::kShape}));
  const size_t caustics = group_of(dull, estimator_named("photons"));
  EXPECT_EQ(dull.useful_before_merge(caustics, dull.start(), 0), ClassMask::kNone);
  EXPECT_EQ(dull.useful_before_deposit(caustics, read_from_light(dull, ""), 0), ClassMask::kNone);
}

TEST(Routes, LightTracingConnectsWhereTheFirstEventOfItsWordsAllows) {
  const Routes routes = preset("split");
  const size_t group = group_of(routes, estimator_named("lighttrace"));
  const LightState glass = read_from_light(routes, "S");
  // C D S L, but neither C S S L nor C V S L, which has no D.
  EXPECT_EQ(routes.connects(group, glass, 0), ClassMask::kRough);
  EXPECT_EQ(routes.connects(group, read_from_light(routes, ""), 0), ClassMask::kNone);
  EXPECT_EQ(routes.connects(group, read_from_light(routes, "DS"), 0),
            ClassMask::kRough | ClassMask::kVolume);
  EXPECT_EQ(routes.useful_before_connection(group, read_from_light(routes, "DD"), 0),
            ClassMask::kNone);
  // Photons are stored only for words that begin with S, at the D behind it.
  const size_t photons = group_of(routes, estimator_named("photons"));
  EXPECT_EQ(routes.deposits(photons, glass, 0), ClassMask::kRough);
  EXPECT_EQ(routes.merges(photons, routes.start(), 0), ClassMask::kNone);
  EXPECT_EQ(routes.merges(photons, read_from_eye(routes, "S"), 0), ClassMask::kRough);
}

TEST(Routes, LightFromMediaGoesToTheFirstRouteThatCanReachIt) {
  const Routes routes = preset("doidge2012");
  EXPECT_EQ(owner_name(routes, "DS"), "caustic");
  EXPECT_EQ(owner_name(routes, "DS", LightKind::kMedium), "diffuse");
  const Routes only = compiled({"all=.*:lighttrace"}).routes;
  EXPECT_EQ(owner_name(only, "D", LightKind::kMedium), "");
}

TEST(Routes, PartsAreRoutesCutByLayers) {
  const Routes routes =
      compiled({"caustic=C.*DS+L:photons", "rest=.*:path"}, {"key=C.*<L.'key'>", "direct=C[DGV]L"})
          .routes;
  // caustic: with and without the key. rest: all four combinations of key and direct.
  EXPECT_EQ(routes.parts().size(), 6u);
  ASSERT_EQ(routes.labels(), std::vector<std::string>{"key"});
  EXPECT_EQ(routes.label("key"), 1);
  EXPECT_EQ(routes.label("other"), 0);
  const Part part = routes.owner(read_from_eye(routes, "D"), light_symbol(LightKind::kShape, 1));
  EXPECT_EQ(routes.parts()[part].route, 1);
  EXPECT_EQ(routes.parts()[part].aovs, (std::vector<int>{0, 1}));
  ASSERT_EQ(routes.groups().size(), 2u);
  EXPECT_EQ(routes.groups()[0].parts, (std::vector<Part>{0, 1}));
  EXPECT_EQ(routes.groups()[1].parts.size(), 4u);
}

TEST(Routes, RoutesOfOneEstimatorAreOneGroup) {
  const Routes routes =
      compiled({"a=CL:path", "b=CS+L:lighttrace", "c=CD+L:path", "rest=.*:lighttrace"}).routes;
  ASSERT_EQ(routes.groups().size(), 2u);
  EXPECT_EQ(routes.groups()[0].estimator, estimator_named("path"));
  EXPECT_EQ(routes.groups()[0].routes, (std::vector<int>{0, 2}));
  EXPECT_EQ(routes.groups()[1].routes, (std::vector<int>{1, 3}));
}

TEST(Routes, WideTablesHoldWhatNarrowOnesCannot) {
  const NumberTable narrow({0, 255}), wide({0, 256});
  EXPECT_EQ(narrow.bytes(), 2u);
  EXPECT_EQ(wide.bytes(), 4u);
  EXPECT_EQ(narrow[1], 255);
  EXPECT_EQ(wide[1], 256);
}

}  // namespace
}  // namespace nephroid
