// One table maps members to metadata; -D keys are compared one by one.
#include "session/checkpoint/render_identity.h"

#include <fmt/format.h>

#include <map>
#include <sstream>

#include "session/checkpoint/version.h"

namespace nephroid {
namespace {

struct Field {
  const char* key;
  std::string RenderIdentity::*text;
  bool decides;  ///< true if a difference makes it another render
};

/// In the order in which differences are listed.
constexpr Field kFields[] = {
    {kVersionKey, &RenderIdentity::version, true},
    {kSceneHashKey, &RenderIdentity::scene_hash, true},
    {kFilmKey, &RenderIdentity::film, true},
    {kRoutesKey, &RenderIdentity::routes, true},
    {kAovsKey, &RenderIdentity::aovs, true},
    {kOptionsKey, &RenderIdentity::options, true},
    {kOutliersKey, &RenderIdentity::outliers, true},
    {kSeedKey, &RenderIdentity::seed, true},
    {kSceneKey, &RenderIdentity::scene, false},
    {kIntegratorKey, &RenderIdentity::integrator, false},
    {kLayersByLightKey, &RenderIdentity::layers_by_light, false},
    {kMaxComponentKey, &RenderIdentity::max_component, false},
    {kInstructionSetKey, &RenderIdentity::instruction_sets, false},
};

/// -D keys that do not change the picture.
constexpr const char* kPictureIsTheSame[] = {"texture-cache"};

/// "key=value" words, by key.
std::map<std::string, std::string> settings_in(const std::string& text) {
  std::map<std::string, std::string> settings;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const size_t equals = word.find('=');
    settings[word.substr(0, equals)] =
        equals == std::string::npos ? std::string() : word.substr(equals + 1);
  }
  for (const char* key : kPictureIsTheSame) settings.erase(key);
  return settings;
}

/// Lists differences between one picture and another.
class Differences {
 public:
  explicit Differences(const std::string& name) : name_(name) {}

  void compare(const std::string& what, const std::string& there, const std::string& here) {
    if (there == here) return;
    if (what == "scene_hash") {
      sentences_.push_back(fmt::format(
          "the scene, or a file that it reads, has changed ({}, {} {})", there, name_, here));
      return;
    }
    const auto shown = [](const std::string& value) { return value.empty() ? "nothing" : value; };
    sentences_.push_back(fmt::format("{} {}, {} {}", what, shown(there), name_, shown(here)));
  }
  void compare_settings(const std::string& there, const std::string& here) {
    const auto of_there = settings_in(there), of_here = settings_in(here);
    for (const auto& [key, value] : of_there) {
      const auto found = of_here.find(key);
      if (found == of_here.end())
        sentences_.push_back(fmt::format("{} {}, {} nothing", key, value, name_));
      else
        compare(key, value, found->second);
    }
    for (const auto& [key, value] : of_here)
      if (of_there.find(key) == of_there.end()) compare(key, "", value);
  }
  std::vector<std::string> take() { return std::move(sentences_); }

 private:
  const std::string& name_;
  std::vector<std::string> sentences_;
};

}  // namespace

RenderIdentity RenderIdentity::of_this_program() {
  RenderIdentity identity;
  identity.version = kVersion;
  identity.instruction_sets = instruction_set();
  return identity;
}

RenderIdentity RenderIdentity::from_metadata(const Metadata& metadata) {
  RenderIdentity identity;
  for (const Field& field : kFields) identity.*field.text = value_of(metadata, field.key);
  return identity;
}

Metadata RenderIdentity::to_metadata() const {
  Metadata metadata;
  for (const Field& field : kFields)
    if (!(this->*field.text).empty()) metadata.emplace_back(field.key, this->*field.text);
  return metadata;
}

void RenderIdentity::set_film(const Film& of, uint64_t of_seed) {
  const PixelBounds& crop = of.bounds();
  film = fmt::format("{}x{}, columns {} to {}, rows {} to {}", of.settings().width,
                     of.settings().height, crop.x0, crop.x1, crop.y0, crop.y1);
  outliers = of.rejection() == nullptr ? "" : "reject";
  const float limit = of.settings().max_component;
  max_component = limit < kInfinity ? fmt::format("{}", limit) : "";
  seed = fmt::format("{}", of_seed);
}

std::vector<std::string> RenderIdentity::differences(const RenderIdentity& other,
                                                     const std::string& name) const {
  Differences differences(name);
  for (const Field& field : kFields) {
    if (!field.decides) continue;
    const std::string &there = this->*field.text, &here = other.*field.text;
    if (field.text == &RenderIdentity::options)
      differences.compare_settings(there, here);
    else
      differences.compare(std::string(field.key).substr(kKeyPrefix.size()), there, here);
  }
  return differences.take();
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

}  // namespace nephroid
