// Compares 200 random route sets, and the presets, with their definition: every word of up to six
// letters over all letters, and of up to twelve over D and S. Every kind of light, both ends and
// every meeting point are tried. Some sets have faults (holes, routes that own nothing, photons
// without a merge vertex), which the proof must find.
#include <gtest/gtest.h>

#include "core/errors.h"
#include "estimators.h"
#include "integrator/presets/route_presets.h"
#include "routes/comparison.h"
#include "routes/random_routes.h"

namespace nephroid::oracle {
namespace {

std::string option(const OracleRoute& route) {
  return route.name + "=" + route.expression.text() + ":" + route.estimator->name;
}

std::string description(const OracleRoutes& set) {
  std::string out;
  for (const OracleRoute& route : set.routes()) out += "--route '" + option(route) + "'\n";
  for (const OracleRoute& aov : set.aovs())
    out += "--aov '" + aov.name + "=" + aov.expression.text() + "'\n";
  return out;
}

RouteCompilation compile(const OracleRoutes& set, const SymbolSet* symbols) {
  std::vector<RouteDefinition> routes;
  std::vector<AovDefinition> aovs;
  for (const OracleRoute& route : set.routes())
    routes.push_back(parse_route(option(route), estimator_traits()));
  for (const OracleRoute& aov : set.aovs())
    aovs.push_back(parse_aov(aov.name + "=" + aov.expression.text()));
  return compile_routes(routes, aovs, symbols);
}

/// A random subset with at least one light and one event.
SymbolSet some_symbols(const SymbolSet& all, RandomRoutes& random) {
  SymbolSet some = all;
  for (size_t i = 1; i < all.events.size(); ++i)
    if (random.below(4) == 0) some.events[i] = false;
  for (size_t i = 1; i < all.lights.size(); ++i)
    if (random.below(3) == 0) some.lights[i] = false;
  return some;
}

/// All words up to the length that a test has time for with this alphabet.
void compare_words(Comparison& comparison, const Alphabet& alphabet, RandomRoutes& random) {
  std::vector<int> all;
  for (int e = 0; e < alphabet.events(); ++e) all.push_back(e);
  comparison.all_words(all, alphabet.labels() == 1 ? 6 : alphabet.labels() <= 3 ? 3 : 2);
  comparison.all_words({random.below(2), static_cast<int>(EventKind::kSR) + random.below(2)}, 12);
  for (int n = 0; n < 300; ++n) {
    std::vector<int> word;
    for (int i = 3 + random.below(10); i > 0; --i) word.push_back(random.below(alphabet.events()));
    comparison.word(word);
  }
}

/// Compares the compiled tables and findings of a set with the oracle. `variant` chooses the
/// scene's symbols: all but glowing media, all, some, or some after compiling for all.
void compare(OracleRoutes set, int variant, RandomRoutes& random) {
  SCOPED_TRACE(description(set));
  RouteCompilation compilation = compile(set, nullptr);
  SymbolSet present = all_symbols(compilation.routes, variant != 0);
  if (variant >= 2) present = some_symbols(present, random);
  if (variant == 1 || variant == 2) compilation = compile(set, &present);
  const Routes routes =
      variant == 3 ? compilation.routes.restricted_to(present) : compilation.routes;

  Comparison comparison(set, routes, present);
  compare_words(comparison, set.alphabet(), random);
  if (variant != 3) comparison.findings(compilation);
  comparison.nothing_hopeless();
  EXPECT_EQ(comparison.failure(), "");
  EXPECT_GT(comparison.words(), 20000u);

  // The first error is thrown, or under --strict-routes the first overlap.
  using Kind = RouteFinding::Kind;
  const RouteFinding *error = nullptr, *overlap = nullptr;
  for (const RouteFinding& f : compilation.findings) {
    if (f.is_error && error == nullptr) error = &f;
    if (f.kind == Kind::kOverlap && overlap == nullptr) overlap = &f;
  }
  for (const bool strict : {false, true}) {
    const RouteFinding* const reason = error == nullptr && strict ? overlap : error;
    std::string thrown;
    try {
      checked_routes(compilation, strict);
    } catch (const UsageError& e) {
      thrown = e.what();
    }
    EXPECT_EQ(thrown.empty(), reason == nullptr) << thrown;
    if (reason != nullptr) {
      EXPECT_NE(thrown.find(reason->message), std::string::npos) << thrown;
    }
  }
}

class BruteForce : public ::testing::TestWithParam<int> {};

TEST_P(BruteForce, TablesAndProofsAgreeWithTheDefinition) {
  for (int n = 0; n < 5; ++n) {
    const int seed = 5 * GetParam() + n;
    std::vector<std::string> labels;
    if (seed % 4 == 1) labels = {"glass", "key"};
    if (seed % 16 == 3) labels = {"glass", "water", "key", "sky lamp"};
    RandomRoutes random(static_cast<uint32_t>(seed) + 1000, labels);
    compare(random.set(), n < 2 ? 0 : n - 1, random);
  }
}

INSTANTIATE_TEST_SUITE_P(Sets, BruteForce, ::testing::Range(0, 40));

/// Trees of a preset's expressions. compare_preset checks that they match the preset.
Tree letters(std::string_view set) {
  return Tree::of(set.size() == 1 ? *atom_of(std::string(set), {}) : set_of(set, false));
}
Tree any() {
  return Tree::repeat(letters("."), 0, -1);
}
Tree chain() {
  return Tree::repeat(letters("S"), 1, -1);
}
Tree maybe(Tree tree) {
  return Tree::repeat(std::move(tree), 0, 1);
}

void compare_preset(const std::string& name, const std::vector<OracleRoute>& routes) {
  const auto preset = route_preset(name);
  ASSERT_TRUE(preset);
  ASSERT_EQ(preset->size(), routes.size());
  for (size_t r = 0; r < routes.size(); ++r) {
    EXPECT_EQ(preset->at(r).name, routes[r].name);
    EXPECT_EQ(preset->at(r).expression, routes[r].expression.text());
    EXPECT_EQ(preset->at(r).estimator, routes[r].estimator);
  }
  RandomRoutes random(3, {});
  for (int variant = 0; variant < 4; ++variant)
    compare(OracleRoutes(routes, {}, {}), variant, random);
  for (const RouteFinding& f : compile(OracleRoutes(routes, {}, {}), nullptr).findings)
    EXPECT_EQ(f.kind, RouteFinding::Kind::kNeverSampled) << f.message;
}

TEST(Presets, Doidge2012) {
  compare_preset("doidge2012", {{"caustic",
                                 Tree::sequence({letters("C"), any(), letters("DG"), chain(),
                                                 maybe(letters("DG")), letters("L")}),
                                 estimator_named("photons")},
                                {"diffuse", any(), estimator_named("path")}});
}

TEST(Presets, DoidgeLast) {
  Tree merged = letters("DG");
  merged.atom.marked = true;
  compare_preset(
      "doidge-last",
      {{"caustic",
        Tree::sequence({letters("C"), any(), merged, chain(), maybe(letters("DG")), letters("L")}),
        estimator_named("photons")},
       {"diffuse", any(), estimator_named("path")}});
}

TEST(Presets, Split) {
  compare_preset("split",
                 {{"caustic",
                   Tree::sequence({letters("C"), maybe(Tree::sequence({letters("DGV"), any()})),
                                   letters("DG"), chain(), maybe(letters("DG")), letters("L")}),
                   estimator_named("lighttrace")},
                  {"seen-caustic",
                   Tree::sequence({letters("C"), letters("S"), any(), letters("DG"), chain(),
                                   maybe(letters("DG")), letters("L")}),
                   estimator_named("photons")},
                  {"diffuse", any(), estimator_named("path")}});
}

TEST(Presets, AllPhotons) {
  const Tree emission =
      Tree::choice({Tree::sequence({Tree::repeat(letters("SV"), 0, -1), letters("L")}),
                    Tree::sequence({any(), letters("M")}),
                    Tree::sequence({any(), letters("H"), any(), letters("L")})});
  compare_preset("all-photons",
                 {{"emission", Tree::sequence({letters("C"), emission}), estimator_named("path")},
                  {"photons", any(), estimator_named("photons")}});
}

TEST(Expressions, WithoutPathsAreRefused) {
  RandomRoutes random(7, {});
  const Alphabet alphabet(0);
  int refused = 0;
  for (int n = 0; n < 1000; ++n) {
    // Most expressions that begin before the eye or end behind a light match no path.
    Tree tree = random.expression(false);
    const Tree event = Tree::of(*atom_of("D", {}));
    if (n % 4 == 1) tree = Tree::sequence({event, tree});
    if (n % 4 == 2) tree = Tree::sequence({tree, event});
    if (Machine(tree, alphabet, Atom::Marks::kIgnore).matches_any_path()) {
      EXPECT_NO_THROW(parse_route("r=" + tree.text() + ":path", estimator_traits())) << tree.text();
    } else {
      ++refused;
      EXPECT_THROW(parse_route("r=" + tree.text() + ":path", estimator_traits()), UsageError)
          << tree.text();
    }
  }
  EXPECT_GE(refused, 300);
  EXPECT_LE(refused, 600);
}

}  // namespace
}  // namespace nephroid::oracle
