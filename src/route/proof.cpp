// Each question is a breadth-first search over words; the first word found is the witness.
#include "route/proof.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "core/errors.h"
#include "route/word_search.h"
#include "route/word_text.h"

namespace nephroid {
namespace {

using Kind = RouteFinding::Kind;

constexpr size_t kMaxNodes = size_t{1} << 18;

struct PlainState {
  int state = 0;
  EventSummary events;
  auto operator<=>(const PlainState&) const = default;
};
// The state of the unmarked word, and of its marked variants that may still count: their number (up
// to 2), by state.
struct MarkedState {
  int state = 0;
  std::map<int, int> variants;
  auto operator<=>(const MarkedState&) const = default;
};

class Prover {
 public:
  explicit Prover(const ProofInput& input) : in_(input) {
    choose_representatives(in_.classes.event_class, in_.symbols ? &in_.symbols->events : nullptr,
                           in_.classes.events.size(), events_, event_symbols_);
    choose_representatives(in_.classes.light_class, in_.symbols ? &in_.symbols->lights : nullptr,
                           in_.classes.lights.size(), lights_, light_symbols_);
    if (!in_.symbols) {
      std::erase_if(lights_,
                    [&](int l) { return in_.classes.kind_of_light(l) == LightKind::kMedium; });
      std::erase_if(events_,
                    [&](int e) { return in_.classes.class_of_event(e) == EventClass::kHair; });
    }
    full_events_ = in_.classes.events.size() > kEventClasses;
    full_lights_ = lights_need_detail();
  }

  Proof prove() {
    proof_.examples.resize(in_.routes.size());
    size_t aovs = 0;
    for (const PartMeaning& part : in_.parts.parts)
      for (const int aov : part.aovs) aovs = std::max(aovs, static_cast<size_t>(aov) + 1);
    proof_.aov_matches.resize(aovs);
    proof_.part_matches.resize(in_.parts.parts.size());
    find_unreachable();
    look_at_plain_words();
    look_at_merge_vertices();
    find_overlaps();
    std::stable_sort(proof_.findings.begin(), proof_.findings.end(),
                     [](const RouteFinding& a, const RouteFinding& b) {
                       if (a.is_error != b.is_error) return a.is_error;
                       return a.kind < b.kind;
                     });
    return std::move(proof_);
  }

 private:
  // The classes that can occur, and the first possible symbol of each.
  static void choose_representatives(const std::vector<int>& class_of,
                                     const std::vector<bool>* present, size_t classes,
                                     std::vector<int>& chosen, std::vector<uint16_t>& symbols) {
    std::vector<bool> known(classes);
    symbols.assign(classes, 0);
    for (size_t s = 0; s < class_of.size(); ++s) {
      const int c = class_of[s];
      if (c == SymbolClasses::kNone || known[c]) continue;
      if (present && (s >= present->size() || !(*present)[s])) continue;
      known[c] = true;
      symbols[c] = static_cast<uint16_t>(s);
      chosen.push_back(c);
    }
  }
  // True if an expression distinguishes lights that the short notation does not.
  bool lights_need_detail() const {
    if (in_.classes.lights.size() > kLightKinds) return true;
    for (const std::vector<bool>& reads : in_.classes.reads_light)
      for (size_t l = 0; l < reads.size(); ++l)
        if (in_.classes.kind_of_light(static_cast<int>(l)) != LightKind::kMedium &&
            reads[l] != reads[0])
          return true;
    return false;
  }
  std::string text(const std::vector<int>& word, int light) const {
    return text(word, light, event_symbols_, light_symbols_);
  }
  // The word with its classes written as the given symbols.
  std::string text(const std::vector<int>& word, int light, const std::vector<uint16_t>& events,
                   const std::vector<uint16_t>& lights) const {
    std::string text = "C ";
    for (const int e : word) text += event_text(events[e], in_.labels, full_events_) + " ";
    return text + light_text(lights[light], in_.labels, full_lights_);
  }
  std::string name(int route) const { return "'" + in_.routes[route].name + "'"; }
  // "route 'caustic' (photons)"
  std::string owner_text(int route) const {
    return "route " + name(route) + " (" + estimator(route).name + ")";
  }
  const EstimatorTraits& estimator(int route) const { return *in_.routes[route].estimator; }
  int route_at(int state, int light) const {
    const int part = in_.parts.automaton.at(state, light);
    return part == kNoPart ? kNoRoute : in_.parts.parts[part].route;
  }
  void report(Kind kind, bool is_error, const std::string& message, const std::string& witness) {
    proof_.findings.push_back({kind, is_error, message, witness});
  }

  // Looks at all words, not only those of the scene: a scene without glass makes no route wrong.
  void find_unreachable() {
    std::vector<bool> owns(in_.routes.size());
    for (const PartMeaning& p : in_.parts.parts) owns[p.route] = true;
    for (size_t r = 0; r < owns.size(); ++r)
      if (!owns[r]) report_unreachable(static_cast<int>(r));
  }
  void report_unreachable(int route) {
    const Automaton& a = in_.matches.automaton;
    std::vector<int> all;
    for (int e = 0; e < static_cast<int>(a.events); ++e) all.push_back(e);
    const WordSearch<int> search(a.start, all, SIZE_MAX,
                                 [&](int s, int e) { return a.after(s, e); });
    for (size_t n = 0; n < search.nodes().size(); ++n)
      for (int l = 0; l < static_cast<int>(a.lights); ++l) {
        const WordMatches& m = in_.matches.matches[a.at(search.nodes()[n].state, l)];
        const int owner = owner_of(m, in_.routes, in_.classes.kind_of_light(l));
        if (owner == kNoRoute || !std::binary_search(m.routes.begin(), m.routes.end(), route))
          continue;
        const std::string witness = text(search.word(n), l, in_.classes.events, in_.classes.lights);
        return report(Kind::kUnreachable, true,
                      owner_text(route) +
                          " owns no path: routes before it match all of its paths, " + name(owner) +
                          " for instance " + witness,
                      witness);
      }
    report(Kind::kUnreachable, true,
           owner_text(route) +
               " owns no path: it matches only light that media emit or that touches hair, and "
               "its estimator starts at lights",
           "");
  }

  // Finds holes, examples and paths that are never sampled.
  void look_at_plain_words() {
    const Automaton& a = in_.parts.automaton;
    const WordSearch<PlainState> search(
        {a.start, {}}, events_, SIZE_MAX, [&](const PlainState& s, int e) -> PlainState {
          return {a.after(s.state, e), s.events.after(in_.classes.class_of_event(e))};
        });
    std::optional<std::string> hole, medium_hole, hair_hole;
    struct NeverSampled {
      const char* why = nullptr;
      bool has_events = false;  ///< paths with events are better witnesses
      std::string witness;
    };
    std::vector<NeverSampled> never(in_.routes.size());
    for (size_t n = 0; n < search.nodes().size(); ++n)
      for (const int l : lights_) {
        const PlainState& s = search.nodes()[n].state;
        const LightKind light = in_.classes.kind_of_light(l);
        const int route = route_at(s.state, l);
        if (route == kNoRoute) {
          std::optional<std::string>& found = light == LightKind::kMedium    ? medium_hole
                                              : touches_hair(search.word(n)) ? hair_hole
                                                                             : hole;
          if (!found) found = text(search.word(n), l);
          continue;
        }
        const int part = in_.parts.automaton.at(s.state, l);
        proof_.part_matches[part] = true;
        for (const int aov : in_.parts.parts[part].aovs) proof_.aov_matches[aov] = true;
        std::string& example = proof_.examples[route];
        if (example.empty()) example = text(search.word(n), l);
        NeverSampled& best = never[route];
        const char* why =
            estimator(route).why_never_sampled({s.events, light, in_.camera_connects});
        const bool has_events = s.events.count > 0;
        if (why != nullptr && (best.why == nullptr || (has_events && !best.has_events)))
          best = {why, has_events, text(search.word(n), l)};
      }
    if (hole)
      report(Kind::kHole, true,
             "no route matches " + *hole + "; a last route such as rest=.*:path matches the rest",
             *hole);
    if (medium_hole)
      report(Kind::kHole, true,
             "no route that can reach light from media matches " + *medium_hole +
                 ": expected one whose estimator starts at the eye",
             *medium_hole);
    if (hair_hole)
      report(Kind::kHole, true,
             "no route that can follow light from hair matches " + *hair_hole +
                 ": expected one whose estimator starts at the eye",
             *hair_hole);
    for (size_t r = 0; r < never.size(); ++r)
      if (never[r].why != nullptr)
        report(Kind::kNeverSampled, false,
               owner_text(static_cast<int>(r)) + " owns " + never[r].witness +
                   ", which it cannot find (that light will be missing): " + never[r].why,
               never[r].witness);
  }

  bool touches_hair(const std::vector<int>& word) const {
    return std::any_of(word.begin(), word.end(),
                       [&](int e) { return in_.classes.class_of_event(e) == EventClass::kHair; });
  }

  // Checks that each path of a route that merges has exactly one merge vertex.
  void look_at_merge_vertices() {
    if (std::none_of(in_.routes.begin(), in_.routes.end(),
                     [](const RouteDefinition& r) { return r.estimator->merges; }))
      return;
    const Automaton& a = in_.parts.automaton;
    const WordSearch<MarkedState> search({a.start, {}}, events_, kMaxNodes,
                                         [&](const MarkedState& s, int e) {
                                           MarkedState next{a.after(s.state, e), {}};
                                           const auto add = [&](int state, int count) {
                                             int& sum = next.variants[state];
                                             sum = std::min(sum + count, 2);
                                           };
                                           for (const auto& [state, count] : s.variants)
                                             add(a.after(state, e), count);
                                           add(a.after_merge(s.state, e), 1);
                                           next.variants.erase(a.dead);
                                           return next;
                                         });
    if (!search.is_complete())
      throw UsageError(
          "the routes are too complex to prove that each path has exactly one merge vertex, "
          "expected simpler expressions or fewer '@'");
    std::set<std::pair<int, Kind>> reported;
    for (size_t n = 0; n < search.nodes().size(); ++n)
      for (const int l : lights_) {
        const MarkedState& s = search.nodes()[n].state;
        const int route = route_at(s.state, l);
        if (route == kNoRoute || !estimator(route).merges) continue;
        int vertices = 0;
        for (const auto& [state, count] : s.variants)
          if (a.at(state, l) != kNoPart) vertices += count;
        if (vertices == 1) continue;
        const Kind kind = vertices == 0 ? Kind::kNoMergeVertex : Kind::kTwoMergeVertices;
        if (!reported.insert({route, kind}).second) continue;
        const std::string witness = text(search.word(n), l);
        report(kind, true,
               owner_text(route) + " owns " + witness +
                   (vertices == 0
                        ? ", which has no merge vertex: photons need exactly one in each path, "
                          "where '@' stands, or else the first D or G"
                        : ", in which photons would be merged at more than one vertex and their "
                          "light counted more than once: mark exactly one with '@'"),
               witness);
      }
  }

  void find_overlaps() {
    const Automaton& a = in_.matches.automaton;
    const WordSearch<int> search(a.start, events_, SIZE_MAX,
                                 [&](int s, int e) { return a.after(s, e); });
    std::set<std::pair<int, int>> reported;
    const int last = static_cast<int>(in_.routes.size()) - 1;
    for (size_t n = 0; n < search.nodes().size(); ++n)
      for (const int l : lights_) {
        const WordMatches& m = in_.matches.matches[a.at(search.nodes()[n].state, l)];
        const LightKind light = in_.classes.kind_of_light(l);
        const int owner = owner_of(m, in_.routes, light);
        for (const int r : m.routes) {
          if (r <= owner || r == last || !can_reach(in_.routes[r], light, m.touches_hair)) continue;
          if (!reported.insert({owner, r}).second) continue;
          const std::string witness = text(search.word(n), l);
          report(Kind::kOverlap, false,
                 "routes " + name(owner) + " and " + name(r) + " both match " + witness + "; " +
                     name(owner) + ", the first, owns it",
                 witness);
        }
      }
  }

  const ProofInput& in_;
  std::vector<int> events_, lights_;                     ///< classes that can occur
  std::vector<uint16_t> event_symbols_, light_symbols_;  ///< [class]: a symbol that can occur
  bool full_events_ = false, full_lights_ = false;       ///< true if words need sides and labels
  Proof proof_;
};

}  // namespace

Proof prove(const ProofInput& input) {
  return Prover(input).prove();
}

}  // namespace nephroid
