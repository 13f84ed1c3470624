// Subset construction (Rabin & Scott 1959) over all routes and AOVs, with and without their marks.
// A state is a set of places in expressions, with two flags: a mark was read, hair was read.
#include <algorithm>
#include <map>
#include <utility>

#include "core/errors.h"
#include "route/automaton.h"

namespace nephroid {
namespace {

constexpr size_t kMaxDfaStates = 65535;
constexpr size_t kMaxPlaces = size_t{1} << 22;  // in all states together

class SubsetConstruction {
 public:
  SubsetConstruction(const Nfa& nfa, const SymbolClasses& classes, const ExpressionCopies& copies)
      : nfa_(nfa), classes_(classes), copies_(copies), stamps_(nfa.states.size(), 0) {}

  MatchAutomaton build() {
    Automaton& a = result_.automaton;
    a.events = classes_.events.size();
    a.lights = classes_.lights.size();
    a.start = number(start_set());
    a.dead = number({true, false, {}});
    for (size_t s = 0; s < states_.size(); ++s) {
      const Subset subset = states_[s]->first;
      for (size_t e = 0; e < a.events; ++e) {
        a.next.push_back(number(after(subset, e, false)));
        const bool can_merge =
            contains(ClassMask::kRough, classes_.class_of_event(static_cast<int>(e)));
        a.merge_next.push_back(can_merge && !subset.is_marked ? number(after(subset, e, true))
                                                              : a.dead);
      }
      for (size_t l = 0; l < a.lights; ++l) a.output.push_back(output(subset, l));
    }
    return std::move(result_);
  }

 private:
  struct Subset {
    bool is_marked = false;
    bool touches_hair = false;
    std::vector<int> places;  ///< states with an atom, in order
    auto operator<=>(const Subset&) const = default;
  };
  using Known = std::map<Subset, int>;

  bool obeys_marks(int copy) const { return static_cast<size_t>(copy) >= copies_.first_marked(); }

  // Adds all places that can be reached from `state` without reading.
  void add_closure(int state, std::vector<int>& places) {
    if (state == Nfa::kNone || stamps_[state] == stamp_) return;
    open_.push_back(state);
    while (!open_.empty()) {
      const int s = open_.back();
      open_.pop_back();
      if (s == Nfa::kNone || stamps_[s] == stamp_) continue;
      stamps_[s] = stamp_;
      const Nfa::State& state_of_s = nfa_.states[s];
      const bool accepts = nfa_.accepts[state_of_s.copy] == s;
      if (state_of_s.atom != Nfa::kNone || accepts) {
        places.push_back(s);
      } else {
        open_.push_back(state_of_s.next);
        open_.push_back(state_of_s.other);
      }
    }
  }

  Subset start_set() {
    Subset start, before_eye;
    ++stamp_;
    for (const int s : nfa_.starts) add_closure(s, before_eye.places);
    ++stamp_;
    for (const int s : before_eye.places) {
      const Nfa::State& state = nfa_.states[s];
      if (state.atom != Nfa::kNone && classes_.reads_eye[state.atom])
        add_closure(state.next, start.places);
    }
    std::sort(start.places.begin(), start.places.end());
    return start;
  }

  Subset after(const Subset& subset, size_t event, bool merge) {
    const bool is_hair = classes_.class_of_event(static_cast<int>(event)) == EventClass::kHair;
    Subset result{subset.is_marked || merge, subset.touches_hair || is_hair, {}};
    ++stamp_;
    for (const int s : subset.places) {
      const Nfa::State& state = nfa_.states[s];
      if (state.atom == Nfa::kNone) continue;
      const auto atom = static_cast<size_t>(state.atom);
      if (!classes_.reads_event[atom][event]) continue;
      if (obeys_marks(state.copy) && nfa_.atoms[atom]->merges != merge) continue;
      add_closure(state.next, result.places);
    }
    // After a mark only copies that obey marks count.
    const auto obeys = [&](int s) { return obeys_marks(nfa_.states[s].copy); };
    if (result.is_marked && std::none_of(result.places.begin(), result.places.end(), obeys))
      result = {true, false, {}};
    std::sort(result.places.begin(), result.places.end());
    return result;
  }

  int number(Subset subset) {
    const size_t places = subset.places.size();
    const auto [at, is_new] =
        known_.try_emplace(std::move(subset), static_cast<int>(states_.size()));
    if (is_new) {
      states_.push_back(at);
      places_ += places;
      if (states_.size() > kMaxDfaStates || places_ > kMaxPlaces)
        throw UsageError("the routes are too complex: their automaton has more than " +
                         std::to_string(states_.size() - 1) +
                         " states, expected expressions with fewer counted repetitions");
    }
    return at->second;
  }

  // The index of the matches of the word that ends after `subset` with a light.
  int output(const Subset& subset, size_t light) {
    ++stamp_;
    std::vector<int> behind;
    for (const int s : subset.places) {
      const Nfa::State& state = nfa_.states[s];
      if (state.atom != Nfa::kNone && classes_.reads_light[state.atom][light])
        add_closure(state.next, behind);
    }
    std::vector<bool> accepted(nfa_.copies());
    for (const int s : behind) {
      const auto copy = static_cast<size_t>(nfa_.states[s].copy);
      if (nfa_.accepts[copy] == s) accepted[copy] = true;
    }
    WordMatches m;
    m.is_marked = subset.is_marked;
    m.touches_hair = subset.touches_hair;
    for (size_t i = 0; i < copies_.routes; ++i) {
      if (accepted[i]) m.routes.push_back(static_cast<int>(i));
      const int marked = copies_.marked_copy[i];
      if (subset.is_marked && marked >= 0 && accepted[marked])
        m.marked_by.push_back(static_cast<int>(i));
    }
    for (size_t i = 0; i < copies_.aovs; ++i)
      if (accepted[copies_.routes + i]) m.aovs.push_back(static_cast<int>(i));
    const auto [at, is_new] =
        known_matches_.try_emplace(m, static_cast<int>(result_.matches.size()));
    if (is_new) result_.matches.push_back(std::move(m));
    return at->second;
  }

  const Nfa& nfa_;
  const SymbolClasses& classes_;
  const ExpressionCopies& copies_;
  std::vector<uint32_t> stamps_;  ///< [state]: the closure that found it last
  uint32_t stamp_ = 0;
  std::vector<int> open_;
  Known known_;
  std::vector<Known::const_iterator> states_;
  size_t places_ = 0;
  std::map<WordMatches, int> known_matches_;
  MatchAutomaton result_;
};

}  // namespace

MatchAutomaton determinise(const Nfa& nfa, const SymbolClasses& classes,
                           const ExpressionCopies& copies) {
  return SubsetConstruction(nfa, classes, copies).build();
}

}  // namespace nephroid
