#include "route/word_text.h"

#include "route/compile.h"

namespace nephroid {
namespace {

std::string label_text(Label label, std::span<const std::string> labels) {
  return label == 0 || label > labels.size() ? "" : "'" + labels[label - size_t{1}] + "'";
}

}  // namespace

std::string event_text(EventSymbol e, std::span<const std::string> labels, bool full) {
  const char letter = "DGSVH"[static_cast<size_t>(class_of(kind_of(e)))];
  if (!full) return {letter};
  const std::string label = label_text(label_of(e), labels);
  if (kind_of(e) == EventKind::kV || kind_of(e) == EventKind::kH)
    return label.empty() ? std::string{letter} : std::string{'<', letter} + label + ">";
  return std::string("<") + (is_transmission(kind_of(e)) ? 'T' : 'R') + letter + label + ">";
}

std::string light_text(LightSymbol l, std::span<const std::string> labels, bool full) {
  const LightKind kind = kind_of_light(l);
  const bool is_medium = kind == LightKind::kMedium;
  if (!full) return is_medium ? "M" : "L";
  const std::string letter = is_medium                   ? "M"
                             : kind == LightKind::kShape ? "O"
                             : kind == LightKind::kPoint ? "L"
                                                         : "B";
  const std::string label = label_text(label_of_light(l), labels);
  return label.empty() ? letter : "<" + letter + "." + label + ">";
}

std::string word_text(std::span<const EventSymbol> events, LightSymbol light,
                      std::span<const std::string> labels, bool full) {
  std::string text = "C ";
  for (const EventSymbol e : events) text += event_text(e, labels, full) + " ";
  return text + light_text(light, labels, full);
}

}  // namespace nephroid
