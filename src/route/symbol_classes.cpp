// The symbols that each atom reads (only D and G if it has a mark), and the coarsest partition of
// the symbols that respects them.
#include "route/symbol_classes.h"

#include <algorithm>
#include <map>
#include <utility>

namespace nephroid {
namespace {

// A pattern with its label as a number.
struct NumberedPattern {
  SymbolPattern pattern;
  int label = -1;  ///< -1: any
};

class AtomReader {
 public:
  AtomReader(const ExpressionAtom& atom, const std::vector<std::string>& labels) : atom_(atom) {
    for (const SymbolPattern& p : atom.any_of) {
      const auto found = std::find(labels.begin(), labels.end(), p.label);
      patterns_.push_back({p, p.label.empty() ? -1 : static_cast<int>(found - labels.begin()) + 1});
    }
  }
  bool reads_eye() const {
    return !atom_.merges && any([](const NumberedPattern& p) { return p.pattern.eye; });
  }
  bool reads_event(EventSymbol e) const {
    if (atom_.merges && !contains(ClassMask::kRough, class_of(kind_of(e)))) return false;
    return any([e](const NumberedPattern& p) {
      return (p.pattern.events >> static_cast<int>(kind_of(e)) & 1u) != 0 &&
             (p.label < 0 || p.label == label_of(e));
    });
  }
  bool reads_light(LightSymbol l) const {
    return !atom_.merges && any([l](const NumberedPattern& p) {
      return (p.pattern.lights >> static_cast<int>(kind_of_light(l)) & 1u) != 0 &&
             (p.label < 0 || p.label == label_of_light(l));
    });
  }

 private:
  template <class Predicate>
  bool any(Predicate matches) const {
    return std::any_of(patterns_.begin(), patterns_.end(), matches) != atom_.negated;
  }
  const ExpressionAtom& atom_;
  std::vector<NumberedPattern> patterns_;
};

// Numbers the distinct keys of all symbols whose kind is below `kinds`; `key` describes a symbol.
template <class Key>
void number_classes(size_t labels, int kinds, Key key, std::vector<int>& class_of,
                    std::vector<uint16_t>& first_symbols) {
  std::map<std::vector<bool>, int> known;
  class_of.assign(8 * (labels + 1), SymbolClasses::kNone);
  for (size_t label = 0; label <= labels; ++label)
    for (int kind = 0; kind < kinds; ++kind) {
      const auto symbol = static_cast<uint16_t>(label << 3 | static_cast<size_t>(kind));
      const auto [at, is_new] = known.try_emplace(key(symbol), static_cast<int>(known.size()));
      if (is_new) first_symbols.push_back(symbol);
      class_of[symbol] = at->second;
    }
}

}  // namespace

SymbolClasses classify_symbols(std::span<const ExpressionAtom* const> atoms,
                               const std::vector<std::string>& labels) {
  std::vector<AtomReader> readers;
  for (const ExpressionAtom* atom : atoms) readers.emplace_back(*atom, labels);

  SymbolClasses classes;
  const auto event_key = [&](EventSymbol e) {
    std::vector<bool> key;
    for (const AtomReader& r : readers) key.push_back(r.reads_event(e));
    for (const EventClass c :
         {EventClass::kDiffuse, EventClass::kGlossy, EventClass::kSpecular, EventClass::kVolume})
      key.push_back(class_of(kind_of(e)) == c);
    return key;
  };
  const auto light_key = [&](LightSymbol l) {
    std::vector<bool> key;
    for (const AtomReader& r : readers) key.push_back(r.reads_light(l));
    for (int kind = 0; kind < kLightKinds; ++kind)
      key.push_back(static_cast<int>(kind_of_light(l)) == kind);
    return key;
  };
  number_classes(labels.size(), kEventKinds, event_key, classes.event_class, classes.events);
  number_classes(labels.size(), kLightKinds, light_key, classes.light_class, classes.lights);

  for (const AtomReader& r : readers) {
    std::vector<bool> of_events, of_lights;
    for (const EventSymbol e : classes.events) of_events.push_back(r.reads_event(e));
    for (const LightSymbol l : classes.lights) of_lights.push_back(r.reads_light(l));
    classes.reads_event.push_back(std::move(of_events));
    classes.reads_light.push_back(std::move(of_lights));
    classes.reads_eye.push_back(r.reads_eye());
  }
  return classes;
}

}  // namespace nephroid
