// The table of the command line: every option with its value, unit, default and help. The parser
// (command_line.h), --help and docs/options.md are made from it. It must not know the parsing
// library.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "film/film_output.h"
#include "image/mix.h"
#include "input/import_options.h"
#include "scene/scene.h"
#include "session/route_plan.h"
#include "session/settings/integrator_settings.h"

namespace nephroid {

/// Arguments of `nephroid render`; defaults as in the table.
struct RenderCommand {
  std::string scene;
  std::string output;  ///< empty: named after the scene's film
  RouteChoice routes;
  std::optional<std::pair<uint32_t, uint32_t>> passes;  ///< first and last pass
  double time_limit = 0, noise_target = 0;              ///< 0: none
  SceneOverrides overrides;
  int threads = 0;      ///< 0: one per core
  uint64_t memory = 0;  ///< bytes; 0: the memory of the machine
  std::optional<uint64_t> seed;
  SettingList settings;
  bool reject_outliers = false;
  bool resume = false;
  std::string learned_from;         ///< picture; empty: none
  double checkpoint_interval = 60;  ///< seconds
  bool keeps_state = true;
  std::vector<std::string> stream;  ///< layers of the frames on standard output; empty: no frames
  LayerPrecision layer_precision = LayerPrecision::kHalf;
  bool strict = false;
  bool quiet = false;
};

/// Arguments of `nephroid view`. What it renders, and how, is in CommandLine::render.
struct ViewCommand {
  std::string address = "127.0.0.1";
  int port = 0;  ///< 0: any that is free
  bool opens_browser = true;
  std::string save_directory;            ///< empty: the page downloads what it saves
  std::vector<std::string> comparisons;  ///< pictures
};

struct InfoCommand {
  std::string file;  ///< a scene or a picture
  ImportOptions import;
};

/// Arguments of `nephroid convert`.
struct ConvertCommand {
  std::string input, output;
  ImportOptions import;
};

/// Arguments of `nephroid routes`.
struct RoutesCommand {
  std::string scene;  ///< empty: none
  RouteChoice routes;
  SettingList settings;
  ImportOptions import;
  uint32_t passes = 8;  ///< passes of the pilot
};

/// Arguments of `nephroid mix`.
struct MixCommand {
  std::string picture;
  Mix mix;
  std::string output;
  LayerPrecision layer_precision = LayerPrecision::kHalf;
};

/// Arguments of `nephroid merge`.
struct MergeCommand {
  std::vector<std::string> inputs;
  std::string output;
  LayerPrecision layer_precision = LayerPrecision::kHalf;
};

struct CompareCommand {
  std::string reference, test;
  std::string heat_map;  ///< empty: none
  bool subtract_reference_error = false;
  float exposure = 1;  ///< exposure for FLIP
};

/// Arguments of `nephroid bench`.
struct BenchCommand {
  std::string suite;
  std::string directory;          ///< empty: named after the suite
  double time_limit = 0;          ///< seconds of each run; 0: the suite's
  uint32_t passes = 0;            ///< passes of each run; 0: the suite's
  uint32_t repeat = 0;            ///< renders of each run; 0: the suite's
  std::vector<std::string> only;  ///< names of scenes; empty: all
  int threads = 0;                ///< 0: one per core
  bool strict_claims = false;
  bool quiet = false;
};

enum class Action {
  kRender,
  kView,
  kMerge,
  kMix,
  kInfo,
  kCompare,
  kRoutes,
  kBench,
  kConvert,
  kPrint
};

/// A parsed command line.
struct CommandLine {
  Action action = Action::kPrint;
  RenderCommand render;  ///< of `render` and `view`
  ViewCommand view;
  InfoCommand info;
  CompareCommand compare;
  MergeCommand merge;
  RoutesCommand routes;
  BenchCommand bench;
  ConvertCommand convert;
  MixCommand mix;
  ImportOptions import;  ///< options about scene files, copied to the command after parsing
  std::string text;      ///< text of kPrint: help, version and the like
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
  const char* unit;        ///< empty if there is none
  const char* default_text;
  const char* group;
  const char* help;
  bool repeatable;
  /// Parses and stores; throws UsageError. The text is empty for a flag.
  void (*apply)(CommandLine& line, const std::string& text);
  bool is_rare = false;  ///< in --help-all only

  constexpr bool is_positional() const { return name[0] != '-'; }
  /// A positional argument with a default may be left out.
  constexpr bool is_required() const { return is_positional() && default_text[0] == '\0'; }
  bool is_flag() const { return !is_positional() && value[0] == '\0'; }
};

std::span<const CommandDescription> command_table();
/// The options in the order of help.
std::span<const OptionDescription> option_table();

/// The program's own --help and --help-all.
std::string program_help();
std::string program_help_all();
/// --help of one command of the table, on one screen.
std::string command_help(const std::string& command);
/// --help-all of one command of the table.
std::string command_help_all(const std::string& command);
/// docs/options.md.
std::string options_markdown();

}  // namespace nephroid
