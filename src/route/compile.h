// Light path expressions -> Routes: parse, nondeterministic automata for each route with and
// without its merge marker, one deterministic automaton over all of them, minimised, and its
// reversal for the light side; and the proof that every word has exactly one owner.
// Who calls it: the integrator table, session, `nephroid routes`, tests. It must not know scenes.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "route/routes.h"

namespace nephroid {

/// What the proof found, in words, with a shortest path as witness ("C D S L").
struct RouteFinding {
  enum class Kind {
    kOverlap,           ///< warning: two routes match, neither of them the last
    kUnreachable,       ///< error: a route owns no path, whatever the scene
    kHole,              ///< error: no route matches
    kNeverSampled,      ///< warning: the owner's estimator cannot make such a path
    kNoMergeVertex,     ///< error: an estimator that merges owns a path without a merge vertex
    kTwoMergeVertices,  ///< error: ... with more than one
  };
  Kind kind;
  bool is_error = false;
  std::string message;  ///< names the routes; contains the witness
  std::string witness;
};

/// Everything compile_routes found out.
struct RouteCompilation {
  Routes routes;
  std::vector<RouteFinding> findings;  ///< errors first, then overlaps
  std::vector<std::string>
      examples;                   ///< [route]: a shortest path that it owns, "C D S L", "" if none
  std::vector<bool> aov_matches;  ///< [AOV]: some path lies in it
};

/// Compiles and proves. A scene's symbols may be given so that findings are about paths that it can
/// have and only its events are useful; without them all symbols count but light from media, which
/// is only proved if a scene has it. Throws UsageError with column and caret for an expression that
/// is wrong, and for routes that are too many or too complex. Findings do not throw.
/// `camera_connects`: light paths can be connected to the camera (Camera::connects).
RouteCompilation compile_routes(std::span<const RouteDefinition> routes,
                                std::span<const AovDefinition> aovs,
                                const SymbolSet* symbols = nullptr, bool camera_connects = true);

/// The routes of a compilation without errors; throws UsageError with the first error (under
/// `strict` the first overlap, too).
Routes checked_routes(RouteCompilation compilation, bool strict);

/// All labels that the expressions mention, in the order of Routes::labels().
std::vector<std::string> mentioned_labels(std::span<const RouteDefinition> routes,
                                          std::span<const AovDefinition> aovs);

/// A word in the notation of the expressions: "C D S L", with sides and labels if `full`.
std::string word_text(std::span<const EventSymbol> events, LightSymbol light,
                      std::span<const std::string> labels, bool full);

}  // namespace nephroid
