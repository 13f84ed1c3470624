// The numbers of a render, each a key of -D: one table with default, unit and help.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/errors.h"
#include "integrator/estimator/integrator_options.h"
#include "photon/photon.h"
#include "scene/scene.h"

namespace nephroid {

/// Numbers that no integrator looks at: scenes are built, and films reject outliers, with them.
struct SceneSettings {
  SpecularBand specular_band;
  uint64_t texture_memory = kDefaultTextureMemory;  ///< bytes for the pixels of image textures
  int outlier_neighbours = 8;                       ///< similar estimates that confirm one
};

/// All that -D sets.
struct RenderSettings {
  IntegratorOptions integrator;
  SceneSettings scene;
  std::vector<std::string> given;  ///< keys that were set, in order

  bool gives(const std::string& key) const;
};

struct IntegratorSetting {
  const char* key;
  const char* value;  ///< placeholder of the value in help: "N", "X"
  const char* default_text;
  const char* unit;  ///< empty if it has none
  std::string help;
  /// Parses and stores; throws UsageError.
  std::function<void(RenderSettings& settings, const std::string& text)> apply;
  /// The stored value as metadata have it.
  std::function<std::string(const RenderSettings& settings)> print;
  bool is_for_everybody = false;  ///< --help shows it; --help-all shows all
};

/// The table of keys, in the order in which help shows them: those of all renders, then those of
/// single estimators.
std::span<const IntegratorSetting> integrator_settings();

/// Keys and values of -D, in the order in which they were given; the last one of a key counts.
using SettingList = std::vector<std::pair<std::string, std::string>>;

/// "key=value" as a pair whose key is known and whose value is valid. Throws UsageError that lists
/// the keys.
std::pair<std::string, std::string> parse_setting(const std::string& text);

/// Applies what parse_setting has accepted.
void apply_settings(const SettingList& settings, RenderSettings* target);

/// The list over the defaults. With a limit of `memory` bytes, 0 being none, textures and photons
/// have a quarter of it each at most, unless the list says otherwise.
RenderSettings render_settings(const SettingList& list, uint64_t memory = 0);

/// Bytes of a photon, of its copy in the list of a chunk, and of its share of the grid while that
/// is built (two codes, two places, a position).
inline constexpr size_t kBytesPerPhoton = 2 * sizeof(Photon) + 48;

/// "max-depth=100 radius=0 ...", every key.
std::string settings_text(const RenderSettings& settings);

}  // namespace nephroid
