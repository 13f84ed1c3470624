#include "integrator/estimator/path_letters.h"

#include <unordered_map>

#include "route/scene_symbols.h"
#include "route/word_text.h"

namespace nephroid {

PathLetters::PathLetters(const Scene& scene) {
  std::unordered_map<std::string, uint32_t> numbers;
  const auto number = [&](const std::vector<std::string>& labels, size_t i) {
    const std::string& name = i < labels.size() ? labels[i] : std::string();
    const auto [known, is_new] = numbers.emplace(name, static_cast<uint32_t>(names_.size()));
    if (is_new) names_.push_back(name);
    return known->second;
  };
  for (size_t i = 0; i < scene.materials.size(); ++i)
    materials_.push_back(number(scene.material_labels, i));
  for (size_t i = 0; i < scene.media.size(); ++i) media_.push_back(number(scene.medium_labels, i));
  for (size_t i = 0; i < scene.lights.size(); ++i) {
    lights_.push_back(number(scene.light_labels, i));
    kinds_.push_back(kind_of(*scene.lights[i]));
  }
}

Letter PathLetters::of(const WalkEvent& event) const {
  const uint32_t label = event.medium >= 0 ? media_[event.medium] : materials_[event.material];
  return label << 3 |
         static_cast<uint32_t>(kind_of(event_symbol(event.letter, event.transmitted, Label{0})));
}

Letter PathLetters::of(const PathEnd& end) const {
  if (end.light < 0) return media_[end.medium] << 3 | static_cast<uint32_t>(LightKind::kMedium);
  return lights_[end.light] << 3 | static_cast<uint32_t>(kinds_[end.light]);
}

std::string PathLetters::text(std::span<const Letter> word) const {
  // event_text and light_text number labels from 1; 0 has none.
  const auto label = [this](Letter letter) {
    return names_[letter >> 3].empty() ? Label{0} : Label{1};
  };
  const auto name = [this](Letter letter) { return std::span(&names_[letter >> 3], 1); };
  std::string text = "C ";
  for (const Letter e : word.first(word.size() - 1))
    text += event_text(event_symbol(static_cast<EventKind>(e & 7), label(e)), name(e), true) + " ";
  const Letter light = word.back();
  return text + light_text(light_symbol(static_cast<LightKind>(light & 7), label(light)),
                           name(light), true);
}

}  // namespace nephroid
