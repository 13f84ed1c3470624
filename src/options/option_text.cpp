// The option table as text: --help and docs/options.md.
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "integrator/presets/estimator_table.h"
#include "integrator/presets/route_presets.h"
#include "options/options.h"
#include "options/table_cell.h"

namespace nephroid {
namespace {

constexpr size_t kHelpWidth = 96;
constexpr size_t kHelpColumn = 32;

enum class Length { kOneLine, kAll };

/// "-o, --output OUT.exr".
std::string signature(const OptionDescription& option) {
  std::string text = option.short_name;
  if (!text.empty()) text += ", ";
  text += option.name;
  if (!option.is_positional() && !option.is_flag()) text += fmt::format(" {}", option.value);
  return text;
}

/// "[pixels; default: the scene's]", without empty parts.
std::string unit_and_default(const char* unit, const char* default_text) {
  std::string text = unit;
  if (default_text[0] != '\0')
    text += fmt::format("{}default: {}", text.empty() ? "" : "; ", default_text);
  return text.empty() ? text : fmt::format(" [{}]", text);
}

/// One entry of help: the left part, then the text, wrapped into its column.
std::string help_entry(const std::string& left, const std::string& text) {
  std::string result = "  " + left;
  if (result.size() + 2 > kHelpColumn)
    result += '\n' + std::string(kHelpColumn, ' ');
  else
    result.append(kHelpColumn - result.size(), ' ');
  size_t column = kHelpColumn;
  bool first = true;
  for (size_t begin = 0; begin < text.size();) {
    const size_t end = std::min(text.find(' ', begin), text.size());
    const size_t length = end - begin;
    if (!first && column + 1 + length > kHelpWidth) {
      result += '\n' + std::string(kHelpColumn, ' ');
      column = kHelpColumn;
    } else if (!first) {
      result += ' ';
      ++column;
    }
    result.append(text, begin, length);
    column += length;
    first = false;
    begin = end + 1;
  }
  return result + '\n';
}

/// Help of an option: all of it, or its first sentence with the default if there is room.
std::string meaning(const std::string& help, const std::string& unit_and_default, Length length) {
  if (length == Length::kAll) return help + unit_and_default;
  const std::string first = help.substr(0, help.find(". "));
  const std::string brief = first.ends_with('.') ? first : first + '.';
  const bool has_room = kHelpColumn + brief.size() + unit_and_default.size() <= kHelpWidth;
  return has_room ? brief + unit_and_default : brief;
}

std::vector<const OptionDescription*> options_of(const std::string& command) {
  std::vector<const OptionDescription*> result;
  for (const OptionDescription& option : option_table())
    if (command == option.command) result.push_back(&option);
  return result;
}

/// "nephroid compare [options] REF TEST".
std::string usage_of(const std::string& command) {
  std::string text = "nephroid " + command;
  std::string arguments;
  bool has_options = false;
  for (const OptionDescription* option : options_of(command)) {
    if (option->is_positional())
      arguments += option->is_required() ? fmt::format(" {}", option->name)
                                         : fmt::format(" [{}]", option->name);
    else
      has_options = true;
  }
  return text + (has_options ? " [options]" : "") + arguments;
}

/// Groups in the order of their first option.
std::vector<std::string> groups_of(const std::string& command) {
  std::vector<std::string> groups;
  for (const OptionDescription* option : options_of(command)) {
    const bool known = std::find(groups.begin(), groups.end(), option->group) != groups.end();
    if (!option->is_positional() && !known) groups.emplace_back(option->group);
  }
  return groups;
}

bool takes_settings(const std::string& command) {
  const auto options = options_of(command);
  return std::any_of(options.begin(), options.end(),
                     [](const OptionDescription* o) { return std::string("-D") == o->name; });
}

bool takes_presets(const std::string& command) {
  const auto options = options_of(command);
  return std::any_of(options.begin(), options.end(),
                     [](const OptionDescription* o) { return std::string("--routes") == o->name; });
}

}  // namespace

std::string program_help() {
  std::string text =
      "nephroid: renders light, each kind by the method that is good at it\n\nUsage: nephroid "
      "COMMAND [options] ...\n\nCommands:\n";
  for (const CommandDescription& command : command_table())
    text += help_entry(command.name, command.help);
  text += "\nOptions:\n" + help_entry("-h, --help", "Print this, or the help of a command.") +
          help_entry("--help-all", "Print all that a command can do.") +
          help_entry("--version", "Print the version.");
  text +=
      "\nExit status: 0 done, 1 render error, 2 wrong usage, 3 wrong scene, 4 input/output "
      "error,\n128+N stopped by signal N, what was rendered was written.\n";
  return text;
}

namespace {

/// Help of a group of options with its heading; empty if all of them are rare and not wanted.
std::string group_help(const std::string& command, const std::string& group, Length length) {
  std::string text;
  for (const OptionDescription* option : options_of(command))
    if (!option->is_positional() && group == option->group &&
        (length == Length::kAll || !option->is_rare))
      text += help_entry(
          signature(*option),
          meaning(option->help, unit_and_default(option->unit, option->default_text), length));
  if (text.empty()) return text;
  return fmt::format("\n{}:\n", group.empty() ? "Options" : group) + text;
}

/// Help of options; at full length also of rare ones and of -D keys.
std::string options_help(const std::string& command, Length length) {
  std::string text;
  for (const CommandDescription& row : command_table())
    if (command == row.name) text = fmt::format("{}\n\nUsage: {}\n\n", row.help, usage_of(command));
  for (const OptionDescription* option : options_of(command))
    if (option->is_positional()) text += help_entry(option->name, option->help);
  for (const std::string& group : groups_of(command)) text += group_help(command, group, length);
  if (!takes_settings(command) || length != Length::kAll) return text;
  text += "\nKeys of -D:\n";
  for (const IntegratorSetting& setting : integrator_settings())
    text += help_entry(
        fmt::format("{}={}", setting.key, setting.value),
        meaning(setting.help, unit_and_default(setting.unit, setting.default_text), length));
  return text;
}

}  // namespace

std::string command_help(const std::string& command) {
  const auto options = options_of(command);
  const bool has_more = std::any_of(options.begin(), options.end(),
                                    [](const OptionDescription* o) { return o->is_rare; });
  std::string text = options_help(command, has_more ? Length::kOneLine : Length::kAll);
  text += "\n" + help_entry("-h, --help", "Print this.");
  if (has_more)
    text += help_entry("--help-all", "Print every option, -D key, preset and estimator.");
  return text;
}

std::string command_help_all(const std::string& command) {
  std::string text = options_help(command, Length::kAll);
  text +=
      "\n" + help_entry("-h, --help", "Print a summary.") + help_entry("--help-all", "Print this.");
  if (!takes_presets(command)) return text;
  text += "\nPresets of --routes:\n";
  for (const RoutePreset& preset : route_presets()) text += help_entry(preset.name, preset.help);
  text += "\nEstimators of --route:\n";
  for (const EstimatorTraits* estimator : estimator_traits())
    text += help_entry(estimator->name, estimator->help);
  return text;
}

std::string program_help_all() {
  std::string text = program_help();
  for (const CommandDescription& command : command_table())
    text += fmt::format("\n--- {} ---\n\n{}", command.name, command_help_all(command.name));
  return text;
}

std::string options_markdown() {
  std::string text =
      "# Options\n\nMade from the option table in `src/options/options.cpp` by "
      "`tools/update_docs`; do not edit.\n";
  for (const CommandDescription& command : command_table()) {
    text += fmt::format("\n## {}\n\n{}\n\n    {}\n\n", command.name, command.help,
                        usage_of(command.name));
    text += "| option | unit | default | meaning |\n| --- | --- | --- | --- |\n";
    for (const OptionDescription* option : options_of(command.name))
      text += fmt::format("| `{}` | {} | {} | {} |\n", table_cell(signature(*option)),
                          table_cell(option->unit), table_cell(option->default_text),
                          table_cell(option->help));
    if (!takes_settings(command.name)) continue;
    text += "\nKeys of `-D`, over the scene's Integrator line, which is over the defaults:\n\n";
    text += "| key | unit | default | meaning |\n| --- | --- | --- | --- |\n";
    for (const IntegratorSetting& setting : integrator_settings())
      text += fmt::format("| `{}={}` | {} | {} | {} |\n", setting.key, table_cell(setting.value),
                          table_cell(setting.unit), table_cell(setting.default_text),
                          table_cell(setting.help));
  }
  text +=
      "\n## Routes\n\nPresets of `--routes` ([routes.md](routes.md) has their expressions):\n\n";
  text += "| preset | meaning |\n| --- | --- |\n";
  for (const RoutePreset& preset : route_presets())
    text += fmt::format("| `{}` | {} |\n", preset.name, table_cell(preset.help));
  text += "\nEstimators of `--route`:\n\n| estimator | meaning |\n| --- | --- |\n";
  for (const EstimatorTraits* estimator : estimator_traits())
    text += fmt::format("| `{}` | {} |\n", estimator->name, table_cell(estimator->help));
  text +=
      "\n## Without a command\n\n`nephroid --help`, `nephroid --help-all` and `nephroid "
      "--version`.\n";
  return text;
}

}  // namespace nephroid
