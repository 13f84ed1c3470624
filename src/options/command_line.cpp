// Feeds the option table to CLI11. The only file that includes it.
#include "options/command_line.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "core/errors.h"
#include "input/spelling.h"
#include "options/gltf_support.h"
#include "options/mitsuba_support.h"
#include "options/obj_support.h"
#include "options/scene_support.h"
#include "session/checkpoint/version.h"

namespace nephroid {
namespace {

void add_option(CLI::App& command, const OptionDescription& row, CommandLine& line) {
  std::string names = row.name;
  if (row.short_name[0] != '\0') names = std::string(row.short_name) + "," + names;
  const auto apply = row.apply;
  if (row.is_flag()) {
    command.add_flag_callback(
        names, [apply, &line] { apply(line, ""); }, row.help);
    return;
  }
  const bool once = !row.repeatable;
  const auto apply_all = [apply, once, name = row.name,
                          &line](const std::vector<std::string>& values) {
    if (once && values.size() > 1)
      throw UsageError(fmt::format("{} is given {} times, expected once", name, values.size()));
    for (const std::string& value : values) apply(line, value);
  };
  CLI::Option* option =
      command.add_option_function<std::vector<std::string>>(names, apply_all, row.help);
  // One value per use: without this a list would swallow the scene's name.
  option->type_size(1)->allow_extra_args(row.is_positional() && row.repeatable);
  const bool collects = row.repeatable || !row.is_positional();
  option->expected(1, collects ? CLI::detail::expected_max_vector_size : 1);
  if (row.is_required()) option->required();
}

void set_action(const std::string& command, CommandLine& line) {
  if (command == "render") line.action = Action::kRender;
  if (command == "merge") line.action = Action::kMerge;
  if (command == "info") line.action = Action::kInfo;
  if (command == "compare") line.action = Action::kCompare;
  if (command == "routes") line.action = Action::kRoutes;
  if (command == "bench") line.action = Action::kBench;
  if (command == "convert") line.action = Action::kConvert;
  if (command == "view") line.action = Action::kView;
  if (command == "mix") line.action = Action::kMix;
}

/// Gives the options about scene files to the commands that read one.
void share_import_options(CommandLine& line) {
  line.render.overrides.import = line.import;
  line.info.import = line.import;
  line.routes.import = line.import;
  line.convert.import = line.import;
}

/// Throws UsageError for a first word that is neither an option nor a command.
void check_command(const std::vector<std::string>& arguments) {
  if (arguments.empty() || arguments[0].rfind('-', 0) == 0) return;
  std::vector<std::string> known;
  for (const CommandDescription& command : command_table()) known.emplace_back(command.name);
  if (std::find(known.begin(), known.end(), arguments[0]) != known.end()) return;
  if (arguments[0].find('.') != std::string::npos)
    throw UsageError(fmt::format("'{}' is no command, expected: nephroid render {}", arguments[0],
                                 arguments[0]));
  throw UsageError(fmt::format("unknown command '{}', expected one of: {}{}", arguments[0],
                               fmt::join(known, ", "), did_you_mean(arguments[0], known)));
}

/// The message for arguments that `command` does not take.
std::string not_expected(const std::vector<std::string>& extra, const std::string& command) {
  const auto is_option = [](const std::string& word) { return word.rfind('-', 0) == 0; };
  const auto option = std::ranges::find_if(extra, is_option);
  if (option == extra.end()) return fmt::format("'{}' was not expected", fmt::join(extra, " "));
  const std::string name = option->substr(0, option->find('='));
  std::vector<std::string> known;
  for (const OptionDescription& row : option_table())
    if (command == row.command && is_option(row.name)) known.emplace_back(row.name);
  return fmt::format("unknown option '{}'{}", name, did_you_mean(name, known));
}

/// The message for an option of `command` without its value. CLI11's text begins with its name.
std::string without_value(const std::string& text, const std::string& command) {
  const std::string name = text.substr(0, text.find(':'));
  for (const OptionDescription& row : option_table())
    if (command == row.command && (name == row.name || name == row.short_name))
      return fmt::format("{} has no value, expected {} {} (see nephroid {} --help)", name, name,
                         row.value, command);
  return fmt::format("{} (see nephroid {}{}--help)", text, command, command.empty() ? "" : " ");
}

/// A page of docs/ that tools/update_docs writes.
struct Page {
  const char* flag;
  std::string (*text)();
};
constexpr Page kPages[] = {
    {"--options-markdown", options_markdown},
    {"--scene-support-markdown", scene_support_markdown},
    {"--gltf-support-markdown", gltf_support_markdown},
    {"--mitsuba-support-markdown", mitsuba_support_markdown},
    {"--obj-support-markdown", obj_support_markdown},
};

CommandLine printing(const std::string& text) {
  CommandLine line;
  line.text = text;
  return line;
}

}  // namespace

CommandLine parse_command_line(const std::vector<std::string>& arguments) {
  check_command(arguments);
  CommandLine line;
  CLI::App app;
  const Page* page = nullptr;
  app.name("nephroid");
  app.set_help_all_flag("--help-all");
  app.set_version_flag("--version", kVersion);
  for (const Page& row : kPages)
    app.add_flag_callback(row.flag, [&page, &row] { page = &row; })->group("");
  app.require_subcommand(0, 1);
  for (const CommandDescription& command : command_table()) {
    CLI::App* sub = app.add_subcommand(command.name, command.help);
    sub->callback([&line, name = std::string(command.name)] { set_action(name, line); });
    for (const OptionDescription& row : option_table())
      if (std::string(command.name) == row.command) add_option(*sub, row, line);
  }

  const auto chosen_command = [&app] {
    const auto chosen = app.get_subcommands();
    return chosen.empty() ? std::string() : chosen.front()->get_name();
  };
  try {
    // CLI11 takes the arguments from the back.
    app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
  } catch (const CLI::CallForHelp&) {
    const std::string command = chosen_command();
    return printing(command.empty() ? program_help() : command_help(command));
  } catch (const CLI::CallForAllHelp&) {
    const std::string command = chosen_command();
    return printing(command.empty() ? program_help_all() : command_help_all(command));
  } catch (const CLI::CallForVersion&) {
    return printing(fmt::format("nephroid {} ({})\n", kVersion, instruction_set()));
  } catch (const CLI::ExtrasError&) {
    const std::string command = chosen_command();
    throw UsageError(fmt::format("{} (see nephroid {}{}--help)",
                                 not_expected(app.remaining(true), command), command,
                                 command.empty() ? "" : " "));
  } catch (const CLI::ArgumentMismatch& error) {
    throw UsageError(without_value(error.what(), chosen_command()));
  } catch (const CLI::ParseError& error) {
    const std::string command = chosen_command();
    throw UsageError(fmt::format("{} (see nephroid {}{}--help)", error.what(), command,
                                 command.empty() ? "" : " "));
  }
  if (page) return printing(page->text());
  if (chosen_command().empty()) throw UsageError("no command given\n\n" + program_help());
  share_import_options(line);
  return line;
}

}  // namespace nephroid
