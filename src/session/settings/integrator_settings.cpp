// The table of -D keys.
#include "session/settings/integrator_settings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <set>
#include <stdexcept>

#include "input/option_values.h"
#include "input/spelling.h"
#include "integrator/presets/estimator_table.h"

namespace nephroid {
namespace {

constexpr float kMaxFloat = std::numeric_limits<float>::max();

// Settings of single estimators are in their descriptors.
const IntegratorSetting kSettings[] = {
    {"max-depth", "N", "100, or the scene's maxdepth", "",
     "Scattering events of a whole path, from the camera to the light.",
     [](RenderSettings& s, const std::string& t) {
       s.integrator.max_depth = parse_int("-D max-depth", t, 0);
     },
     [](const RenderSettings& s) { return fmt::format("{}", s.integrator.max_depth); }},
    {"photons", "N", "0, chosen", "paths",
     "Photon paths emitted per pass. 0 chooses by the size of the film.",
     [](RenderSettings& s, const std::string& t) {
       s.integrator.photons_per_pass = parse_integer("-D photons", t, 0);
     },
     [](const RenderSettings& s) { return fmt::format("{}", s.integrator.photons_per_pass); }},
    {"camera-samples", "N", "0, chosen", "samples",
     "Camera paths per pixel and pass. Up to 65535; 0 lets the integrator choose. In `mixed` also "
     "walks for lamps behind glass.",
     [](RenderSettings& s, const std::string& t) {
       s.integrator.camera_samples_per_pass = parse_int("-D camera-samples", t, 0, 65535);
     },
     [](const RenderSettings& s) {
       return fmt::format("{}", s.integrator.camera_samples_per_pass);
     }},
    {"radius", "X", "0, chosen", "pixels",
     "Merge radius of the first pass. It is in footprints of a pixel; 0 lets the integrator "
     "choose.",
     [](RenderSettings& s, const std::string& t) {
       s.integrator.radius = parse_float("-D radius", t, 0, kMaxFloat, false);
     },
     [](const RenderSettings& s) { return fmt::format("{}", s.integrator.radius); }},
    {"specular-alpha", "X|LOW..HIGH", "0.035..0.07", "",
     "Roughness up to which a lobe is specular (S), not glossy (G). It is the microfacet "
     "alpha "
     "after remapping, the larger of both directions; within a range the passes differ, so that "
     "nothing jumps as roughness grows.",
     [](RenderSettings& s, const std::string& t) {
       const auto [low, high] = parse_range("-D specular-alpha", t, 0, 1);
       s.scene.specular_band = {low, high};
     },
     [](const RenderSettings& s) {
       const SpecularBand& band = s.scene.specular_band;
       return band.low == band.high ? fmt::format("{}", band.low)
                                    : fmt::format("{}..{}", band.low, band.high);
     }},
    {"alpha", "X", "0.6666667", "",
     "How fast the merge radius shrinks, above 0 to 1: 1 keeps it, smaller values shrink faster.",
     [](RenderSettings& s, const std::string& t) {
       s.integrator.shrink_alpha = parse_float("-D alpha", t, 0, 1, true);
     },
     [](const RenderSettings& s) { return fmt::format("{}", s.integrator.shrink_alpha); }},
    {"memory-photons", "N", "1048576", "photons",
     "Photons kept at once; a pass with more runs in batches, a map with more ends, and "
     "pointlights "
     "chooses as many of its point lights as have room in their memory.",
     [](RenderSettings& s, const std::string& t) {
       s.integrator.memory_photons = parse_integer("-D memory-photons", t, 1);
     },
     [](const RenderSettings& s) { return fmt::format("{}", s.integrator.memory_photons); }},
    {"outlier-neighbours", "N", "8", "estimates",
     "With --outliers reject: how many similar estimates within 5 x 5 pixels confirm an estimate; "
     "more reject more.",
     [](RenderSettings& s, const std::string& t) {
       s.scene.outlier_neighbours = parse_int("-D outlier-neighbours", t, 2, 1000);
     },
     [](const RenderSettings& s) { return fmt::format("{}", s.scene.outlier_neighbours); }},
    {"texture-cache", "SIZE", "1G", "bytes",
     "Memory for the pixels of image textures (K, M, G: powers of 1024); what does not fit is read "
     "from the files again and again, with the same picture.",
     [](RenderSettings& s, const std::string& t) {
       s.scene.texture_memory = parse_bytes("-D texture-cache", t);
     },
     [](const RenderSettings& s) { return bytes_text(s.scene.texture_memory); }},
};

/// "For path, forecast, bdpt.": the estimators with a setting.
std::string owners_of(const EstimatorSetting& setting) {
  std::vector<std::string> names;
  for (const EstimatorDescriptor* estimator : estimator_table())
    if (std::ranges::find(estimator->settings, &setting) != estimator->settings.end())
      names.emplace_back(estimator->traits.name);
  return fmt::format("For {}.", fmt::join(names, ", "));
}

/// The settings above and those of all estimators, each once.
std::vector<IntegratorSetting> all_settings() {
  std::vector<IntegratorSetting> all(std::begin(kSettings), std::end(kSettings));
  std::set<const EstimatorSetting*> seen;
  for (const EstimatorDescriptor* estimator : estimator_table())
    for (const EstimatorSetting* own : estimator->settings)
      if (seen.insert(own).second) {
        if (std::ranges::any_of(all,
                                [&](const auto& row) { return row.key == std::string(own->key); }))
          throw std::logic_error(std::string("two settings are called ") + own->key);
        all.push_back(
            {own->key, own->value, own->default_text, own->unit,
             std::string(own->help) + " " + owners_of(*own),
             [own](RenderSettings& s, const std::string& text) { own->apply(s.integrator, text); },
             [own](const RenderSettings& s) { return own->print(s.integrator); }});
      }
  return all;
}

const IntegratorSetting* find_setting(const std::string& key) {
  for (const IntegratorSetting& setting : integrator_settings())
    if (key == setting.key) return &setting;
  return nullptr;
}

std::string all_keys() {
  std::string keys;
  for (const IntegratorSetting& setting : integrator_settings()) {
    if (!keys.empty()) keys += ", ";
    keys += setting.key;
  }
  return keys;
}

}  // namespace

bool RenderSettings::gives(const std::string& key) const {
  return std::ranges::find(given, key) != given.end();
}

std::span<const IntegratorSetting> integrator_settings() {
  static const std::vector<IntegratorSetting> settings = all_settings();
  return settings;
}

std::pair<std::string, std::string> parse_setting(const std::string& text) {
  const size_t equals = text.find('=');
  if (equals == std::string::npos)
    throw UsageError(fmt::format("-D: '{}' is not valid, expected key=value with a key of: {}",
                                 text, all_keys()));
  std::string key = text.substr(0, equals), value = text.substr(equals + 1);
  const IntegratorSetting* setting = find_setting(key);
  if (setting == nullptr) {
    std::vector<std::string> known;
    for (const IntegratorSetting& row : integrator_settings()) known.emplace_back(row.key);
    throw UsageError(fmt::format("-D: unknown key '{}', expected one of: {}{}", key, all_keys(),
                                 did_you_mean(key, known)));
  }
  RenderSettings scratch;
  setting->apply(scratch, value);
  return {std::move(key), std::move(value)};
}

void apply_settings(const SettingList& settings, RenderSettings* target) {
  for (const auto& [key, value] : settings)
    if (const IntegratorSetting* setting = find_setting(key)) {
      setting->apply(*target, value);
      target->given.push_back(key);
    }
}

RenderSettings render_settings(const SettingList& list, uint64_t memory) {
  RenderSettings settings;
  if (memory > 0) {
    const auto share = static_cast<int64_t>(memory / 4);
    settings.scene.texture_memory = std::min(memory / 4, settings.scene.texture_memory);
    settings.integrator.memory_photons = std::clamp<int64_t>(share / int64_t{kBytesPerPhoton}, 1,
                                                             settings.integrator.memory_photons);
  }
  apply_settings(list, &settings);
  return settings;
}

std::string settings_text(const RenderSettings& settings) {
  std::string text;
  for (const IntegratorSetting& setting : integrator_settings()) {
    if (!text.empty()) text += ' ';
    text += fmt::format("{}={}", setting.key, setting.print(settings));
  }
  return text;
}

}  // namespace nephroid
