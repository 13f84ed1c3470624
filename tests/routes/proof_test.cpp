// Findings of the proof: one small route set for each kind. The presets have none but warnings of
// light that no estimator can find.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "core/errors.h"
#include "routes/letters.h"

namespace nephroid {
namespace {

using Kind = RouteFinding::Kind;

std::vector<RouteFinding> findings_of(const RouteCompilation& compilation, Kind kind) {
  std::vector<RouteFinding> found;
  for (const RouteFinding& f : compilation.findings)
    if (f.kind == kind) found.push_back(f);
  return found;
}

bool has_error(const RouteCompilation& compilation) {
  return std::any_of(compilation.findings.begin(), compilation.findings.end(),
                     [](const RouteFinding& f) { return f.is_error; });
}

TEST(Proof, PresetsAreCompleteAndDisjoint) {
  for (const RoutePreset& p : route_presets()) {
    SCOPED_TRACE(p.name);
    const RouteCompilation compilation = compile_routes(route_preset(p.name).value(), {});
    EXPECT_FALSE(has_error(compilation));
    EXPECT_TRUE(findings_of(compilation, Kind::kOverlap).empty());
    // Everything that can occur at once, including glowing media and hair.
    const SymbolSet all{std::vector<bool>(8, true), std::vector<bool>(8, true)};
    const RouteCompilation with_all = compile_routes(route_preset(p.name).value(), {}, &all);
    EXPECT_FALSE(has_error(with_all));
    for (const std::string& example : with_all.examples) EXPECT_EQ(example.substr(0, 2), "C ");
  }
  EXPECT_FALSE(route_preset("none").has_value());
}

TEST(Proof, OverlapsNameBothAndTheOwner) {
  const RouteCompilation c = compiled({"one=C.*DS+L:photons", "two=C.*S.*L:path", "rest=.*:path"});
  const auto found = findings_of(c, Kind::kOverlap);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_FALSE(found[0].is_error);
  EXPECT_EQ(found[0].witness, "C D S L");
  EXPECT_EQ(found[0].message,
            "routes 'one' and 'two' both match C D S L; 'one', the first, owns it");
  EXPECT_NO_THROW(checked_routes(c, false));
  EXPECT_THROW(checked_routes(c, true), UsageError);
}

TEST(Proof, AHoleHasAShortestPath) {
  const auto found = findings_of(compiled({"a=C.*DS+L:photons", "b=C[DG]?L:path"}), Kind::kHole);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(found[0].is_error);
  EXPECT_EQ(found[0].witness, "C S L");
}

TEST(Proof, RoutesWithoutPathsAreErrorsUnlessOnlyTheSceneLacksThem) {
  const auto found =
      findings_of(compiled({"all=.*:path", "caustic=C.*DS+L:photons"}), Kind::kUnreachable);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(found[0].is_error);
  EXPECT_NE(found[0].message.find("'all' for instance C D S L"), std::string::npos);
  EXPECT_EQ(findings_of(compiled({"fire=C.*M:photons", "rest=.*:path"}), Kind::kUnreachable).size(),
            1u);
  // A scene without glass makes no route wrong; its route only has no example.
  const SymbolSet dull = symbols_of("D", {LightKind::kShape});
  const RouteCompilation c = compiled({"caustic=C.*DS+L:photons", "rest=.*:path"}, {}, &dull);
  EXPECT_TRUE(c.findings.empty());
  EXPECT_EQ(c.examples, (std::vector<std::string>{"", "C L"}));
}

TEST(Proof, LayersThatNoPathOfTheSceneMatchesAreKnown) {
  const SymbolSet indoors = symbols_of("DS", {LightKind::kShape});
  const RouteCompilation c =
      compiled({"rest=.*:path"}, {"sky=C.*B", "lamp=C.*O", "fog=C.*V.*L"}, &indoors);
  EXPECT_EQ(c.aov_matches, (std::vector<bool>{false, true, false}));
}

TEST(Proof, PathTracingMissesPointsBehindSpecularSurfaces) {
  const auto warnings = [](const std::string& letters, LightKind light) {
    const SymbolSet symbols = symbols_of(letters, {light});
    return findings_of(compiled({"all=.*:path"}, {}, &symbols), Kind::kNeverSampled);
  };
  EXPECT_TRUE(warnings("DS", LightKind::kShape).empty());
  EXPECT_TRUE(warnings("DS", LightKind::kEnvironment).empty());
  for (const LightKind light : {LightKind::kPoint, LightKind::kDistant}) {
    ASSERT_EQ(warnings("DS", light).size(), 1u);
    // The caustic is lost. A point light in a mirror is not reported: no estimator finds it.
    EXPECT_EQ(warnings("DS", light)[0].witness, "C D S L");
    EXPECT_FALSE(warnings("DS", light)[0].is_error);
    EXPECT_TRUE(warnings("S", light).empty());
    EXPECT_TRUE(warnings("D", light).empty());
  }
}

TEST(Proof, LightTracingMissesWhatIsSeenThroughSpecularSurfaces) {
  const auto warnings = [](const std::string& letters, LightKind light) {
    const SymbolSet symbols = symbols_of(letters, {light});
    return findings_of(compiled({"all=.*:lighttrace"}, {}, &symbols), Kind::kNeverSampled);
  };
  EXPECT_TRUE(warnings("DGV", LightKind::kShape).empty());
  EXPECT_EQ(warnings("DS", LightKind::kShape)[0].witness, "C S L");
  EXPECT_EQ(warnings("D", LightKind::kEnvironment)[0].witness, "C L");
}

TEST(Proof, PairsMissWhatTheCameraCannotBeConnectedFor) {
  const auto warnings = [](const std::string& estimator, const std::string& letters,
                           bool camera_connects) {
    const SymbolSet symbols = symbols_of(letters, {LightKind::kPoint});
    return findings_of(compiled({"all=.*:" + estimator}, {}, &symbols, camera_connects),
                       Kind::kNeverSampled);
  };
  for (const char* estimator : {"bdpt", "mlt"}) {
    ASSERT_EQ(warnings(estimator, "DS", true).size(), 1u) << estimator;
    EXPECT_EQ(warnings(estimator, "DS", true)[0].witness, "C S D S L") << estimator;
    ASSERT_EQ(warnings(estimator, "DS", false).size(), 1u) << estimator;
    EXPECT_EQ(warnings(estimator, "DS", false)[0].witness, "C D S L") << estimator;
    EXPECT_NE(warnings(estimator, "DS", false)[0].message.find("to this camera"),
              std::string::npos);
    EXPECT_TRUE(warnings(estimator, "D", false).empty()) << estimator;
  }
  EXPECT_TRUE(warnings("vcm", "DS", false).empty());
  EXPECT_EQ(warnings("vcm", "VS", true)[0].witness, "C S V S L");
  EXPECT_EQ(warnings("vcm", "VS", false)[0].witness, "C V S L");
  for (const bool camera_connects : {false, true}) {
    const auto bpm = warnings("bpm", "VS", camera_connects);
    ASSERT_EQ(bpm.size(), 1u);
    EXPECT_EQ(bpm[0].witness, "C V S L");
    EXPECT_NE(bpm[0].message.find("merged at D and G only"), std::string::npos);
    EXPECT_TRUE(warnings("bpm", "DS", camera_connects).empty());
  }
}

TEST(Proof, EachPathOfPhotonsHasOneMergeVertex) {
  const RouteCompilation none = compiled({"glass=CS+L:photons", "rest=.*:path"});
  ASSERT_EQ(findings_of(none, Kind::kNoMergeVertex).size(), 1u);
  EXPECT_EQ(findings_of(none, Kind::kNoMergeVertex)[0].witness, "C S L");
  const RouteCompilation two = compiled({"a=C.*D@.*L:photons", "rest=.*:path"});
  EXPECT_TRUE(findings_of(two, Kind::kNoMergeVertex).empty());
  ASSERT_EQ(findings_of(two, Kind::kTwoMergeVertices).size(), 1u);
  EXPECT_EQ(findings_of(two, Kind::kTwoMergeVertices)[0].witness, "C D D L");
  EXPECT_TRUE(findings_of(two, Kind::kTwoMergeVertices)[0].is_error);
  // A reading with two marks does not count as a reading with one.
  EXPECT_TRUE(has_error(compiled({"a=CD@D@L:photons", "rest=.*:path"})));
  // Estimators that do not merge need no vertex and ignore marks.
  EXPECT_FALSE(has_error(compiled({"glass=CS+L:path", "a=C.*D@.*L:lighttrace", "rest=.*:path"})));
  // Ambiguous readings with the same merge vertex count as one.
  EXPECT_FALSE(has_error(compiled({"a=C(S*|S*)D@(.*|D.*)L:photons", "rest=.*:path"})));
}

TEST(Proof, LightFromMediaNeedsARouteThatReachesIt) {
  const std::vector<std::string> photons = {"seen=C[SV]*L:path", "rest=.*:photons"};
  EXPECT_FALSE(has_error(compiled(photons)));
  const SymbolSet glowing = symbols_of("DS", {LightKind::kShape, LightKind::kMedium});
  const auto found = findings_of(compiled(photons, {}, &glowing), Kind::kHole);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].witness, "C D M");
}

TEST(Proof, LightThatTouchesHairNeedsARouteThatStartsAtTheEye) {
  const std::vector<std::string> photons = {"seen=C[SV]*L:path", "rest=.*:photons"};
  const SymbolSet hair = symbols_of("DSH", {LightKind::kShape});
  const auto found = findings_of(compiled(photons, {}, &hair), Kind::kHole);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].witness, "C H L");
  const Routes routes = compiled({"seen=.*:photons", "rest=.*:path"}, {}, &hair).routes;
  const auto owner = [&](const std::string& events) {
    return routes
        .parts()[routes.owner(read_from_eye(routes, events), light_symbol(LightKind::kShape, 0))]
        .route;
  };
  EXPECT_EQ(owner("DD"), 0);
  EXPECT_EQ(owner("DHD"), 1);
  EXPECT_EQ(owner("HD"), 1);
}

TEST(Proof, WitnessesTellSidesAndLabelsIfExpressionsDo) {
  const auto found = findings_of(
      compiled({"a=C<TS'glass'>L:path", "b=C<.S>O:path", "rest=.*:path"}), Kind::kOverlap);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].witness, "C <TS'glass'> O");
  const std::vector<std::string> labels = {"glass"};
  const std::vector<EventSymbol> events = {event_symbol(EventKind::kST, 1),
                                           event_symbol(EventKind::kV, 0)};
  const LightSymbol light = light_symbol(LightKind::kDistant, 1);
  EXPECT_EQ(word_text(events, light, labels, false), "C S V L");
  EXPECT_EQ(word_text(events, light, labels, true), "C <TS'glass'> V <B.'glass'>");
}

TEST(Proof, PartsAreCounted) {
  std::vector<std::string> aovs;
  for (int i = 0; i < 9; ++i)
    aovs.push_back("a" + std::to_string(i) + "=C.{" + std::to_string(i) + "}D.*L");
  EXPECT_THROW(compiled({"rest=.*:path"}, aovs), UsageError);
  aovs.resize(7);
  EXPECT_EQ(compiled({"rest=.*:path"}, aovs).routes.parts().size(), 128u);
}

}  // namespace
}  // namespace nephroid
