// A simple second implementation of light path expressions: trees that are built, not parsed, and
// three matchers. One tries all ways to split the word, one uses std::regex, one carries sets of
// positions (Glushkov 1961). oracle_test.cpp compares them. It must not use src/route except for
// its numbering of kinds.
#pragma once

#include <bitset>
#include <cstdint>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include "route/symbols.h"

namespace nephroid::oracle {

/// A letter of a word as a small number: C, then events, then marked events (photons are merged
/// there), then lights. Each exists for every label; label 0, any other name, comes first.
using Letter = int;

/// `labels`: number of names that expressions may mention.
class Alphabet {
 public:
  explicit Alphabet(int labels) : labels_(labels + 1) {}
  int labels() const { return labels_; }  ///< number of labels, including label 0
  int events() const { return kEventKinds * labels_; }
  int lights() const { return kLightKinds * labels_; }
  int size() const { return 1 + 2 * events() + lights(); }

  Letter eye() const { return 0; }
  Letter event(int i, bool marked = false) const { return 1 + i + (marked ? events() : 0); }
  Letter event(EventKind kind, int label, bool marked = false) const {
    return event(label * kEventKinds + static_cast<int>(kind), marked);
  }
  Letter light(int i) const { return 1 + 2 * events() + i; }
  Letter light(LightKind kind, int label) const {
    return light(label * kLightKinds + static_cast<int>(kind));
  }

  EventKind event_kind(int i) const { return static_cast<EventKind>(i % kEventKinds); }
  LightKind light_kind(int i) const { return static_cast<LightKind>(i % kLightKinds); }
  int event_label(int i) const { return i / kEventKinds; }
  int light_label(int i) const { return i / kLightKinds; }

 private:
  int labels_;
};

/// The letters that one place in an expression matches, and its text.
struct Atom {
  std::string text;
  bool eye = false;
  unsigned events = 0;  ///< one bit per EventKind
  unsigned lights = 0;  ///< one bit per LightKind
  int label = -1;       ///< -1: any
  bool marked = false;  ///< photons are merged here, so only D and G

  /// Whether marks in expressions and words are ignored or obeyed.
  enum class Marks { kIgnore, kObey };
  bool matches(const Alphabet& alphabet, Letter letter, Marks marks) const;
};

/// Bits of all event kinds, of D and G, and of all light kinds.
inline constexpr unsigned kAllEvents = 0xff, kRoughEvents = 0x0f, kAllLights = 0x1f;

struct Tree {
  enum class Kind { kAtom, kSequence, kChoice, kRepeat };
  Kind kind = Kind::kAtom;
  Atom atom;
  std::vector<Tree> parts;
  int least = 0, most = -1;  ///< bounds of a repetition; -1: unbounded

  static Tree of(Atom atom);
  static Tree sequence(std::vector<Tree> parts);
  static Tree choice(std::vector<Tree> parts);
  static Tree repeat(Tree part, int least, int most);

  /// The notation of light path expressions.
  std::string text() const;
  bool has_marks() const;
};

using Word = std::vector<Letter>;

/// Tries all ways to split the word, which has at most 30 letters.
bool matches_by_cutting(const Tree& tree, const Alphabet& alphabet, const Word& word,
                        Atom::Marks marks);

/// The tree as an ECMAScript regular expression over the characters of character_of().
std::string ecmascript(const Tree& tree, const Alphabet& alphabet, Atom::Marks marks);
/// For alphabets of up to 62 letters.
char character_of(Letter letter);

/// Carries the set of places in an expression that a word can have reached. Sets are numbered as
/// they occur, so that brute force over many words is cheap.
class Machine {
 public:
  /// At most 256 places, counted after {n,m} is expanded.
  Machine(const Tree& tree, const Alphabet& alphabet, Atom::Marks marks);

  using State = int;
  State start() const { return 0; }
  State step(State state, Letter letter);
  bool accepts(State state) const { return accepts_[static_cast<size_t>(state)]; }
  bool accepts(const Word& word);
  /// True if an unmarked word C e1 ... en l matches.
  bool matches_any_path() const;

 private:
  using Places = std::bitset<257>;  // place 0 is before the word
  struct Ends {
    Places first, last;
    bool nullable = false;
  };
  Ends add(const Tree& tree);
  State number(const Places& places);

  Alphabet alphabet_;
  Atom::Marks marks_;
  std::vector<Places> follow_;   // [place]
  std::vector<Places> letters_;  // [letter]: places that match it
  Places last_;
  std::vector<Places> sets_;  // [state]
  std::vector<bool> accepts_;
  std::vector<std::vector<State>> steps_;  // [state][letter], -1: not computed yet
  std::unordered_map<Places, State> numbers_;
};

}  // namespace nephroid::oracle
