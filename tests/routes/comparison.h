// Holds compiled routes against what they mean by definition (oracle_routes.h), word by word: the
// owner from the eye and from every possible meeting point, merge vertices, what walks are told is
// useful, and all findings of the proof.
// Who calls it: brute_force_test.cpp. It must not know how routes are compiled.
#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "estimators.h"
#include "route/compile.h"
#include "routes/oracle_routes.h"

namespace nephroid::oracle {

/// Every event and light of the alphabet (light from media if `media`), as routes number them.
SymbolSet all_symbols(const Routes& routes, bool media);

/// True if the estimator connects light walks to the camera.
inline bool connects_lights(const EstimatorTraits* kind) {
  return is_one_of(kind, {"lighttrace", "photons+light"});
}

/// True if the estimator has the reach of path tracing from the eye.
inline bool walks_from_eye(const EstimatorTraits* kind) {
  return is_one_of(kind, {"path", "pssmlt"});
}

/// True if it makes a path of an eye's and a light's walk, cut anywhere.
inline bool is_cut_anywhere(const EstimatorTraits* kind) {
  return is_one_of(kind, {"bdpt", "vcm", "bpm", "path+photons", "mlt"});
}

class Comparison {
 public:
  /// Findings are about paths of the symbols in `present`; so is what `routes` call useful. All
  /// must outlive the comparison.
  Comparison(OracleRoutes& set, const Routes& routes, const SymbolSet& present);

  /// All words with up to `length` of these events, ending on each light of the alphabet.
  void all_words(const std::vector<int>& events, size_t length);
  /// One word, all its beginnings, and all lights.
  void word(const std::vector<int>& events);
  /// The findings against the words compared before.
  void findings(const RouteCompilation& compilation);
  /// That nothing is called useful which leads nowhere, by the tables themselves.
  void nothing_hopeless();

  /// What went wrong first, and how many words were compared.
  const std::string& failure() const { return failure_; }
  size_t words() const { return words_; }

 private:
  /// One more event of the current word, and everything that has read it.
  void push(int event);
  void pop() { path_.events.pop_back(); }
  void visit(const std::vector<int>& events, size_t length);
  void check_lights();
  void check_light_side(int route, Part part);
  void check_useful(int route, Part part);
  void note_defects(int route, const std::vector<int>& matching);
  bool is_defect(RouteFinding::Kind kind, const Path& path);
  bool present(const Path& path) const;
  bool event_present(int e) const { return present_.events[events_[size_t(e)]]; }
  void fail(const std::string& what);

  size_t length() const { return path_.events.size(); }
  EventSymbol symbol(size_t i) const { return events_[size_t(path_.events[i])]; }
  size_t group_of(int route) const { return groups_[size_t(route)]; }

  OracleRoutes& set_;
  const Routes& routes_;
  SymbolSet present_;
  std::vector<EventSymbol> events_;  // [event of the alphabet]
  std::vector<LightSymbol> lights_;  // [light of the alphabet]
  std::vector<size_t> groups_;       // [route]
  std::map<std::pair<int, std::vector<int>>, Part> parts_;

  Path path_;
  /// What has read the first n events, in element n.
  struct Read {
    EyeState eye = 0;
    std::vector<Machine::State> routes, aovs;
    std::vector<std::vector<Machine::State>> marked;  // [route][event that is marked]
    bool present = true, hair = false;
    std::vector<bool> useful;  // [group]: camera walks are told to go on
  };
  std::vector<Read> read_;
  std::vector<size_t> vertices_;  // merge vertices of the current word

  std::set<std::pair<int, int>> overlaps_;
  std::set<std::pair<RouteFinding::Kind, int>> defects_;
  bool hole_ = false, dark_medium_ = false;
  std::map<int, size_t> shortest_;  // [route]: events in a word that it owns
  std::string failure_;
  size_t words_ = 0;
};

}  // namespace nephroid::oracle
