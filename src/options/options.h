// The one table of the command line: every option with its value, unit, default and help. The
// parser (command_line.h), --help and docs/options.md are all made from it. It must not know the
// parsing library.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "film/film_output.h"
#include "scene/scene.h"
#include "session/route_plan.h"
#include "session/settings/integrator_settings.h"

namespace nephroid {

/// What `nephroid render` was asked for; defaults are those of the table.
struct RenderCommand {
  std::string scene;
  std::string output;  ///< empty: named after the scene's film
  RouteChoice routes;
  std::optional<std::pair<uint32_t, uint32_t>> passes;  ///< first and last
  double time_limit = 0, noise_target = 0;              ///< 0: none
  SceneOverrides overrides;
  int threads = 0;      ///< 0: all of the machine
  uint64_t memory = 0;  ///< bytes, 0: what the machine has
  std::optional<uint64_t> seed;
  SettingList settings;
  bool reject_outliers = false;
  bool resume = false;
  double checkpoint_interval = 60;  ///< s
  bool keeps_state = true;
  LayerPrecision layer_precision = LayerPrecision::kHalf;
  bool strict = false;
  bool quiet = false;
};

struct InfoCommand {
  std::string file;  ///< a scene or a picture
};

/// What `nephroid routes` was asked for.
struct RoutesCommand {
  std::string scene;  ///< empty: none
  RouteChoice routes;
  SettingList settings;
  uint32_t passes = 8;  ///< of the pilot
};

/// What `nephroid merge` was asked for.
struct MergeCommand {
  std::vector<std::string> inputs;
  std::string output;
  LayerPrecision layer_precision = LayerPrecision::kHalf;
};

struct CompareCommand {
  std::string reference, test;
  std::string heat_map;  ///< empty: none
  bool subtract_reference_error = false;
  float exposure = 1;  ///< of FLIP
};

/// What `nephroid bench` was asked for.
struct BenchCommand {
  std::string suite;
  std::string directory;          ///< empty: named after the suite
  double time_limit = 0;          ///< of each run, 0: as the suite says
  uint32_t passes = 0;            ///< of each run, 0: as the suite says
  uint32_t repeat = 0;            ///< renders of each run, 0: as the suite says
  std::vector<std::string> only;  ///< names of scenes, all if empty
  int threads = 0;                ///< 0: all of the machine
  bool strict_claims = false;
  bool quiet = false;
};

enum class Action { kRender, kMerge, kInfo, kCompare, kRoutes, kBench, kPrint };

/// A command line that has been understood.
struct CommandLine {
  Action action = Action::kPrint;
  RenderCommand render;
  InfoCommand info;
  CompareCommand compare;
  MergeCommand merge;
  RoutesCommand routes;
  BenchCommand bench;
  std::string text;  ///< what to print, for help, version and the like
};

struct CommandDescription {
  const char* name;
  const char* help;
};

struct OptionDescription {
  const char* command;
  const char* name;        ///< "--time", "-D", or "SCENE" for a positional argument
  const char* short_name;  ///< "-o", empty if there is none
  const char* value;       ///< name of the value, empty for a flag and for a positional argument
  const char* unit;        ///< empty if it has none
  const char* default_text;
  const char* group;
  const char* help;
  bool repeatable;
  /// Parses and stores; throws UsageError. The text is empty for a flag.
  void (*apply)(CommandLine& line, const std::string& text);

  constexpr bool is_positional() const { return name[0] != '-'; }
  /// A positional argument with a default may be left out.
  constexpr bool is_required() const { return is_positional() && default_text[0] == '\0'; }
  bool is_flag() const { return !is_positional() && value[0] == '\0'; }
};

std::span<const CommandDescription> command_table();
/// In the order in which help shows them.
std::span<const OptionDescription> option_table();

/// The program's own --help and --help-all.
std::string program_help();
std::string program_help_all();
/// --help of one command of the table: what fits one screen.
std::string command_help(const std::string& command);
/// --help-all of one command of the table.
std::string command_help_all(const std::string& command);
/// docs/options.md.
std::string options_markdown();

}  // namespace nephroid
