// Minimisation: refines the partition of states until successors agree (Moore 1956).
#include <map>

#include "route/automaton.h"

namespace nephroid {
namespace {

// Numbers the distinct rows that `append_row(state, row)` writes.
template <class AppendRow>
int number_rows(size_t states, AppendRow append_row, std::vector<int>& numbers) {
  std::map<std::vector<int>, int> known;
  std::vector<int> row;
  for (size_t s = 0; s < states; ++s) {
    row.clear();
    append_row(static_cast<int>(s), row);
    numbers[s] = known.try_emplace(row, static_cast<int>(known.size())).first->second;
  }
  return static_cast<int>(known.size());
}

std::vector<int> equivalence_classes(const Automaton& a) {
  const int events = static_cast<int>(a.events), lights = static_cast<int>(a.lights);
  std::vector<int> block(a.states()), refined(a.states());
  int count = number_rows(
      a.states(),
      [&](int s, std::vector<int>& row) {
        for (int l = 0; l < lights; ++l) row.push_back(a.at(s, l));
      },
      block);
  for (;;) {
    const int finer = number_rows(
        a.states(),
        [&](int s, std::vector<int>& row) {
          row.push_back(block[s]);
          for (int e = 0; e < events; ++e) {
            row.push_back(block[a.after(s, e)]);
            row.push_back(block[a.after_merge(s, e)]);
          }
        },
        refined);
    block.swap(refined);
    if (finer == count) return block;
    count = finer;
  }
}

}  // namespace

Automaton minimise(const Automaton& a) {
  const std::vector<int> block = equivalence_classes(a);
  Automaton m;
  m.events = a.events;
  m.lights = a.lights;
  // Blocks in breadth-first order; each is read from its first state found.
  constexpr int kUnknown = -1;
  std::vector<int> number(a.states(), kUnknown);
  std::vector<int> found;
  const auto number_of = [&](int state) {
    int& n = number[block[state]];
    if (n == kUnknown) {
      n = static_cast<int>(found.size());
      found.push_back(state);
    }
    return n;
  };
  m.start = number_of(a.start);
  for (size_t i = 0; i < found.size(); ++i) {
    const int s = found[i];
    for (int e = 0; e < static_cast<int>(a.events); ++e) m.next.push_back(number_of(a.after(s, e)));
    for (int e = 0; e < static_cast<int>(a.events); ++e)
      m.merge_next.push_back(number_of(a.after_merge(s, e)));
    for (int l = 0; l < static_cast<int>(a.lights); ++l) m.output.push_back(a.at(s, l));
  }
  m.dead = number_of(a.dead);
  return m;
}

}  // namespace nephroid
