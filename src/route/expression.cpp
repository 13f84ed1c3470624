// A recursive descent parser of light path expressions: each function reads the part in its name
// and leaves at_ after it. It must not know automata or scenes.
#include "route/expression.h"

#include <algorithm>
#include <cctype>

#include "route/expression_error.h"

namespace nephroid {
namespace {

constexpr int kMaxRepetitions = 64;
constexpr int kDeepestGroup = 64;

constexpr unsigned bit(EventKind k) {
  return 1u << static_cast<int>(k);
}
constexpr unsigned bit(LightKind k) {
  return 1u << static_cast<int>(k);
}
constexpr unsigned kD = bit(EventKind::kDR) | bit(EventKind::kDT);
constexpr unsigned kG = bit(EventKind::kGR) | bit(EventKind::kGT);
constexpr unsigned kS = bit(EventKind::kSR) | bit(EventKind::kST);
constexpr unsigned kR = bit(EventKind::kDR) | bit(EventKind::kGR) | bit(EventKind::kSR);
constexpr unsigned kT = bit(EventKind::kDT) | bit(EventKind::kGT) | bit(EventKind::kST);
constexpr unsigned kV = bit(EventKind::kV);
constexpr unsigned kH = bit(EventKind::kH);
constexpr unsigned kAnyLight = (1u << kLightKinds) - 1;
constexpr char kLetters[] = "C, D, G, S, R, T, V, H, L, O, B or M";

unsigned lights_of(char letter) {
  switch (letter) {
    case 'L':
      return kAnyLight;
    case 'O':
      return bit(LightKind::kShape);
    case 'B':
      return bit(LightKind::kEnvironment) | bit(LightKind::kDistant);
    case 'M':
      return bit(LightKind::kMedium);
    default:
      return 0;
  }
}
unsigned class_bits(char letter) {
  return letter == 'D' ? kD : letter == 'G' ? kG : letter == 'S' ? kS : 0;
}
unsigned side_bits(char letter) {
  return letter == 'R' ? kR : letter == 'T' ? kT : 0;
}
// Bits of events without a side.
unsigned sideless_bits(char letter) {
  return letter == 'V' ? kV : letter == 'H' ? kH : 0;
}
unsigned events_of(char letter) {
  return class_bits(letter) | side_bits(letter) | sideless_bits(letter);
}

class Parser {
 public:
  Parser(const std::string& text, const ExpressionSource& source) : text_(text), source_(source) {}

  Expression parse() {
    if (skip_spaces() == '\0') fail("expected an expression such as C.*L, found " + found());
    Expression e = choice(0);
    if (at_ < text_.size()) {
      if (text_[at_] == ')') fail("found ')' without a '(' before it");
      fail("expected a letter, a set, a group or the end, found " + found());
    }
    return e;
  }

 private:
  [[noreturn]] void fail(const std::string& message) const { fail_at(at_, message); }
  [[noreturn]] void fail_at(size_t at, const std::string& message) const {
    throw expression_error(source_, source_.column + at, message);
  }
  std::string found() const { return found_text(text_, at_, "the end of the expression"); }

  char skip_spaces() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
    return at_ < text_.size() ? text_[at_] : '\0';
  }
  bool take(char c) {
    if (skip_spaces() != c || at_ >= text_.size()) return false;
    ++at_;
    return true;
  }

  Expression choice(int depth) {
    Expression e{.kind = Expression::Kind::kChoice, .atom = {}, .parts = {}};
    e.parts.push_back(sequence(depth));
    while (take('|')) e.parts.push_back(sequence(depth));
    return e.parts.size() == 1 ? Expression(std::move(e.parts[0])) : e;
  }

  Expression sequence(int depth) {
    Expression e{.kind = Expression::Kind::kSequence, .atom = {}, .parts = {}};
    for (char c = skip_spaces(); at_ < text_.size() && c != '|' && c != ')'; c = skip_spaces())
      e.parts.push_back(repeated(depth));
    if (e.parts.empty()) {
      if (depth > 0 && at_ > 0 && text_[at_ - 1] == '(' && skip_spaces() == ')')
        fail("expected an expression between '(' and ')', found an empty group");
      fail("expected an alternative: a letter, a set or a group, found " + found());
    }
    return e.parts.size() == 1 ? Expression(std::move(e.parts[0])) : e;
  }

  // An atom or a group and at most one quantifier.
  Expression repeated(int depth) {
    const char first = skip_spaces();
    if (first == '*' || first == '+' || first == '?' || first == '{')
      fail("expected a letter, a set or a group to repeat, found the quantifier " + found());
    if (first == '@')
      fail("'@' marks nothing here, expected it directly after a letter or set, as in D@");
    Expression e = first == '(' ? group(depth) : marked_atom();
    const char next = skip_spaces();
    int least = 0, most = Expression::kUnbounded;
    if (next == '*') {
      ++at_;
    } else if (next == '+') {
      least = 1, ++at_;
    } else if (next == '?') {
      most = 1, ++at_;
    } else if (next == '{') {
      read_bounds(least, most);
    } else {
      return e;
    }
    const char after = skip_spaces();
    if (after == '@') fail("'@' stands after the quantifier, expected it before, as in D@+");
    if (after == '*' || after == '+' || after == '?' || after == '{')
      fail("expected one quantifier, found another, " + found() + "; use a group: (S+)?");
    Expression repetition{.kind = Expression::Kind::kRepeat, .atom = {}, .parts = {}};
    repetition.parts.push_back(std::move(e));
    repetition.least = least;
    repetition.most = most;
    return repetition;
  }

  Expression group(int depth) {
    const size_t open = at_++;
    if (depth >= kDeepestGroup)
      fail_at(open,
              "expected at most " + std::to_string(kDeepestGroup) + " nested groups, found more");
    Expression e = choice(depth + 1);
    if (!take(')'))
      fail("expected ')' for the '(' at column " + column(open) + ", found " + found());
    if (skip_spaces() == '@')
      fail("'@' marks one letter or set, not a group: write it inside, as in (D@S)");
    return e;
  }
  std::string column(size_t at) const { return std::to_string(source_.column + at + 1); }

  // {n}, {n,} or {n,m}
  void read_bounds(int& least, int& most) {
    const size_t open = at_++;
    least = most = number();
    if (take(',')) most = skip_spaces() == '}' ? Expression::kUnbounded : number();
    if (!take('}'))
      fail("expected '}' for the '{' at column " + column(open) + ", found " + found());
    if (most != Expression::kUnbounded && most < least)
      fail_at(open, "the minimum " + std::to_string(least) + " is above the maximum " +
                        std::to_string(most) + ", expected {min,max}");
  }
  int number() {
    skip_spaces();
    const size_t begin = at_;
    int n = 0;
    for (; at_ < text_.size() && text_[at_] >= '0' && text_[at_] <= '9'; ++at_)
      n = std::min(10 * n + (text_[at_] - '0'), kMaxRepetitions + 1);
    if (at_ == begin)
      fail("expected a number of repetitions, as in {2} or {1,3}, found " + found());
    if (n > kMaxRepetitions)
      fail_at(begin, "expected at most " + std::to_string(kMaxRepetitions) +
                         " repetitions; * has no limit");
    return n;
  }

  Expression marked_atom() {
    const size_t begin = at_;
    Expression e;
    e.atom = atom();
    if (skip_spaces() != '@') return e;
    const unsigned events = possible_events(e.atom);
    if ((events & (kD | kG)) == 0)
      fail_at(begin, "photons can only be merged at D and G; " + text_.substr(begin, at_ - begin) +
                         "@ has neither");
    ++at_;
    e.atom.merges = true;
    if (skip_spaces() == '@') fail("expected one '@' here, found two");
    return e;
  }
  // Kinds of events that an atom may match with some label.
  static unsigned possible_events(const ExpressionAtom& atom) {
    unsigned events = 0;
    for (const SymbolPattern& p : atom.any_of)
      if (!atom.negated || p.label.empty()) events |= p.events;
    return atom.negated ? ~events : events;
  }

  ExpressionAtom atom() {
    const char c = skip_spaces();
    ExpressionAtom a;
    if (c == '[') return letter_set();
    if (c == '<') {
      a.any_of.push_back(bracket());
    } else if (c == '.') {
      ++at_;
      a.negated = true;  // any symbol: the negation of the empty set
    } else {
      a.any_of.push_back(letter("a letter, a set or a group"));
    }
    return a;
  }

  SymbolPattern letter(const char* expected) {
    const char c = skip_spaces();
    SymbolPattern p;
    p.eye = c == 'C';
    p.events = events_of(c);
    p.lights = lights_of(c);
    if (!p.eye && p.events == 0 && p.lights == 0) {
      if (c == '\'')
        fail("the label has no angle brackets, expected it as in <L.'key'> or <..'glass'>");
      if (c == ']' || c == '>' || c == '}') fail("expected an opening bracket before " + found());
      fail("expected " + std::string(expected) + " (letters are " + kLetters + "), found " +
           found());
    }
    ++at_;
    return p;
  }

  // [DG], [^S], [D<TS'glass'>]
  ExpressionAtom letter_set() {
    const size_t open = at_++;
    ExpressionAtom a;
    a.negated = take('^');
    while (skip_spaces() != ']') {
      if (at_ >= text_.size())
        fail("expected ']' after the letters of a set, found the end of the expression");
      if (text_[at_] == '.')
        fail("'.' means any symbol and cannot stand in a set, expected letters");
      if (text_[at_] == '^') fail("'^' stands inside the set, expected it first, as in [^DG]");
      if (text_[at_] == '[' || text_[at_] == '(' || text_[at_] == '|')
        fail("expected ']' after the letters of a set, found " + found());
      a.any_of.push_back(text_[at_] == '<' ? bracket() : letter("']' or a letter of the set"));
    }
    if (a.any_of.empty()) fail("expected letters between '[' and ']', found an empty set");
    ++at_;
    if (a.negated && excludes_everything(a))
      fail_at(open, "this set excludes every symbol, expected at least one that is left");
    return a;
  }
  static bool excludes_everything(const ExpressionAtom& a) {
    SymbolPattern all;
    for (const SymbolPattern& p : a.any_of)
      if (p.label.empty()) {
        all.events |= p.events;
        all.lights |= p.lights;
        all.eye = all.eye || p.eye;
      }
    return all.eye && all.lights == kAnyLight && all.events == (1u << kEventKinds) - 1;
  }

  // <RD>, <.[DG]'wall'>, <V'fog'>, <L.'key'>, <..'glass'>
  SymbolPattern bracket() {
    const size_t open = at_++;
    SymbolPattern p;
    const char c = skip_spaces();
    if (sideless_bits(c) != 0 || lights_of(c) != 0) {
      p.events = sideless_bits(c);
      p.lights = lights_of(c);
      ++at_;
      take('.');
    } else if (c == 'C') {
      fail("the eye has no sides and no labels: write C without '<'");
    } else {
      p.events = side_and_class();
    }
    if (take('\'')) p.label = label();
    if (!take('>'))
      fail("expected a label or '>' for the '<' at column " + column(open) + ", found " + found() +
           (p.label.empty() && begins_label() ? " (did the shell take the quotes?)" : ""));
    return p;
  }
  unsigned side_and_class() {
    if (class_bits(skip_spaces()) != 0)
      fail("expected the side, R, T or '.', found " + found() +
           "; the class follows it, as in <RD>");
    const bool any_side = text_.compare(at_, 1, ".") == 0;
    const unsigned side = one_or_set(&side_bits, "the side: R, T, '.' or a set of them");
    if (const char c = skip_spaces(); sideless_bits(c) != 0)
      fail(std::string{c} + " has no side: write " + c + " or <" + c + "'label'>");
    const bool any_class = text_.compare(std::min(at_, text_.size()), 1, ".") == 0;
    const unsigned classes = one_or_set(&class_bits, "the class: D, G, S, '.' or a set of them");
    return any_side && any_class ? kR | kT | kV | kH : side & classes;
  }
  unsigned one_or_set(unsigned (*bits)(char), const char* expected) {
    const char c = skip_spaces();
    if (c == '.') {
      ++at_;
      return kR | kT;
    }
    if (c != '[') {
      if (bits(c) == 0) fail("expected " + std::string(expected) + ", found " + found());
      ++at_;
      return bits(c);
    }
    ++at_;
    const bool negated = take('^');
    unsigned all = 0;
    for (; skip_spaces() != ']'; ++at_) {
      if (at_ >= text_.size() || bits(text_[at_]) == 0)
        fail("expected ']' or a letter of " + std::string(expected) + ", found " + found());
      all |= bits(text_[at_]);
    }
    if (negated) all = (kR | kT) & ~all;
    if (all == 0) fail("expected a letter of " + std::string(expected) + ", found an empty set");
    ++at_;
    return all;
  }
  // True if at_ may be the first letter of a label without its quotes.
  bool begins_label() const {
    return at_ < text_.size() && std::isalpha(static_cast<unsigned char>(text_[at_])) != 0;
  }
  std::string label() {
    const size_t begin = at_;
    const size_t end = text_.find('\'', begin);
    if (end == std::string::npos)
      fail_at(begin - 1, "expected a ' that ends the label, found the end of the expression");
    if (end == begin) fail_at(begin - 1, "expected a label between the quotes, found nothing");
    at_ = end + 1;
    return text_.substr(begin, end - begin);
  }

  const std::string& text_;
  const ExpressionSource& source_;
  size_t at_ = 0;
};

}  // namespace

bool has_merge_mark(const Expression& e) {
  return (e.kind == Expression::Kind::kAtom && e.atom.merges) ||
         std::any_of(e.parts.begin(), e.parts.end(), has_merge_mark);
}

void collect_labels(const Expression& e, std::vector<std::string>& labels) {
  for (const SymbolPattern& p : e.atom.any_of)
    if (!p.label.empty() && std::find(labels.begin(), labels.end(), p.label) == labels.end())
      labels.push_back(p.label);
  for (const Expression& part : e.parts) collect_labels(part, labels);
}

Expression parse_expression(const std::string& expression, const ExpressionSource& source) {
  return Parser(expression, source).parse();
}

}  // namespace nephroid
