// Plain matchers of light path expressions; see oracle.h.
#include "routes/oracle.h"

#include <stdexcept>
#include <utility>

namespace nephroid::oracle {

bool Atom::matches(const Alphabet& alphabet, Letter letter, Marks marks) const {
  if (letter == alphabet.eye()) return eye && !marked;
  int i = letter - 1;
  if (i < 2 * alphabet.events()) {
    const bool merged = i >= alphabet.events();
    if (merged) i -= alphabet.events();
    if (marks == Marks::kIgnore ? merged : merged != marked) return false;
    const unsigned allowed = marked ? events & kRoughEvents : events;
    return (allowed >> static_cast<int>(alphabet.event_kind(i)) & 1u) != 0 &&
           (label < 0 || label == alphabet.event_label(i));
  }
  i -= 2 * alphabet.events();
  return !marked && (lights >> static_cast<int>(alphabet.light_kind(i)) & 1u) != 0 &&
         (label < 0 || label == alphabet.light_label(i));
}

Tree Tree::of(Atom atom) {
  Tree tree;
  tree.atom = std::move(atom);
  return tree;
}

Tree Tree::sequence(std::vector<Tree> parts) {
  Tree tree;
  tree.kind = Kind::kSequence;
  tree.parts = std::move(parts);
  return tree;
}

Tree Tree::choice(std::vector<Tree> parts) {
  Tree tree;
  tree.kind = Kind::kChoice;
  tree.parts = std::move(parts);
  return tree;
}

Tree Tree::repeat(Tree part, int least, int most) {
  Tree tree;
  tree.kind = Kind::kRepeat;
  tree.parts.push_back(std::move(part));
  tree.least = least;
  tree.most = most;
  return tree;
}

std::string Tree::text() const {
  std::string out;
  switch (kind) {
    case Kind::kAtom:
      return atom.text + (atom.marked ? "@" : "");
    case Kind::kSequence:
      for (const Tree& part : parts)
        out += part.kind == Kind::kChoice ? "(" + part.text() + ")" : part.text();
      return out;
    case Kind::kChoice:
      for (const Tree& part : parts) out += (out.empty() ? "" : "|") + part.text();
      return out;
    case Kind::kRepeat:
      out = parts[0].kind == Kind::kAtom ? parts[0].text() : "(" + parts[0].text() + ")";
      if (least == 0 && most < 0) return out + "*";
      if (least == 1 && most < 0) return out + "+";
      if (least == 0 && most == 1) return out + "?";
      out += "{" + std::to_string(least);
      if (most < 0) out += ",";
      if (most > least) out += "," + std::to_string(most);
      return out + "}";
  }
  return out;
}

bool Tree::has_marks() const {
  bool marks = kind == Kind::kAtom && atom.marked;
  for (const Tree& part : parts) marks = marks || part.has_marks();
  return marks;
}

namespace {

/// The places (one bit each) at which a match of `tree` that begins at place i can end.
uint32_t ends(const Tree& tree, const Alphabet& alphabet, const Word& word, size_t i,
              Atom::Marks marks) {
  const auto after = [&](const Tree& part, uint32_t starts) {
    uint32_t result = 0;
    for (size_t k = 0; k <= word.size(); ++k)
      if ((starts >> k & 1u) != 0) result |= ends(part, alphabet, word, k, marks);
    return result;
  };
  uint32_t result = 0;
  switch (tree.kind) {
    case Tree::Kind::kAtom:
      return i < word.size() && tree.atom.matches(alphabet, word[i], marks) ? 2u << i : 0u;
    case Tree::Kind::kSequence:
      result = 1u << i;
      for (const Tree& part : tree.parts) result = after(part, result);
      return result;
    case Tree::Kind::kChoice:
      for (const Tree& part : tree.parts) result |= ends(part, alphabet, word, i, marks);
      return result;
    case Tree::Kind::kRepeat: {
      uint32_t here = 1u << i;
      for (int n = 0; n < tree.least; ++n) here = after(tree.parts[0], here);
      result = here;
      // More repetitions than letters find nothing new.
      const int turns = tree.most < 0 ? static_cast<int>(word.size()) : tree.most - tree.least;
      for (int n = 0; n < turns; ++n) result |= here = after(tree.parts[0], here);
      return result;
    }
  }
  return result;
}

}  // namespace

bool matches_by_cutting(const Tree& tree, const Alphabet& alphabet, const Word& word,
                        Atom::Marks marks) {
  return (ends(tree, alphabet, word, 0, marks) >> word.size() & 1u) != 0;
}

char character_of(Letter letter) {
  if (letter < 26) return static_cast<char>('A' + letter);
  return static_cast<char>(letter < 52 ? 'a' + letter - 26 : '0' + letter - 52);
}

std::string ecmascript(const Tree& tree, const Alphabet& alphabet, Atom::Marks marks) {
  std::string out;
  switch (tree.kind) {
    case Tree::Kind::kAtom:
      for (Letter letter = 0; letter < alphabet.size(); ++letter)
        if (tree.atom.matches(alphabet, letter, marks)) out += character_of(letter);
      return out.empty() ? "!" : "[" + out + "]";  // no word contains a !
    case Tree::Kind::kSequence:
      for (const Tree& part : tree.parts) out += ecmascript(part, alphabet, marks);
      return "(?:" + out + ")";
    case Tree::Kind::kChoice:
      for (const Tree& part : tree.parts)
        out += (out.empty() ? "" : "|") + ecmascript(part, alphabet, marks);
      return "(?:" + out + ")";
    case Tree::Kind::kRepeat:
      out = "(?:" + ecmascript(tree.parts[0], alphabet, marks) + ")";
      return out + "{" + std::to_string(tree.least) + "," +
             (tree.most < 0 ? "" : std::to_string(tree.most)) + "}";
  }
  return out;
}

Machine::Machine(const Tree& tree, const Alphabet& alphabet, Atom::Marks marks)
    : alphabet_(alphabet), marks_(marks), follow_(1), letters_(size_t(alphabet.size())) {
  const Ends whole = add(tree);
  follow_[0] = whole.first;
  last_ = whole.last;
  if (whole.nullable) last_.set(0);
  number(Places(1));
}

Machine::Ends Machine::add(const Tree& tree) {
  Ends all;
  const auto append = [&](const Ends& next) {
    for (size_t p = 1; p < follow_.size(); ++p)
      if (all.last[p]) follow_[p] |= next.first;
    if (all.nullable) all.first |= next.first;
    all.last = next.nullable ? all.last | next.last : next.last;
    all.nullable = all.nullable && next.nullable;
  };
  switch (tree.kind) {
    case Tree::Kind::kAtom: {
      const size_t place = follow_.size();
      if (place >= all.first.size()) throw std::length_error("too many places for the oracle");
      follow_.emplace_back();
      for (Letter letter = 0; letter < alphabet_.size(); ++letter)
        if (tree.atom.matches(alphabet_, letter, marks_)) letters_[size_t(letter)].set(place);
      all.first.set(place);
      all.last.set(place);
      break;
    }
    case Tree::Kind::kSequence:
      all.nullable = true;
      for (const Tree& part : tree.parts) append(add(part));
      break;
    case Tree::Kind::kChoice:
      for (const Tree& part : tree.parts) {
        const Ends e = add(part);
        all.first |= e.first;
        all.last |= e.last;
        all.nullable = all.nullable || e.nullable;
      }
      break;
    case Tree::Kind::kRepeat: {
      // x{2,4} is x x x? x?, x{2,} is x x x*: each copy has its own places.
      all.nullable = true;
      for (int n = 0; n < tree.least; ++n) append(add(tree.parts[0]));
      for (int n = tree.least; n < (tree.most < 0 ? tree.least + 1 : tree.most); ++n) {
        Ends more = add(tree.parts[0]);
        more.nullable = true;
        if (tree.most < 0)
          for (size_t p = 1; p < follow_.size(); ++p)
            if (more.last[p]) follow_[p] |= more.first;
        append(more);
      }
      break;
    }
  }
  return all;
}

Machine::State Machine::number(const Places& places) {
  const auto [it, is_new] = numbers_.emplace(places, static_cast<State>(sets_.size()));
  if (is_new) {
    sets_.push_back(places);
    accepts_.push_back((places & last_).any());
    steps_.emplace_back(letters_.size(), -1);
  }
  return it->second;
}

Machine::State Machine::step(State state, Letter letter) {
  const State known = steps_[size_t(state)][size_t(letter)];
  if (known >= 0) return known;
  Places next;
  for (size_t p = 0; p < follow_.size(); ++p)
    if (sets_[size_t(state)][p]) next |= follow_[p];
  const State result = number(next & letters_[size_t(letter)]);
  return steps_[size_t(state)][size_t(letter)] = result;
}

bool Machine::accepts(const Word& word) {
  State state = start();
  for (const Letter letter : word) state = step(state, letter);
  return accepts(state);
}

bool Machine::matches_any_path() const {
  const auto after = [&](const Places& from, Letter first, Letter end) {
    Places next, allowed;
    for (size_t p = 0; p < follow_.size(); ++p)
      if (from[p]) next |= follow_[p];
    for (Letter letter = first; letter < end; ++letter) allowed |= letters_[size_t(letter)];
    return next & allowed;
  };
  Places reached = after(Places(1), alphabet_.eye(), alphabet_.eye() + 1);
  for (Places before; before != reached;) {
    before = reached;
    reached |= after(reached, alphabet_.event(0), alphabet_.event(0) + alphabet_.events());
  }
  return (after(reached, alphabet_.light(0), alphabet_.size()) & last_).any();
}

}  // namespace nephroid::oracle
