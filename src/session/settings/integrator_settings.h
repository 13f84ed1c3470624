// The settings of a render, each a -D key: one table with default, unit and help.
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

/// Settings of scene building and outlier rejection, which no integrator reads.
struct SceneSettings {
  SpecularBand specular_band;
  uint64_t texture_memory = kDefaultTextureMemory;  ///< bytes for the pixels of image textures
  int outlier_neighbours = 8;                       ///< similar estimates that confirm an outlier
};

/// All settings of -D.
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
  const char* unit;  ///< empty if there is none
  std::string help;
  /// Parses and stores; throws UsageError.
  std::function<void(RenderSettings& settings, const std::string& text)> apply;
  /// The stored value as text, for metadata.
  std::function<std::string(const RenderSettings& settings)> print;
};

/// The table of keys in the order of help: keys of all renders, then those of single estimators.
std::span<const IntegratorSetting> integrator_settings();

/// Keys and values of -D in the given order; the last value of a key counts.
using SettingList = std::vector<std::pair<std::string, std::string>>;

/// "key=value" as a pair whose key is known and whose value is valid. Throws UsageError that lists
/// the keys.
std::pair<std::string, std::string> parse_setting(const std::string& text);

/// Applies settings that parse_setting has accepted.
void apply_settings(const SettingList& settings, RenderSettings* target);

/// The defaults, overridden by the list. With a limit of `memory` bytes (0: none), textures and
/// photons get at most a quarter of it each, unless the list sets them.
RenderSettings render_settings(const SettingList& list, uint64_t memory = 0);

/// Bytes per photon: the photon, its copy in the list of a chunk, and its share of the grid under
/// construction (two codes, two indices, a position).
inline constexpr size_t kBytesPerPhoton = 2 * sizeof(Photon) + 48;

/// "max-depth=100 radius=0 ...", every key.
std::string settings_text(const RenderSettings& settings);

}  // namespace nephroid
