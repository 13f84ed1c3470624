// The useful events of a group's walks: backward reachability over the tables of both directions,
// among the symbols that can occur. It must not know expressions.
#include <algorithm>
#include <map>
#include <utility>

#include "route/routes.h"

namespace nephroid {
namespace {

/// The events that can occur. Events with equal columns in every table share one, and the first of
/// them stands for all.
class EventColumns {
 public:
  EventColumns(const RouteTables& t, const SymbolSet& symbols) : column_of_(t.event_symbols, -1) {
    std::map<std::vector<uint16_t>, int> known;
    for (size_t e = 0; e < t.event_symbols; ++e) {
      if ((e & 7) >= kEventKinds || e >= symbols.events.size() || !symbols.events[e]) continue;
      std::vector<uint16_t> column;
      for (size_t s = 0; s < t.eye_states; ++s)
        column.push_back(t.eye_next[s * t.event_symbols + e]);
      for (size_t s = 0; s < t.eye_states; ++s)
        column.push_back(t.merge_next[s * t.event_symbols + e]);
      for (size_t s = 0; s < t.light_states; ++s)
        column.push_back(t.light_next[s * t.event_symbols + e]);
      const auto [at, is_new] =
          known.try_emplace(std::move(column), static_cast<int>(known.size()));
      if (is_new) firsts_.push_back(static_cast<EventSymbol>(e));
      column_of_[e] = at->second;
    }
  }
  const std::vector<EventSymbol>& firsts() const { return firsts_; }

  /// [state][label]: classes, within `among`, of the possible events with `is_useful(state, first
  /// of its column)`.
  template <class IsUseful>
  std::vector<ClassMask> masks(size_t states, ClassMask among, IsUseful is_useful) const {
    const size_t labels = column_of_.size() / 8;
    std::vector<ClassMask> result(states * labels, ClassMask::kNone);
    std::vector<bool> useful(firsts_.size());
    for (size_t s = 0; s < states; ++s) {
      for (size_t c = 0; c < firsts_.size(); ++c) useful[c] = is_useful(s, firsts_[c]);
      for (size_t e = 0; e < column_of_.size(); ++e)
        if (column_of_[e] >= 0 && useful[column_of_[e]]) {
          ClassMask& mask = result[s * labels + e / 8];
          mask = mask | (mask_of(class_of(kind_of(static_cast<EventSymbol>(e)))) & among);
        }
    }
    return result;
  }

  /// States from which a state in `goals` can be reached by `next`; the goals included.
  std::vector<bool> leading_to(std::vector<bool> goals, const NumberTable& next,
                               size_t event_symbols) const {
    std::vector<std::vector<size_t>> before(goals.size());
    for (size_t s = 0; s < goals.size(); ++s)
      for (const EventSymbol e : firsts_) before[next[s * event_symbols + e]].push_back(s);
    std::vector<size_t> open;
    for (size_t s = 0; s < goals.size(); ++s)
      if (goals[s]) open.push_back(s);
    while (!open.empty()) {
      const size_t s = open.back();
      open.pop_back();
      for (const size_t b : before[s])
        if (!goals[b]) {
          goals[b] = true;
          open.push_back(b);
        }
    }
    return goals;
  }

  /// Eye states that camera walks can reach.
  std::vector<bool> reached_from(EyeState start, const RouteTables& t) const {
    std::vector<bool> reached(t.eye_states);
    std::vector<size_t> open{start};
    reached[start] = true;
    while (!open.empty()) {
      const size_t s = open.back();
      open.pop_back();
      for (const EventSymbol e : firsts_) {
        const size_t n = t.eye_next[s * t.event_symbols + e];
        if (!reached[n]) open.push_back(n);
        reached[n] = true;
      }
    }
    return reached;
  }

 private:
  std::vector<int> column_of_;  ///< [symbol], -1 if it cannot occur
  std::vector<EventSymbol> firsts_;
};

// States with a class in the mask of any label.
std::vector<bool> any_class(const std::vector<ClassMask>& masks, size_t states) {
  std::vector<bool> any(states);
  for (size_t i = 0; i < masks.size(); ++i)
    if (masks[i] != ClassMask::kNone) any[i / (masks.size() / states)] = true;
  return any;
}

constexpr ClassMask kEveryClass = ClassMask::kEvery;

}  // namespace

std::vector<bool> Routes::states_that_meet(size_t group, const std::vector<bool>& reached) const {
  std::vector<bool> may_meet(tables_.light_states);
  for (size_t eye = 0; eye < tables_.eye_states; ++eye)
    for (size_t light = 0; light < tables_.light_states; ++light)
      if (reached[eye] && owns(group, tables_.meet[eye * tables_.light_states + light]))
        may_meet[light] = true;
  return may_meet;
}

void Routes::find_useful_events(const SymbolSet& symbols) {
  const RouteTables& t = tables_;
  const EventColumns events(t, symbols);
  const std::vector<bool> reached = events.reached_from(t.start, t);
  const auto column = [&](size_t state, EventSymbol e) { return state * t.event_symbols + e; };

  // For each event, the distinct states after a merge that camera walks can reach.
  std::map<EventSymbol, std::vector<EyeState>> merged_states;
  for (const EventSymbol e : events.firsts()) {
    std::vector<EyeState>& to = merged_states[e];
    for (size_t s = 0; s < t.eye_states; ++s)
      if (reached[s]) to.push_back(t.merge_next[column(s, e)]);
    std::sort(to.begin(), to.end());
    to.erase(std::unique(to.begin(), to.end()), to.end());
  }

  flags_.clear();
  for (size_t g = 0; g < groups_.size(); ++g) {
    Flags f;
    f.ends.assign(t.eye_states, false);
    for (size_t s = 0; s < t.eye_states; ++s)
      for (size_t l = 0; l < t.light_symbols; ++l)
        if (l < symbols.lights.size() && symbols.lights[l] &&
            owns(g, t.owner[s * t.light_symbols + l]))
          f.ends[s] = true;

    // From the eye.
    const std::vector<bool> may_end = events.leading_to(f.ends, t.eye_next, t.event_symbols);
    f.useful = events.masks(t.eye_states, kEveryClass, [&](size_t s, EventSymbol e) -> bool {
      return may_end[t.eye_next[column(s, e)]];
    });
    f.merges = events.masks(t.eye_states, ClassMask::kRough, [&](size_t s, EventSymbol e) -> bool {
      return may_end[t.merge_next[column(s, e)]];
    });
    const std::vector<bool> may_merge =
        events.leading_to(any_class(f.merges, t.eye_states), t.eye_next, t.event_symbols);
    f.useful_before_merge = events.masks(
        t.eye_states, kEveryClass,
        [&](size_t s, EventSymbol e) -> bool { return may_merge[t.eye_next[column(s, e)]]; });

    // From the light.
    const bool deposits = groups_[g].estimator->merges;
    f.deposits = events.masks(t.light_states, ClassMask::kRough, [&](size_t light, EventSymbol e) {
      if (!deposits) return false;
      for (const EyeState eye : merged_states.at(e))
        if (owns(g, t.meet[eye * t.light_states + light])) return true;
      return false;
    });
    const std::vector<bool> may_deposit =
        events.leading_to(any_class(f.deposits, t.light_states), t.light_next, t.event_symbols);
    f.useful_before_deposit = events.masks(
        t.light_states, kEveryClass,
        [&](size_t s, EventSymbol e) -> bool { return may_deposit[t.light_next[column(s, e)]]; });
    f.needs_specular.assign(t.light_states, false);
    for (size_t light = 0; light < t.light_states; ++light) {
      ClassMask next = ClassMask::kNone;
      for (size_t i = light * label_count(); i < (light + 1) * label_count(); ++i)
        next = next | f.useful_before_deposit[i] | f.deposits[i];
      f.needs_specular[light] = next == ClassMask::kSpecular;
    }
    const std::vector<bool> may_meet = states_that_meet(g, reached);
    f.useful_from_light = events.masks(
        t.light_states, kEveryClass,
        [&](size_t s, EventSymbol e) -> bool { return may_meet[t.light_next[column(s, e)]]; });
    const bool connects = groups_[g].estimator->connects;
    f.connects = events.masks(t.light_states, kEveryClass, [&](size_t light, EventSymbol e) {
      return connects && owns(g, t.meet[t.eye_next[column(t.start, e)] * t.light_states + light]);
    });
    const std::vector<bool> may_connect =
        events.leading_to(any_class(f.connects, t.light_states), t.light_next, t.event_symbols);
    f.useful_before_connection = events.masks(
        t.light_states, kEveryClass,
        [&](size_t s, EventSymbol e) -> bool { return may_connect[t.light_next[column(s, e)]]; });
    flags_.push_back(std::move(f));
  }
}

}  // namespace nephroid
