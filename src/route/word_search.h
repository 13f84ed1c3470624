// Breadth-first search over the words of an automaton: the first word found is a shortest one. It
// must not know the goal of the search.
#pragma once

#include <algorithm>
#include <map>
#include <span>
#include <utility>
#include <vector>

namespace nephroid {

/// All states that words lead to, in the order of word length. `State` must have an ordering.
template <class State>
class WordSearch {
 public:
  struct Node {
    State state;
    int parent = -1;
    int event = -1;  ///< event from the parent to here
  };

  /// `step(state, event)` is the state after one more event. Stops at `most` nodes; is_complete()
  /// is then false.
  template <class Step>
  WordSearch(State start, std::span<const int> events, size_t most, Step step) {
    add(std::move(start), -1, -1);
    for (size_t i = 0; i < nodes_.size(); ++i)
      for (const int e : events) {
        if (nodes_.size() >= most) {
          is_complete_ = false;
          return;
        }
        add(step(nodes_[i].state, e), static_cast<int>(i), e);
      }
  }

  const std::vector<Node>& nodes() const { return nodes_; }
  bool is_complete() const { return is_complete_; }
  /// The events of a shortest word to a node.
  std::vector<int> word(size_t node) const {
    std::vector<int> events;
    for (int i = static_cast<int>(node); nodes_[i].parent >= 0; i = nodes_[i].parent)
      events.push_back(nodes_[i].event);
    std::reverse(events.begin(), events.end());
    return events;
  }

 private:
  void add(State state, int parent, int event) {
    if (!known_.insert({state, static_cast<int>(nodes_.size())}).second) return;
    nodes_.push_back({std::move(state), parent, event});
  }
  std::vector<Node> nodes_;
  std::map<State, int> known_;
  bool is_complete_ = true;
};

}  // namespace nephroid
