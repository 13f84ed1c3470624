#include "session/checkpoint.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
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

std::string value_of(const Metadata& metadata, const std::string& key) {
  for (const auto& [k, value] : metadata)
    if (k == key) return value;
  return {};
}

std::string shown(const std::string& value) {
  return value.empty() ? "nothing" : value;
}

}  // namespace

RenderState state_of(const Scene& scene, Preset& preset, Film& film) {
  RenderState state = film.state();
  for (const auto& estimator : preset.estimators) estimator->add_state(scene, film, state);
  return state;
}

const std::vector<std::string>& identity_keys() {
  static const std::vector<std::string> keys = {
      "nephroid:version", "nephroid:scene_hash", "nephroid:film",     "nephroid:routes",
      "nephroid:aovs",    "nephroid:options",    "nephroid:outliers", "nephroid:seed"};
  return keys;
}

std::vector<std::string> differences(const StateFile& file, const Metadata& here) {
  std::vector<std::string> found;
  const auto add = [&](const std::string& what, const std::string& there, const std::string& now) {
    found.push_back(fmt::format("{} {}, here {}", what, shown(there), shown(now)));
  };
  const std::string prefix = "nephroid:";
  for (const std::string& key : identity_keys()) {
    const std::string there = file.value_of(key), now = value_of(here, key);
    if (there == now) continue;
    if (key != "nephroid:options") {
      add(key.substr(prefix.size()), there, now);
      continue;
    }
    const auto a = settings_in(there), b = settings_in(now);
    for (const auto& [name, value] : a)
      if (const auto other = b.find(name); other == b.end() || other->second != value)
        add(name, value, other == b.end() ? "" : other->second);
    for (const auto& [name, value] : b)
      if (a.find(name) == a.end()) add(name, "", value);
  }
  return found;
}

Checkpoint go_on_from(const std::string& path, const Metadata& here, const Scene& scene,
                      Preset& preset, Film& film) {
  StateFile file(path);
  if (!file.has_state())
    throw IoError(path +
                  ": cannot go on from it: it has no state, expected a picture that was rendered "
                  "without --no-state");
  const std::vector<std::string> different = differences(file, here);
  if (!different.empty()) {
    std::string list;
    for (const std::string& line : different) list += "\n  " + line;
    throw UsageError(path + ": cannot go on from it: it is the picture of another render:" + list);
  }
  const std::optional<PassRanges> passes = PassRanges::parse(file.value_of("nephroid:passes"));
  if (!passes || passes->empty())
    throw IoError(path + ": cannot go on from it: it does not say which passes it has");
  Checkpoint checkpoint{*passes, std::strtod(file.value_of("nephroid:seconds").c_str(), nullptr),
                        file.value_of("nephroid:history")};
  file.load(state_of(scene, preset, film));
  return checkpoint;
}

}  // namespace nephroid
