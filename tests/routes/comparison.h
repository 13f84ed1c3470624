// Compares compiled routes with their definition (oracle_routes.h), word by word: owners from the
// eye and from every meeting point, merge vertices, useful events, and all findings of the proof.
// It must not know how routes are compiled.
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

/// Every event and light of the alphabet (light from media only if `media`), as numbered by routes.
SymbolSet all_symbols(const Routes& routes, bool media);

/// True for estimators that connect light paths to the camera.
inline bool connects_lights(const EstimatorTraits* kind) {
  return is_one_of(kind, {"lighttrace", "photons+light"});
}

/// True for estimators that find the same paths as path tracing from the eye.
inline bool walks_from_eye(const EstimatorTraits* kind) {
  return is_one_of(kind, {"path", "pssmlt"});
}

/// True for estimators that join an eye path and a light path at any vertex.
inline bool is_cut_anywhere(const EstimatorTraits* kind) {
  return is_one_of(kind, {"bdpt", "vcm", "bpm", "path+photons", "mlt"});
}

class Comparison {
 public:
  /// Findings concern paths over the symbols in `present`, and so do the useful events of `routes`.
  /// The arguments must outlive the comparison.
  Comparison(OracleRoutes& set, const Routes& routes, const SymbolSet& present);

  /// Compares all words of up to `length` of these events, with each light of the alphabet.
  void all_words(const std::vector<int>& events, size_t length);
  /// Compares one word, all its prefixes, and all lights.
  void word(const std::vector<int>& events);
  /// Compares the findings with the words compared before.
  void findings(const RouteCompilation& compilation);
  /// Checks in the tables that no event is called useful which leads nowhere.
  void nothing_hopeless();

  /// The first failure, and the number of words compared.
  const std::string& failure() const { return failure_; }
  size_t words() const { return words_; }

 private:
  /// Appends an event to the current word and advances all machines.
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
  /// States of all machines after the first n events, in element n.
  struct Read {
    EyeState eye = 0;
    std::vector<Machine::State> routes, aovs;
    std::vector<std::vector<Machine::State>> marked;  // [route][marked event]
    bool present = true, hair = false;
    std::vector<bool> useful;  // [group]: camera paths should go on
  };
  std::vector<Read> read_;
  std::vector<size_t> vertices_;  // merge vertices of the current word

  std::set<std::pair<int, int>> overlaps_;
  std::set<std::pair<RouteFinding::Kind, int>> defects_;
  bool hole_ = false, dark_medium_ = false;
  std::map<int, size_t> shortest_;  // [route]: events in its shortest word
  std::string failure_;
  size_t words_ = 0;
};

}  // namespace nephroid::oracle
