// The meaning of a route set, word by word, from the definitions of docs/routes.md alone: owners,
// layers and merge vertices. No automaton over several routes, no tables. It must not use src/route
// except for the list of estimators.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "estimators.h"
#include "route/route_set.h"
#include "routes/oracle.h"

namespace nephroid::oracle {

struct OracleRoute {
  std::string name;
  Tree expression;
  const EstimatorTraits* estimator = estimator_named("path");
};

/// Events, eye first, and a light, as indices into the alphabet.
struct Path {
  std::vector<int> events;
  int light = 0;
};

/// Properties of a path.
struct PathFacts {
  std::vector<int> matching;           ///< matching routes, in order
  std::optional<int> owner;            ///< the route that renders it
  std::vector<int> aovs;               ///< layers that contain it
  std::vector<size_t> merge_vertices;  ///< from 0; empty if the owner's estimator does not merge
  bool marked_twice = false;           ///< the owner matches with two merge vertices in one reading
};

class OracleRoutes {
 public:
  /// `labels`: the names of labels 1, 2, ...
  OracleRoutes(std::vector<OracleRoute> routes, std::vector<OracleRoute> aovs,
               std::vector<std::string> labels);

  const Alphabet& alphabet() const { return alphabet_; }
  const std::vector<OracleRoute>& routes() const { return routes_; }
  const std::vector<OracleRoute>& aovs() const { return aovs_; }
  const std::vector<std::string>& labels() const { return labels_; }
  const EstimatorTraits& type(int route) const { return *routes_[size_t(route)].estimator; }

  /// Machines for words without marks, and those that find the merge vertices of a route by reading
  /// words with one mark. Routes whose estimators do not merge have none of the latter.
  Machine& route(int i) { return plain_[size_t(i)]; }
  Machine& aov(int i) { return layers_[size_t(i)]; }
  Machine* merging(int i) { return merging_[size_t(i)] ? &*merging_[size_t(i)] : nullptr; }

  bool touches_hair(const Path& path) const;
  /// True if the route may own a path from this light, with or without an H.
  bool can_own(int route, int light, bool hair) const {
    return (alphabet_.light_kind(light) != LightKind::kMedium && !hair) ||
           !type(route).starts_at_lights;
  }
  /// True if any estimator has a technique for the path.
  bool somebody_can_sample(const Path& path) const;
  /// True if the estimator of the route, the path's owner, has a technique for it.
  bool can_sample(int route, const Path& path, size_t merge_vertices) const;

  PathFacts facts(const Path& path);

  /// All paths that a word such as "C <TS'glass'> D L" denotes, each letter read as a place in an
  /// expression. Stops after `most` paths. Empty if it is no such word.
  std::vector<Path> paths_of(const std::string& word, size_t most = 200000) const;
  /// The path in the same notation, in full detail.
  std::string text(const Path& path) const;

 private:
  Alphabet alphabet_;
  std::vector<OracleRoute> routes_, aovs_;
  std::vector<std::string> labels_;
  std::vector<Machine> plain_, layers_;
  std::vector<std::optional<Machine>> merging_;
};

/// One place of an expression from its text: a letter or <..>, without sets and marks. Empty if it
/// is neither. `labels`: the names of labels 1, 2, ...; any other name is label 0.
std::optional<Atom> atom_of(const std::string& text, const std::vector<std::string>& labels);

/// A set [DG], or [^DG] if `complement`, of letters.
Atom set_of(std::string_view letters, bool complement);

/// The merge vertex of routes without a mark: the first D or G, after S and V only.
Tree first_rough_event();

}  // namespace nephroid::oracle
