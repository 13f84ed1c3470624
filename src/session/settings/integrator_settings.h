// Where the numbers of an integrator come from: built-in defaults, the scene's Integrator line,
// then -D key=value, each over the one before. One table has every key with its default, unit and
// help. Who calls it: options.cpp (names and help) and apps (values).
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/errors.h"
#include "input/scene_description.h"
#include "integrator/estimator.h"
#include "photon/photon.h"

namespace nephroid {

struct IntegratorSetting {
  const char* key;
  const char* value;  ///< what the value is, for help: "N", "X"
  const char* default_text;
  const char* unit;  ///< empty if it has none
  const char* help;
  /// Parses and stores; throws UsageError.
  void (*apply)(IntegratorOptions& options, const std::string& text);
  /// What is stored now, for metadata.
  std::string (*print)(const IntegratorOptions& options);
};

/// The table of keys, in the order in which help shows them.
std::span<const IntegratorSetting> integrator_settings();

/// Keys and values of -D, in the order in which they were given; the last one of a key counts.
using SettingList = std::vector<std::pair<std::string, std::string>>;

/// "key=value" as a pair whose key is known and whose value is valid. Throws UsageError that lists
/// the keys.
std::pair<std::string, std::string> parse_setting(const std::string& text);

/// Bytes of a photon and of its share of the grid while that is built.
inline constexpr size_t kBytesPerPhoton = 2 * sizeof(Photon);

/// Makes caches no larger than a share of `memory` bytes each: what a list of settings begins with
/// that respects --memory.
SettingList settings_within(uint64_t memory);

/// Applies what parse_setting has accepted.
void apply_settings(const SettingList& settings, IntegratorOptions* options);

/// What the scene and the command line chose.
struct IntegratorChoice {
  std::string name;
  IntegratorOptions options;
  std::vector<std::string> notes;     ///< what of the scene's line was not taken, for the report
  std::vector<std::string> warnings;  ///< what is wrong with it: "file:line:column: message"
};

/// `wanted` is an integrator's name, or "scene" for the one that stands for the scene's own. Throws
/// UsageError if the scene's own is asked for and nothing stands for it, SceneError if it is asked
/// for and unknown, or for a parameter of the wrong type or range.
IntegratorChoice choose_integrator(const std::string& wanted, const std::string& scene_integrator,
                                   const ParameterSet& scene_parameters,
                                   const SettingList& settings);

/// "max-depth=100 radius=0 ...", every key.
std::string settings_text(const IntegratorOptions& options);

}  // namespace nephroid
