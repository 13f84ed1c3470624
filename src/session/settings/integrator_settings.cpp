// The table of -D keys and the order of defaults.
#include "session/settings/integrator_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>

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
     [](IntegratorOptions& o, const std::string& t) {
       o.max_depth = static_cast<int>(integer("max-depth", t, 0, kMaxInt));
     },
     [](const IntegratorOptions& o) { return fmt::format("{}", o.max_depth); }},
    {"radius", "X", "0", "pixels",
     "Merge radius of the first pass, in footprints of a pixel; 0 lets the integrator choose.",
     [](IntegratorOptions& o, const std::string& t) {
       o.radius = number("radius", t, 0, std::numeric_limits<float>::max(), false);
     },
     [](const IntegratorOptions& o) { return fmt::format("{}", o.radius); }},
    {"photons", "N", "0", "paths",
     "Photon paths emitted per pass; 0 chooses by the size of the film.",
     [](IntegratorOptions& o, const std::string& t) {
       o.photons_per_pass = integer("photons", t, 0, kNoLimit);
     },
     [](const IntegratorOptions& o) { return fmt::format("{}", o.photons_per_pass); }},
    {"alpha", "X", "0.6666667", "",
     "How fast the merge radius shrinks, above 0 to 1: 1 keeps it, smaller values shrink faster.",
     [](IntegratorOptions& o, const std::string& t) { o.alpha = number("alpha", t, 0, 1, true); },
     [](const IntegratorOptions& o) { return fmt::format("{}", o.alpha); }},
    {"specular-alpha", "X or LOW..HIGH", "0.035..0.07", "",
     "Microfacet roughness (after remapping, the larger of both directions) up to which a lobe "
     "counts as specular (S) and not as glossy (G); within a range the passes differ, so that "
     "nothing jumps as roughness grows.",
     [](IntegratorOptions& o, const std::string& t) {
       const auto [low, high] = parse_range("-D specular-alpha", t, 0, 1);
       o.specular_band = {low, high};
     },
     [](const IntegratorOptions& o) {
       const SpecularBand& band = o.specular_band;
       return band.low == band.high ? fmt::format("{}", band.low)
                                    : fmt::format("{}..{}", band.low, band.high);
     }},
    {"camera-samples", "N", "0", "samples",
     "Camera paths per pixel and pass, up to 65535; 0 lets the integrator choose. In `mixed` also "
     "walks for lamps behind glass.",
     [](IntegratorOptions& o, const std::string& t) {
       o.camera_samples_per_pass = static_cast<int>(integer("camera-samples", t, 0, 65535));
     },
     [](const IntegratorOptions& o) { return fmt::format("{}", o.camera_samples_per_pass); }},
    {"point-lights", "N", "0", "connections",
     "Virtual point lights that a camera path of pointlights is connected to, up to 1024; 0 lets "
     "the integrator choose.",
     [](IntegratorOptions& o, const std::string& t) {
       o.point_lights = static_cast<int>(integer("point-lights", t, 0, 1024));
     },
     [](const IntegratorOptions& o) { return fmt::format("{}", o.point_lights); }},
    {"technique", "S,T", "all", "",
     "Of bdpt, vcm and bpm: only paths of S vertices from the light, its start included, and T "
     "from the eye, the lens included (* for any number), or merged ones; with ,raw behind it "
     "unweighed, as if there were no other technique.",
     [](IntegratorOptions& o, const std::string& t) { o.technique = parse_technique(t); },
     [](const IntegratorOptions& o) { return technique_text(o.technique); }},
    {"hit-points", "N", "0", "hit points",
     "Hit points of a pixel in ppm, which stay from pass to pass: memory for smooth edges; 0 takes "
     "the scene's samples per pixel, at least 4 and at most 16.",
     [](IntegratorOptions& o, const std::string& t) {
       o.hit_points = static_cast<int>(integer("hit-points", t, 0, kMaxInt));
     },
     [](const IntegratorOptions& o) { return fmt::format("{}", o.hit_points); }},
    {"map-photons", "N", "0", "paths",
     "Photon paths emitted for each map of photonmap, once; 0 emits those of 16 passes. When "
     "memory-photons are stored, emission ends.",
     [](IntegratorOptions& o, const std::string& t) {
       o.map_photons = integer("map-photons", t, 0, kNoLimit);
     },
     [](const IntegratorOptions& o) { return fmt::format("{}", o.map_photons); }},
    {"nearest", "N", "100", "photons",
     "Photons of an estimate in photonmap: the nearest ones, within the radius of -D radius; at "
     "least 2.",
     [](IntegratorOptions& o, const std::string& t) {
       o.nearest_photons = static_cast<int>(integer("nearest", t, 2, kMaxInt));
     },
     [](const IntegratorOptions& o) { return fmt::format("{}", o.nearest_photons); }},
    {"memory-photons", "N", "1048576", "photons",
     "Photons kept at once; a pass with more runs in batches, a map with more ends, and "
     "pointlights "
     "chooses as many of its point lights as have room in their memory.",
     [](IntegratorOptions& o, const std::string& t) {
       o.memory_photons = integer("memory-photons", t, 1, kNoLimit);
     },
     [](const IntegratorOptions& o) { return fmt::format("{}", o.memory_photons); }},
    {"outlier-neighbours", "N", "8", "estimates",
     "With --outliers reject: how many similar estimates within 5 x 5 pixels confirm an estimate; "
     "more reject more.",
     [](IntegratorOptions& o, const std::string& t) {
       o.outlier_neighbours = static_cast<int>(integer("outlier-neighbours", t, 2, 1000));
     },
     [](const IntegratorOptions& o) { return fmt::format("{}", o.outlier_neighbours); }},
    {"mutations", "X", "0", "mutations",
     "Of Metropolis light transport, per pixel and pass; 0 chooses.",
     [](IntegratorOptions& o, const std::string& t) {
       o.mutations = number("mutations", t, 0, std::numeric_limits<float>::max(), false);
     },
     [](const IntegratorOptions& o) { return fmt::format("{}", o.mutations); }},
    {"chain-length", "N", "0", "mutations",
     "After how many mutations a Markov chain gives way to a new one; 0 chooses.",
     [](IntegratorOptions& o, const std::string& t) {
       o.chain_length = integer("chain-length", t, 0, kNoLimit);
     },
     [](const IntegratorOptions& o) { return fmt::format("{}", o.chain_length); }},
    {"large-step", "X", "0.1", "",
     "Probability of a mutation that forgets the path it comes from, above 0 to 1.",
     [](IntegratorOptions& o, const std::string& t) {
       o.large_step = number("large-step", t, 0, 1, true);
     },
     [](const IntegratorOptions& o) { return fmt::format("{}", o.large_step); }},
    {"guide", "yes|no", "yes", "",
     "Photons of `photons` and `path+photons` start where earlier ones were of use; those of "
     "`photons` also go where these went from rough surfaces.",
     [](IntegratorOptions& o, const std::string& t) { o.guides_photons = yes("guide", t); },
     [](const IntegratorOptions& o) { return yes_text(o.guides_photons); }},
    {"guide-walks", "yes|no", "yes", "",
     "Camera walks of `path+photons`, and so of `mixed`, go where those of the first pass found "
     "light, where that pays.",
     [](IntegratorOptions& o, const std::string& t) { o.guides_walks = yes("guide-walks", t); },
     [](const IntegratorOptions& o) { return yes_text(o.guides_walks); }},
    {"specular-trees", "yes|no", "no", "",
     "Camera walks of routes of `path`, `forecast`, `bdpt`, `vcm` and `bpm` follow both ways at "
     "smooth glass to lights behind it: worth it where small lamps show in much glass. "
     "(`path+photons`, and so `mixed`, looks for them as it sees fit.)",
     [](IntegratorOptions& o, const std::string& t) {
       o.specular_trees = yes("specular-trees", t);
     },
     [](const IntegratorOptions& o) { return yes_text(o.specular_trees); }},
    {"texture-cache", "SIZE", "1G", "bytes",
     "Memory for the pixels of image textures (K, M, G: powers of 1024); what does not fit is read "
     "from the files again and again, with the same picture.",
     [](IntegratorOptions& o, const std::string& t) {
       o.texture_memory = parse_bytes("-D texture-cache", t);
     },
     [](const IntegratorOptions& o) { return bytes_text(o.texture_memory); }},
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

/// What the scene's Integrator line says. Radii of pbrt's sppm are in world units and chosen for
/// its own photon counts: ours is chosen by the footprint, so theirs is only mentioned.
void take_scene_parameters(const ParameterSet& parameters, bool follow_scene, bool depth_is_given,
                           IntegratorChoice* choice) {
  constexpr int kAbsent = -1;
  const Parameter* depth = parameters.find("maxdepth");
  const int max_depth = parameters.get_int("maxdepth", kAbsent);
  if (depth != nullptr && max_depth < 0)
    throw SceneError(depth->where,
                     fmt::format("\"maxdepth\" is {}, expected at least 0", max_depth));
  if (depth != nullptr)
    choice->options.max_depth = max_depth;
  else if (!depth_is_given)
    choice->notes.push_back(
        fmt::format("the scene gives no maxdepth: paths have up to {} scattering events, where "
                    "pbrt-v4 stops at 5 (-D max-depth=5)",
                    choice->options.max_depth));
  if (parameters.find("radius") != nullptr)
    choice->notes.push_back(
        "the scene's photon radius in world units is not used: radii are chosen by the size of a "
        "pixel (-D radius=PIXELS)");
  const int photons = parameters.get_int("photonsperiteration", kAbsent);
  if (photons > 0 && follow_scene) choice->options.photons_per_pass = photons;
}

/// The row of a pbrt-v4 integrator; empty if there is none of that name.
std::optional<FormatType> pbrt_integrator(const std::string& name) {
  for (const FormatType& type : scene_integrator_types())
    if (name == type.name) return type;
  return std::nullopt;
}

std::string pbrt_integrator_names() {
  std::string names;
  for (const FormatType& type : scene_integrator_types())
    names += (names.empty() ? "" : ", ") + std::string(type.name);
  return names;
}

/// The integrator that stands for the scene's own.
std::string integrator_of_scene(const std::string& scene_integrator, const SourceLocation& where) {
  // Without an Integrator line pbrt-v4 renders with volpath.
  const std::string own = scene_integrator.empty() ? "volpath" : scene_integrator;
  if (!pbrt_integrator(own))
    throw SceneError(where, fmt::format("unknown integrator \"{}\", expected one of: {}", own,
                                        pbrt_integrator_names()));
  std::string name = integrator_for_scene_name(own);
  if (name.empty())
    throw UsageError(fmt::format(
        "--integrator scene: there is no integrator that stands for the scene's '{}'", own));
  return name;
}

/// Warns of what pbrt-v4 would not know; nothing depends on it.
void warn_of_unknown_names(const std::string& scene_integrator, const ParameterSet& parameters,
                           IntegratorChoice* choice) {
  Diagnostics diagnostics;
  const std::string own = scene_integrator.empty() ? "volpath" : scene_integrator;
  const std::optional<FormatType> type = pbrt_integrator(own);
  if (!type) {
    diagnostics.warn(parameters.where, fmt::format("unknown integrator \"{}\", \"{}\" is used",
                                                   scene_integrator, choice->name));
  } else {
    if (parameters.get_bool("regularize", false))
      diagnostics.warn(parameters.find("regularize")->where,
                       "\"regularize\" has no effect here: what it would hide, photons render");
    parameters.report_unused("integrator \"" + own + "\"", *type, diagnostics);
  }
  for (const Warning& warning : diagnostics.warnings())
    choice->warnings.push_back(located(warning.where, warning.message));
}

}  // namespace

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
  IntegratorOptions scratch;
  setting->apply(scratch, value);
  return {std::move(key), std::move(value)};
}

void apply_settings(const SettingList& settings, IntegratorOptions* options) {
  for (const auto& [key, value] : settings)
    if (const IntegratorSetting* setting = find_setting(key)) setting->apply(*options, value);
}

IntegratorChoice choose_integrator(const std::string& wanted, const std::string& scene_integrator,
                                   const ParameterSet& scene_parameters,
                                   const SettingList& settings) {
  IntegratorChoice choice;
  const bool follow_scene = wanted == "scene";
  choice.name =
      follow_scene ? integrator_of_scene(scene_integrator, scene_parameters.where) : wanted;
  const bool depth_is_given = std::any_of(settings.begin(), settings.end(),
                                          [](const auto& s) { return s.first == "max-depth"; });
  take_scene_parameters(scene_parameters, follow_scene, depth_is_given, &choice);
  warn_of_unknown_names(scene_integrator, scene_parameters, &choice);
  apply_settings(settings, &choice.options);
  return choice;
}

SettingList settings_within(uint64_t memory) {
  const IntegratorOptions defaults;
  const auto share = static_cast<int64_t>(memory / 4);
  return {{"texture-cache", bytes_text(std::min(share, defaults.texture_memory))},
          {"memory-photons", fmt::format("{}", std::clamp<int64_t>(share / int64_t{kBytesPerPhoton},
                                                                   1, defaults.memory_photons))}};
}

std::string settings_text(const IntegratorOptions& options) {
  std::string text;
  for (const IntegratorSetting& setting : kSettings) {
    if (!text.empty()) text += ' ';
    text += fmt::format("{}={}", setting.key, setting.print(options));
  }
  return text;
}

}  // namespace nephroid
