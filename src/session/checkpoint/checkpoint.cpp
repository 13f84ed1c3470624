#include "session/checkpoint/checkpoint.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <map>
#include <sstream>

#include "core/errors.h"

namespace nephroid {
namespace {

/// "key=value" words, by key.
std::map<std::string, std::string> settings_in(const std::string& text) {
  std::map<std::string, std::string> settings;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const size_t equals = word.find('=');
    settings[word.substr(0, equals)] =
        equals == std::string::npos ? std::string() : word.substr(equals + 1);
  }
  return settings;
}

std::string shown(const std::string& value) {
  return value.empty() ? "nothing" : value;
}

/// Metadata that tell which render a picture is of.
constexpr const char* kIdentity[] = {"version", "scene_hash", "film",     "routes",
                                     "aovs",    "options",    "outliers", "seed"};

/// Empty if nothing that counts differs.
std::string differences(const Metadata& a, const Metadata& b, const std::string& other) {
  std::string text;
  const auto add = [&](const std::string& what, const std::string& there, const std::string& here) {
    text += fmt::format("\n  {} {}, {} {}", what, shown(there), other, shown(here));
  };
  for (const std::string key : kIdentity) {
    const std::string there = value_of(a, "nephroid:" + key), here = value_of(b, "nephroid:" + key);
    if (there == here) continue;
    if (key != "options") {
      add(key, there, here);
      continue;
    }
    auto of_a = settings_in(there), of_b = settings_in(here);
    for (auto* settings : {&of_a, &of_b}) settings->erase("texture-cache");  // the same picture
    for (const auto& [name, value] : of_a)
      if (const auto found = of_b.find(name); found == of_b.end() || found->second != value)
        add(name, value, found == of_b.end() ? "" : found->second);
    for (const auto& [name, value] : of_b)
      if (of_a.find(name) == of_a.end()) add(name, "", value);
  }
  return text;
}

}  // namespace

RenderState state_of(const Scene& scene, Preset& preset, Film& film) {
  RenderState state = film.state();
  for (const auto& estimator : preset.estimators) estimator->add_state(scene, film, state);
  return state;
}

PassRanges passes_of(const StateFile& file, const std::string& purpose) {
  const std::string refusal = file.path() + ": cannot " + purpose + ": ";
  if (!file.has_state())
    throw IoError(refusal +
                  "it has no state, expected a picture that was rendered without --no-state");
  const auto passes = PassRanges::parse(value_of(file.metadata(), "nephroid:passes"));
  if (!passes || passes->empty()) throw IoError(refusal + "it does not say which passes it has");
  return *passes;
}

double seconds_of(const StateFile& file, const std::string& key) {
  const std::string text = value_of(file.metadata(), key);
  if (text.empty()) return 0;
  double seconds = 0;
  const char* const end = text.data() + text.size();
  const auto [after, error] = std::from_chars(text.data(), end, seconds);
  if (error != std::errc() || after != end || !(seconds >= 0) || !std::isfinite(seconds))
    throw IoError(fmt::format("{}: '{}' of {} is no time", file.path(), text, key));
  return seconds;
}

void require_same_render(const StateFile& file, const Metadata& metadata, const std::string& other,
                         const std::string& purpose) {
  const std::string found = differences(file.metadata(), metadata, other);
  if (!found.empty())
    throw UsageError(file.path() + ": cannot " + purpose +
                     ": it is the picture of another render:" + found);
}

std::string instruction_sets_of(const Metadata& metadata) {
  return value_of(metadata, kInstructionSetKey);
}

std::string joined_instruction_sets(const std::string& a, const std::string& b) {
  std::string joined;
  for (const std::string& sets : {a, b}) {
    std::istringstream words(sets);
    for (std::string set; std::getline(words, set, ';');) {
      if (set.starts_with(' ')) set.erase(0, 1);
      if (!set.empty() && ("; " + joined + ";").find("; " + set + ";") == std::string::npos)
        joined += (joined.empty() ? "" : "; ") + set;
    }
  }
  return joined;
}

std::optional<std::string> warning_of_instruction_sets(const StateFile& file,
                                                       const Metadata& metadata,
                                                       const std::string& other) {
  const std::string there = instruction_sets_of(file.metadata()),
                    here = instruction_sets_of(metadata);
  if (there == here) return std::nullopt;
  return fmt::format("{}: rendered with {}, {} {}: the last bits may differ from those of one run",
                     file.path(), shown(there), other, shown(here));
}

PassRanges passes_to_go_on_from(const std::string& path, const Metadata& here) {
  try {
    const StateFile file(path);
    if (file.has_state() && differences(file.metadata(), here, "here").empty())
      return passes_of(file, "go on from it");
  } catch (const IoError&) {
  }
  return {};
}

Checkpoint go_on_from(const std::string& path, const Metadata& here, const Scene& scene,
                      Preset& preset, Film& film) try {
  const std::string purpose = "go on from it";
  StateFile file(path);
  const PassRanges passes = passes_of(file, purpose);
  require_same_render(file, here, "here", purpose);
  file.load(state_of(scene, preset, film));
  const Metadata& metadata = file.metadata();
  Checkpoint checkpoint{passes,
                        seconds_of(file, "nephroid:seconds"),
                        seconds_of(file, "nephroid:last_pass_seconds"),
                        value_of(metadata, "nephroid:history"),
                        value_of(metadata, "nephroid:choices"),
                        instruction_sets_of(metadata),
                        {}};
  if (auto warning = warning_of_instruction_sets(file, here, "here"))
    checkpoint.warnings.push_back(std::move(*warning));
  return checkpoint;
} catch (const IoError& error) {
  throw IoError(std::string(error.what()) + "; without --resume the render starts anew");
}

}  // namespace nephroid
