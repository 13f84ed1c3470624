// The table of -D keys.
#include "session/settings/integrator_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "session/settings/option_values.h"

namespace nephroid {
namespace {

constexpr int64_t kNoLimit = std::numeric_limits<int64_t>::max();
constexpr int kMaxInt = std::numeric_limits<int>::max();

float number(const char* key, const std::string& text, double low, double high, bool open) {
  return static_cast<float>(parse_number(std::string("-D ") + key, text, low, high, open));
}
int64_t integer(const char* key, const std::string& text, int64_t low, int64_t high) {
  return parse_integer(std::string("-D ") + key, text, low, high);
}

/// "all", "merged" or "S,T", and then perhaps ",raw".
TechniqueChoice parse_technique(const std::string& text) {
  constexpr std::string_view kRaw = ",raw";
  TechniqueChoice choice;
  std::string which = text;
  if (which.ends_with(kRaw)) {
    choice.weighted = false;
    which.resize(which.size() - kRaw.size());
  }
  choice.connects = which != "merged";
  if (which == "all" || which == "merged") return choice;
  const size_t comma = which.find(',');
  if (comma == std::string::npos)
    throw UsageError(fmt::format(
        "-D technique: '{}' is not valid, expected all, merged or S,T (such as 1,3), and after it "
        ",raw if wanted",
        text));
  const auto count = [](const std::string& t, int low) {
    return t == "*" ? -1 : static_cast<int>(integer("technique", t, low, kMaxInt));
  };
  choice.s = count(which.substr(0, comma), 0);
  choice.t = count(which.substr(comma + 1), 1);
  return choice;
}
std::string technique_text(const TechniqueChoice& choice) {
  const auto count = [](int n) { return n < 0 ? std::string("*") : std::to_string(n); };
  const std::string which = !choice.connects  ? "merged"
                            : choice.merges() ? "all"
                                              : count(choice.s) + "," + count(choice.t);
  return which + (choice.weighted ? "" : ",raw");
}

bool yes(const char* key, const std::string& text) {
  if (text != "yes" && text != "no")
    throw UsageError(fmt::format("-D {}={}: expected yes or no", key, text));
  return text == "yes";
}

std::string yes_text(bool yes) {
  return yes ? "yes" : "no";
}

constexpr IntegratorSetting kSettings[] = {
    {"max-depth", "N", "100, or the scene's maxdepth", "",
     "Scattering events of a whole path, from the camera to the light.",
     [](RenderSettings& s, const std::string& t) {
       s.integrator.max_depth = static_cast<int>(integer("max-depth", t, 0, kMaxInt));
     },
     [](const RenderSettings& s) { return fmt::format("{}", s.integrator.max_depth); }},
    {"radius", "X", "0", "pixels",
     "Merge radius of the first pass, in footprints of a pixel; 0 lets the integrator choose.",
     [](RenderSettings& s, const std::string& t) {
       s.integrator.radius = number("radius", t, 0, std::numeric_limits<float>::max(), false);
     },
     [](const RenderSettings& s) { return fmt::format("{}", s.integrator.radius); }},
    {"photons", "N", "0", "paths",
     "Photon paths emitted per pass; 0 chooses by the size of the film.",
     [](RenderSettings& s, const std::string& t) {
       s.integrator.photons_per_pass = integer("photons", t, 0, kNoLimit);
     },
     [](const RenderSettings& s) { return fmt::format("{}", s.integrator.photons_per_pass); }},
    {"alpha", "X", "0.6666667", "",
     "How fast the merge radius shrinks, above 0 to 1: 1 keeps it, smaller values shrink faster.",
     [](RenderSettings& s, const std::string& t) {
       s.integrator.alpha = number("alpha", t, 0, 1, true);
     },
     [](const RenderSettings& s) { return fmt::format("{}", s.integrator.alpha); }},
    {"specular-alpha", "X or LOW..HIGH", "0.035..0.07", "",
     "Microfacet roughness (after remapping, the larger of both directions) up to which a lobe "
     "counts as specular (S) and not as glossy (G); within a range the passes differ, so that "
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
    {"camera-samples", "N", "0", "samples",
     "Camera paths per pixel and pass, up to 65535; 0 lets the integrator choose. In `mixed` also "
     "walks for lamps behind glass.",
     [](RenderSettings& s, const std::string& t) {
       s.integrator.camera_samples_per_pass =
           static_cast<int>(integer("camera-samples", t, 0, 65535));
     },
     [](const RenderSettings& s) {
       return fmt::format("{}", s.integrator.camera_samples_per_pass);
     }},
    {"point-lights", "N", "0", "connections",
     "Virtual point lights that a camera path of pointlights is connected to, up to 1024; 0 lets "
     "the integrator choose.",
     [](RenderSettings& s, const std::string& t) {
       s.integrator.point_lights = static_cast<int>(integer("point-lights", t, 0, 1024));
     },
     [](const RenderSettings& s) { return fmt::format("{}", s.integrator.point_lights); }},
    {"technique", "S,T", "all", "",
     "Of bdpt, vcm and bpm: only paths of S vertices from the light, its start included, and T "
     "from the eye, the lens included (* for any number), or merged ones; with ,raw behind it "
     "unweighed, as if there were no other technique.",
     [](RenderSettings& s, const std::string& t) { s.integrator.technique = parse_technique(t); },
     [](const RenderSettings& s) { return technique_text(s.integrator.technique); }},
    {"hit-points", "N", "0", "hit points",
     "Hit points of a pixel in ppm, which stay from pass to pass: memory for smooth edges; 0 takes "
     "the scene's samples per pixel, at least 4 and at most 16.",
     [](RenderSettings& s, const std::string& t) {
       s.integrator.hit_points = static_cast<int>(integer("hit-points", t, 0, kMaxInt));
     },
     [](const RenderSettings& s) { return fmt::format("{}", s.integrator.hit_points); }},
    {"map-photons", "N", "0", "paths",
     "Photon paths emitted for each map of photonmap, once; 0 emits those of 16 passes. When "
     "memory-photons are stored, emission ends.",
     [](RenderSettings& s, const std::string& t) {
       s.integrator.map_photons = integer("map-photons", t, 0, kNoLimit);
     },
     [](const RenderSettings& s) { return fmt::format("{}", s.integrator.map_photons); }},
    {"nearest", "N", "100", "photons",
     "Photons of an estimate in photonmap: the nearest ones, within the radius of -D radius; at "
     "least 2.",
     [](RenderSettings& s, const std::string& t) {
       s.integrator.nearest_photons = static_cast<int>(integer("nearest", t, 2, kMaxInt));
     },
     [](const RenderSettings& s) { return fmt::format("{}", s.integrator.nearest_photons); }},
    {"memory-photons", "N", "1048576", "photons",
     "Photons kept at once; a pass with more runs in batches, a map with more ends, and "
     "pointlights "
     "chooses as many of its point lights as have room in their memory.",
     [](RenderSettings& s, const std::string& t) {
       s.integrator.memory_photons = integer("memory-photons", t, 1, kNoLimit);
     },
     [](const RenderSettings& s) { return fmt::format("{}", s.integrator.memory_photons); }},
    {"outlier-neighbours", "N", "8", "estimates",
     "With --outliers reject: how many similar estimates within 5 x 5 pixels confirm an estimate; "
     "more reject more.",
     [](RenderSettings& s, const std::string& t) {
       s.scene.outlier_neighbours = static_cast<int>(integer("outlier-neighbours", t, 2, 1000));
     },
     [](const RenderSettings& s) { return fmt::format("{}", s.scene.outlier_neighbours); }},
    {"mutations", "X", "0", "mutations",
     "Of Metropolis light transport, per pixel and pass; 0 chooses.",
     [](RenderSettings& s, const std::string& t) {
       s.integrator.mutations = number("mutations", t, 0, std::numeric_limits<float>::max(), false);
     },
     [](const RenderSettings& s) { return fmt::format("{}", s.integrator.mutations); }},
    {"chain-length", "N", "0", "mutations",
     "After how many mutations a Markov chain gives way to a new one; 0 chooses.",
     [](RenderSettings& s, const std::string& t) {
       s.integrator.chain_length = integer("chain-length", t, 0, kNoLimit);
     },
     [](const RenderSettings& s) { return fmt::format("{}", s.integrator.chain_length); }},
    {"large-step", "X", "0.1", "",
     "Probability of a mutation that forgets the path it comes from, above 0 to 1.",
     [](RenderSettings& s, const std::string& t) {
       s.integrator.large_step = number("large-step", t, 0, 1, true);
     },
     [](const RenderSettings& s) { return fmt::format("{}", s.integrator.large_step); }},
    {"guide", "yes|no", "yes", "",
     "Photons of `photons` and `path+photons` start where earlier ones were of use; those of "
     "`photons` also go where these went from rough surfaces.",
     [](RenderSettings& s, const std::string& t) { s.integrator.guides_photons = yes("guide", t); },
     [](const RenderSettings& s) { return yes_text(s.integrator.guides_photons); }},
    {"guide-walks", "yes|no", "yes", "",
     "Camera walks of `path+photons`, and so of `mixed`, go where those of the first pass found "
     "light, where that pays.",
     [](RenderSettings& s, const std::string& t) {
       s.integrator.guides_walks = yes("guide-walks", t);
     },
     [](const RenderSettings& s) { return yes_text(s.integrator.guides_walks); }},
    {"specular-trees", "yes|no", "no", "",
     "Camera walks of routes of `path`, `forecast`, `bdpt`, `vcm` and `bpm` follow both ways at "
     "smooth glass to lights behind it: worth it where small lamps show in much glass. "
     "(`path+photons`, and so `mixed`, looks for them as it sees fit.)",
     [](RenderSettings& s, const std::string& t) {
       s.integrator.specular_trees = yes("specular-trees", t);
     },
     [](const RenderSettings& s) { return yes_text(s.integrator.specular_trees); }},
    {"texture-cache", "SIZE", "1G", "bytes",
     "Memory for the pixels of image textures (K, M, G: powers of 1024); what does not fit is read "
     "from the files again and again, with the same picture.",
     [](RenderSettings& s, const std::string& t) {
       s.scene.texture_memory = static_cast<uint64_t>(parse_bytes("-D texture-cache", t));
     },
     [](const RenderSettings& s) {
       return bytes_text(static_cast<int64_t>(s.scene.texture_memory));
     }},
};

const IntegratorSetting* find_setting(const std::string& key) {
  for (const IntegratorSetting& setting : kSettings)
    if (key == setting.key) return &setting;
  return nullptr;
}

std::string all_keys() {
  std::string keys;
  for (const IntegratorSetting& setting : kSettings) {
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
  return kSettings;
}

std::pair<std::string, std::string> parse_setting(const std::string& text) {
  const size_t equals = text.find('=');
  if (equals == std::string::npos)
    throw UsageError(fmt::format("-D: '{}' is not valid, expected key=value with a key of: {}",
                                 text, all_keys()));
  std::string key = text.substr(0, equals), value = text.substr(equals + 1);
  const IntegratorSetting* setting = find_setting(key);
  if (setting == nullptr)
    throw UsageError(fmt::format("-D: unknown key '{}', expected one of: {}", key, all_keys()));
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
  for (const IntegratorSetting& setting : kSettings) {
    if (!text.empty()) text += ' ';
    text += fmt::format("{}={}", setting.key, setting.print(settings));
  }
  return text;
}

}  // namespace nephroid
