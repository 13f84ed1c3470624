// Compiles light path expressions to Routes: one minimal deterministic automaton over all routes
// and its reversal for the light side. Proves that every path has exactly one owner. It must not
// know scenes.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "route/routes.h"

namespace nephroid {

/// A finding of the proof, with a shortest path as its witness ("C D S L").
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

/// The result of compile_routes.
struct RouteCompilation {
  Routes routes;
  std::vector<RouteFinding> findings;  ///< errors first, then overlaps
  std::vector<std::string>
      examples;                    ///< [route]: its shortest path, "C D S L", or "" if it owns none
  std::vector<bool> aov_matches;   ///< [AOV]: some path lies in it
  std::vector<bool> part_matches;  ///< [part]: some path lies in it
};

/// Compiles and proves. With a scene's `symbols`, findings are about paths that the scene can have,
/// and only its events are useful. Without them all symbols count except light from media and hair.
/// Throws UsageError for a wrong expression, with column and caret, and for routes that are too
/// many or too complex. Findings do not throw. `camera_connects`: light paths can be connected to
/// the camera (Camera::connects).
RouteCompilation compile_routes(std::span<const RouteDefinition> routes,
                                std::span<const AovDefinition> aovs,
                                const SymbolSet* symbols = nullptr, bool camera_connects = true);

/// The routes of a compilation. Throws UsageError with the first error or, if `strict`, the first
/// overlap.
Routes checked_routes(RouteCompilation compilation, bool strict);

/// All labels that the expressions mention, in the order of Routes::labels().
std::vector<std::string> mentioned_labels(std::span<const RouteDefinition> routes,
                                          std::span<const AovDefinition> aovs);

/// A word in the notation of the expressions: "C D S L", with sides and labels if `full`.
std::string word_text(std::span<const EventSymbol> events, LightSymbol light,
                      std::span<const std::string> labels, bool full);

}  // namespace nephroid
